#version 460
// SPDX-License-Identifier: Apache-2.0
// Loaded maps by ray queries.
#extension GL_EXT_ray_query : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 64) in;

#define SPA_SCENE accelerationStructureEXT(scene)
#define SPA_QUERY_RECORD(index) records.record[index]
#include "map_ray.glsl"
#include "spa_ray_query.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    WorldRay world = rays.ray[i];
    SpaRay ray = spa_object_ray(world.origin, world.t_min, world.direction, world.t_max);
    SpaQueryHit best = spa_query_closest(ray, 0u, 0xFFu);
    WorldHit hit;
    hit.t = -1.0;
    hit.occluded = spa_query_occluded(ray, 0u, 0xFFu) ? 1u : 0u;
    if (best.type == SPA_QUERY_MAP) {
        SpaShade shade = spa_query_shade(best);
        hit.t = best.t;
        hit.instance = best.custom_index;
        hit.part = records.record[best.custom_index].part;
        hit.kind = spa_hit_kind(best.map_hit, false);
        hit.color = shade.color;
        hit.normal = spa_query_normal(best, shade.normal);
        vec3 to_light = lamp.xyz - (world.origin + best.t * world.direction);
        hit.diffuse = max(0.0, dot(hit.normal, normalize(to_light)));
        hit.object_origin = best.to_object * vec4(world.origin, 1.0);
        hit.object_direction = best.to_object * vec4(world.direction, 0.0);
    }
    hits.hit[i] = hit;
}
