// SPDX-License-Identifier: Apache-2.0
// What the stages of shaders/hlsl do apart from ray tracing: compiled by glslang, not run.
[[vk::binding(0)]] ByteAddressBuffer trace_images;
[[vk::binding(1)]] StructuredBuffer<float4> rays;
[[vk::binding(2)]] RWStructuredBuffer<float4> results;

#define SPA_HLSL
#define SPA_LOAD(index) trace_images.Load(4u * (index))
#include "spa_method.hlsl"

[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {
    float4 from = rays[2u * id.x];
    float4 along = rays[2u * id.x + 1u];
    SpaRay ray = spa_object_ray(from.xyz, from.w, along.xyz, spa_reach(along.w));
    SpaMap map = spa_open(0u);
    SpaHit hit;
    bool found = spa_trace_record(map, ray, spa_chosen_method(), SPA_RECORD_COVERAGE, SPA_THRESHOLD, hit);
    if (!found) return;
    float3x4 to_map = float3x4(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0);
    float3 normal = spa_normal_to_world(hit.normal, to_map);
    results[id.x] = float4(normal, float(spa_hit_kind(hit, false)));
}
