#version 460
// SPDX-License-Identifier: Apache-2.0
// Both passes by ray queries.
#extension GL_EXT_ray_query : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

#include "scene.glsl"
#include "spa_trace.glsl"
#include "material.glsl"

layout(local_size_x = SPA_GROUP_SIZE, local_size_y = SPA_GROUP_SIZE) in;

SpaRecord query_record(uint index) {
    RenderInstance instance = instance_at(index);
    SpaRecord record;
    record.image = instance.image;
    record.flags = instance.flags;
    record.part = instance.part;
    return record;
}

#define SPA_SCENE accelerationStructureEXT(GLOBALS.scene)
#define SPA_QUERY_RECORD(index) query_record(index)
#define SPA_OPAQUE_TRIANGLE(query)                                                                           \
    !is_transparent(uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, false)),                       \
                    uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false)),                            \
                    rayQueryGetIntersectionBarycentricsEXT(query, false))
#include "spa_ray_query.glsl"
#include "surface.glsl"

RenderSurface closest(vec3 origin, vec3 direction, uint mask) {
    SpaQueryHit best = spa_query_closest(spa_object_ray(origin, 0.0, direction, 1e30), gl_RayFlagsNoneEXT, mask);
    if (best.type == SPA_QUERY_TRIANGLE)
        return triangle_surface(best.custom_index, best.primitive, best.barycentrics, best.t, direction);
    if (best.type == SPA_QUERY_MAP)
        return map_surface(best.custom_index, best.map_hit, spa_query_shade(best), best.to_object, best.t, origin,
                           direction);
    return no_surface();
}

bool occluded(vec3 origin, vec3 direction, float t_max, uint mask) {
    return spa_query_occluded(spa_object_ray(origin, 0.0, direction, t_max), gl_RayFlagsNoneEXT, mask);
}

#include "path.glsl"

void main() { render_pixel(gl_GlobalInvocationID.xy); }
