// SPDX-License-Identifier: Apache-2.0
// The tracers behind one function, chosen by a number.
#ifndef SPA_METHOD_H
#define SPA_METHOD_H

#include "spa_hit.h"
#include "spa_trace.h"

SPA_BEGIN

#define SPA_PROJECTIVE 0u
#define SPA_FAN 1u
#define SPA_MARCH 2u

struct SpaMethod {
    uint tracer; // SPA_PROJECTIVE, SPA_FAN or SPA_MARCH
    SpaFan fan;
    SpaMarch march;
};

SPA_FUNCTION SpaMethod spa_method_defaults(uint tracer) {
    SpaMethod method;
    method.tracer = tracer;
    method.fan = spa_fan_defaults();
    method.march = spa_march_defaults();
    return method;
}

SPA_FUNCTION bool spa_trace(SPA_IN(SpaMap) map, SPA_IN(SpaRay) ray, SPA_IN(SpaMethod) method, uint flags,
                            SPA_OUT(SpaHit) hit) {
    bool found = false;
    hit = spa_no_hit();
    if (method.tracer == SPA_PROJECTIVE) found = spa_trace_projective(map, ray, flags, hit);
    if (method.tracer == SPA_FAN) found = spa_trace_fan(map, ray, method.fan, flags, hit);
    if (method.tracer == SPA_MARCH) found = spa_trace_march(map, ray, method.march, flags, hit);
    return found;
}

// The first hit of a shader record's map that is not in a hole (spa_hit.h). record_flags: without
// SPA_ANY_HIT.
SPA_FUNCTION bool spa_trace_record(SPA_IN(SpaMap) map, SPA_IN(SpaRay) ray, SPA_IN(SpaMethod) method,
                                   uint record_flags, float threshold, SPA_OUT(SpaHit) hit) {
    SpaRay rest = ray;
    hit = spa_no_hit();
    for (uint n = 0u; n < SPA_MAX_HOLES; n += 1u) {
        if (!spa_trace(map, rest, method, record_flags & SPA_RECORD_TRACE, hit)) return false;
        if (!spa_in_hole(map, hit, record_flags, threshold)) return true;
        rest.t_min = spa_behind(rest, hit.t);
    }
    return false;
}

SPA_END

#endif
