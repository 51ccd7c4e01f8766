// SPDX-License-Identifier: Apache-2.0
// HLSL: how maps are traced, by macros given to the compiler (-D); and a hit as a payload. Included by spa.hlsl and
// spa_ray_query.hlsl.
//   SPA_METHOD      SPA_PROJECTIVE (the default), SPA_FAN or SPA_MARCH
//   SPA_COUNT       test rays of the fan, steps of the march; without it, their defaults
//   SPA_COUNT_RULE  SPA_FAN_FIXED (the default) or SPA_FAN_BY_DISTANCE
//   SPA_FAN_START   SPA_FAN_START_HITS (the default) or SPA_FAN_START_LEAVES
//   SPA_THRESHOLD   of coverage, for records with SPA_RECORD_COVERAGE; without it SPA_HOLE_THRESHOLD
#ifndef SPA_METHOD_HLSL
#define SPA_METHOD_HLSL

#include "../spa_method.h"

#ifndef SPA_METHOD
#define SPA_METHOD SPA_PROJECTIVE
#endif
#ifndef SPA_FAN_START
#define SPA_FAN_START SPA_FAN_START_HITS
#endif
#ifndef SPA_COUNT_RULE
#define SPA_COUNT_RULE SPA_FAN_FIXED
#endif
#ifndef SPA_THRESHOLD
#define SPA_THRESHOLD SPA_HOLE_THRESHOLD
#endif

SpaMethod spa_chosen_method() {
    SpaMethod method = spa_method_defaults(SPA_METHOD);
#ifdef SPA_COUNT
    method.fan.count = SPA_COUNT;
    method.march.steps = SPA_COUNT;
#endif
    method.fan.count_rule = SPA_COUNT_RULE;
    method.fan.start = SPA_FAN_START;
    return method;
}

// The t_max to trace with, where t_max is that of the ray or of its best hit so far. Fan and march spread their points
// over what is left of the ray: their answer must not depend on which instance was tested first. What lies beyond
// t_max is refused.
float spa_reach(float t_max) { return SPA_METHOD == SPA_PROJECTIVE ? t_max : 1e30f; }

SpaRay spa_object_ray(float3 origin, float t_min, float3 direction, float t_max) {
    SpaRay ray;
    ray.origin = origin;
    ray.t_min = t_min;
    ray.direction = direction;
    ray.t_max = t_max;
    return ray;
}

// A normal of map space in the world; to_map: WorldToObject3x4. Normals go by the inverse transpose.
float3 spa_normal_to_world(float3 normal, float3x4 to_map) {
    return spa_unit(mul(normal, (float3x3)to_map));
}

#endif
