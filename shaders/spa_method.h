// SPDX-License-Identifier: Apache-2.0
// The tracers behind one function, chosen by a number.
#ifndef SPA_METHOD_H
#define SPA_METHOD_H

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

// The next greater float of a finite one.
SPA_FUNCTION float spa_next_float(float value) {
    uint bits = spa_bits(value);
    if (value == 0.0f) return spa_float(1u);
    return spa_float(value > 0.0f ? bits + 1u : bits - 1u);
}

// Hits of one ray that coverage may let it pass through. Solid texels end the search; where a map holds nothing
// but holes, it ends here.
#define SPA_COVERAGE_LIMIT 16u

// The first hit whose stored coverage is at least `coverage`, and its shade. coverage 0: the first hit. Without
// SPA_ANY_HIT.
SPA_FUNCTION bool spa_trace_covered(SPA_IN(SpaMap) map, SPA_IN(SpaRay) ray, SPA_IN(SpaMethod) method, uint flags,
                                    float coverage, SPA_OUT(SpaHit) hit) {
    SpaRay rest = ray;
    hit = spa_no_hit();
    for (uint i = 0u; i < SPA_COVERAGE_LIMIT; ++i) {
        if (!spa_trace(map, rest, method, flags, hit)) return false;
        if (coverage <= 0.0f) return true;
        if (spa_shade(map, hit).coverage >= coverage) return true;
        rest.t_min = spa_next_float(hit.t);
    }
    return false;
}

SPA_END

#endif
