#version 460
// SPDX-License-Identifier: Apache-2.0
// The hit is found once more, as in shaders/spa.rchit.
#extension GL_EXT_ray_tracing : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

#define SPA_HIT_STAGE
#include "surface.glsl"

layout(location = 0) rayPayloadInEXT RenderSurface payload;

void main() {
    SpaRay ray;
    ray.origin = gl_ObjectRayOriginEXT;
    ray.t_min = gl_RayTminEXT;
    ray.direction = gl_ObjectRayDirectionEXT;
    ray.t_max = 1e30;
    SpaMap map = spa_open(0u);
    SpaHit hit;
    spa_trace_record(map, ray, spa_chosen_method(), spa_record.flags, spa_hole_threshold, hit);
    payload = map_surface(uint(gl_InstanceCustomIndexEXT), hit, spa_shade(map, hit), mat4x3(gl_WorldToObjectEXT),
                          gl_HitTEXT, gl_WorldRayOriginEXT, gl_WorldRayDirectionEXT);
}
