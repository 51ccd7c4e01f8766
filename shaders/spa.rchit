#version 460
// SPDX-License-Identifier: Apache-2.0
// Closest-hit shader: stored colour and normal, and the diffuse light of one lamp without its shadow (trace that
// from the ray-generation shader). The hit is found once more with the object-space ray, because a later call of
// the intersection shader may have overwritten its attributes (Vulkan-Docs issue 2681).
#extension GL_EXT_ray_tracing : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_GOOGLE_include_directive : require

#define SPA_HIT_STAGE
#include "spa_trace.glsl"
#include "spa_payload.glsl"

layout(location = 0) rayPayloadInEXT SpaPayload payload;

void main() {
    SpaRay ray;
    ray.origin = gl_ObjectRayOriginEXT;
    ray.t_min = gl_RayTminEXT;
    ray.direction = gl_ObjectRayDirectionEXT;
    ray.t_max = 1e30; // cut at the hit itself it might end a rounding before it

    SpaMap map = spa_open(0u);
    SpaHit hit;
    spa_trace_record(map, ray, spa_chosen_method(), spa_record.flags, spa_hole_threshold, hit);
    SpaShade shade = spa_shade(map, hit);

    payload.color = shade.color;
    payload.t = gl_HitTEXT;
    payload.normal = normalize((shade.normal * gl_WorldToObjectEXT).xyz);
    vec3 place = gl_WorldRayOriginEXT + gl_HitTEXT * gl_WorldRayDirectionEXT;
    vec3 to_light = payload.light.xyz - payload.light.w * place;
    payload.diffuse = max(0.0, dot(payload.normal, to_light) * inversesqrt(max(dot(to_light, to_light), 1e-30)));
    payload.part = spa_record.part;
    payload.kind = gl_HitKindEXT;
    payload.instance = gl_InstanceID;
}
