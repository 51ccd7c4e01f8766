// SPDX-License-Identifier: Apache-2.0
// map_query.comp in HLSL.
#define SPA_HLSL
#include "map_ray.hlsl"

#define SPA_QUERY_RECORD(id) vk::RawBufferLoad<uint4>(parameters.records + 16u * (uint64_t)(id), 8)
#include "spa_ray_query.hlsl"

[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {
    uint i = id.x;
    if (i >= parameters.count) return;
    WorldRay world = world_ray(i);
    RayDesc ray = description_of(world);
    RaytracingAccelerationStructure scene = scene_at(parameters.scene);
    SpaQueryHit best = spa_query_closest(scene, ray, 0u, 0xFFu);
    WorldHit hit = (WorldHit)0;
    hit.t = -1.0f;
    hit.occluded = spa_query_occluded(scene, ray, 0u, 0xFFu) ? 1u : 0u;
    if (best.type == SPA_QUERY_MAP) {
        SpaShade shade = spa_query_shade(best);
        hit.t = best.t;
        hit.instance = best.id;
        hit.part = SPA_QUERY_RECORD(best.id).w;
        hit.kind = spa_hit_kind(best.map_hit, false);
        hit.color = shade.color;
        hit.normal = spa_query_normal(best, shade.normal);
        float3 to_light = lamp.xyz - (world.origin + best.t * world.direction);
        hit.diffuse = max(0.0f, dot(hit.normal, normalize(to_light)));
        hit.object_origin = mul(best.to_object, float4(world.origin, 1.0f));
        hit.object_direction = mul(best.to_object, float4(world.direction, 0.0f));
    }
    write_hit(i, hit);
}
