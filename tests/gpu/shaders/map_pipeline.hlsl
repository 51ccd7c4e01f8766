// SPDX-License-Identifier: Apache-2.0
// map_pipeline.rgen and map_pipeline.rmiss in HLSL; one of them a module: RAYGEN or MISS is defined.
#include "map_ray.hlsl"

// That of spa.hlsl.
struct Payload {
    float4 light;
    float3 color;
    float t;
    float3 normal;
    float diffuse;
    uint part;
    uint kind;
    uint instance;
};

#ifdef RAYGEN
[shader("raygeneration")]
void main() {
    uint i = DispatchRaysIndex().x;
    RayDesc ray = description_of(world_ray(i));
    Payload payload = (Payload)0;
    payload.light = lamp;
    payload.t = -1.0f;
    TraceRay(scene_at(parameters.scene), 0u, 0xFFu, 0u, 0u, 0u, ray, payload);
    WorldHit hit = (WorldHit)0;
    hit.t = payload.t;
    hit.instance = payload.instance;
    hit.part = payload.part;
    hit.kind = payload.kind;
    hit.color = payload.color;
    hit.normal = payload.normal;
    hit.diffuse = payload.diffuse;
    payload.t = 1.0f;
    uint any = RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER;
    TraceRay(scene_at(parameters.scene), any, 0xFFu, 0u, 0u, 0u, ray, payload);
    hit.occluded = payload.t > 0.0f ? 1u : 0u;
    write_hit(i, hit);
}
#endif

#ifdef MISS
[shader("miss")]
void main(inout Payload payload) { payload.t = -1.0f; }
#endif
