// SPDX-License-Identifier: Apache-2.0
// Which of the tracers of ../spa_trace.h runs, and the first hit that is not in a hole. Included by spa.hlsl and
// spa_ray_query.hlsl; by macros given to the compiler (-D):
//   SPA_METHOD          0: projective (the default), 1: fan, 2: march
//   SPA_FAN_COUNT       test rays of the fan; 10
//   SPA_FAN_RULE        SPA_FAN_FIXED or SPA_FAN_BY_DISTANCE; the first
//   SPA_MARCH_STEPS     linear steps of the march; 32
//   SPA_MARCH_SECANTS   refinements after them; 3
//   SPA_THRESHOLD       less coverage than this is a hole; SPA_HOLE_THRESHOLD
#ifndef SPA_METHOD_HLSL
#define SPA_METHOD_HLSL

#include "../spa_hit.h"
#include "../spa_trace.h"

#ifndef SPA_METHOD
#define SPA_METHOD 0
#endif
#ifndef SPA_THRESHOLD
#define SPA_THRESHOLD SPA_HOLE_THRESHOLD
#endif

// flags: of a trace (SPA_CULL_..., SPA_ANY_HIT).
bool spa_trace(SpaMap map, SpaRay ray, uint flags, out SpaHit hit) {
#if SPA_METHOD == 0
    return spa_trace_projective(map, ray, flags, hit);
#elif SPA_METHOD == 1
    SpaFan options = spa_fan_defaults();
#ifdef SPA_FAN_COUNT
    options.count = SPA_FAN_COUNT;
#endif
#ifdef SPA_FAN_RULE
    options.count_rule = SPA_FAN_RULE;
#endif
    return spa_trace_fan(map, ray, options, flags, hit);
#else
    SpaMarch options = spa_march_defaults();
#ifdef SPA_MARCH_STEPS
    options.steps = SPA_MARCH_STEPS;
#endif
#ifdef SPA_MARCH_SECANTS
    options.secants = SPA_MARCH_SECANTS;
#endif
    return spa_trace_march(map, ray, options, flags, hit);
#endif
}

// The first hit that is in no hole, or that lies at `known` or behind it. known: the t of a hit whose record is
// looked for, or one behind all that is to be met.
bool spa_first_hit(SpaMap map, SpaRay ray, uint record_flags, float known, out SpaHit hit) {
    hit = spa_no_hit();
    for (uint n = 0u; n < SPA_MAX_HOLES; n += 1u) {
        if (!spa_trace(map, ray, record_flags & SPA_RECORD_TRACE, hit)) return false;
        if (hit.t >= known) return true;
        if (!spa_in_hole(map, hit, record_flags, SPA_THRESHOLD)) return true;
        ray.t_min = spa_behind(ray, hit.t);
    }
    return false;
}

#endif
