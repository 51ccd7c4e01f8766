// SPDX-License-Identifier: Apache-2.0
// Traces one ray of a buffer and writes everything that the tracing text says about it to another, the same
// way in C++, GLSL and HLSL. Before it: spa_trace.h, and
//   RAY_WORD(index)      reads a word of the rays
//   RESULT_WORD(index)   is a word of the results
//   TRACE_BUFFERS        parameters that the two need, each with a comma behind it
#ifndef TRACE_RAY_H
#define TRACE_RAY_H

// Words of a ray: origin, t_min, direction, t_max, flags, options of fan and march.
#define RAY_WORDS 10u

// Words of a result. Misses leave all but the first zero.
#define RESULT_HIT 0u
#define RESULT_T 1u
#define RESULT_MAP 2u
#define RESULT_NORMAL 4u
#define RESULT_LAYER 7u
#define RESULT_SIDE 8u
#define RESULT_FRONT 9u
#define RESULT_COLOR 10u
#define RESULT_COVERAGE 13u
#define RESULT_SHADING_NORMAL 14u
#define RESULT_HAS_COLOR 17u
#define RESULT_HAS_NORMAL 18u
#define RESULT_WORDS 19u

#define METHOD_PROJECTIVE 0u
#define METHOD_FAN 1u
#define METHOD_MARCH 2u

SPA_BEGIN

// Any word stands for some options: 0 to 31 test rays, and every choice that there is.
SPA_FUNCTION SpaFan fan_options(uint word) {
    SpaFan options;
    options.count = word & 31u;
    options.count_rule = (word >> 5u) & 1u;
    options.spacing = (word >> 6u) & 1u;
    options.ends = ((word >> 7u) & 3u) % 3u;
    options.pick = (word >> 9u) & 1u;
    options.report = (word >> 10u) & 1u;
    options.shading = ((word >> 11u) & 3u) % 3u;
    options.start = (word >> 13u) & 1u;
    options.filtering = (word >> 14u) & 1u;
    options.empty = (word >> 15u) & 1u;
    return options;
}

SPA_FUNCTION SpaMarch march_options(uint word) {
    SpaMarch options;
    options.steps = word & 31u;
    options.secants = (word >> 5u) & 3u;
    return options;
}

SPA_FUNCTION void trace_ray(TRACE_BUFFERS SpaMap map, uint index, uint method) {
    uint at = RAY_WORDS * index;
    SpaRay ray;
    ray.origin = float3(spa_float(RAY_WORD(at)), spa_float(RAY_WORD(at + 1u)), spa_float(RAY_WORD(at + 2u)));
    ray.t_min = spa_float(RAY_WORD(at + 3u));
    ray.direction =
        float3(spa_float(RAY_WORD(at + 4u)), spa_float(RAY_WORD(at + 5u)), spa_float(RAY_WORD(at + 6u)));
    ray.t_max = spa_float(RAY_WORD(at + 7u));
    uint flags = RAY_WORD(at + 8u);
    uint options = RAY_WORD(at + 9u);

    SpaHit hit = spa_no_hit();
    bool found = false;
    if (method == METHOD_PROJECTIVE) found = spa_trace_projective(map, ray, flags, hit);
    if (method == METHOD_FAN) found = spa_trace_fan(map, ray, fan_options(options), flags, hit);
    if (method == METHOD_MARCH) found = spa_trace_march(map, ray, march_options(options), flags, hit);

    uint result = RESULT_WORDS * index;
    RESULT_WORD(result + RESULT_HIT) = found ? 1u : 0u;
    if (!found) return;
    RESULT_WORD(result + RESULT_T) = spa_bits(hit.t);
    if ((flags & SPA_ANY_HIT) != 0u) return;
    RESULT_WORD(result + RESULT_MAP) = spa_bits(hit.map.x);
    RESULT_WORD(result + RESULT_MAP + 1u) = spa_bits(hit.map.y);
    RESULT_WORD(result + RESULT_NORMAL) = spa_bits(hit.normal.x);
    RESULT_WORD(result + RESULT_NORMAL + 1u) = spa_bits(hit.normal.y);
    RESULT_WORD(result + RESULT_NORMAL + 2u) = spa_bits(hit.normal.z);
    RESULT_WORD(result + RESULT_LAYER) = hit.layer;
    RESULT_WORD(result + RESULT_SIDE) = hit.side;
    RESULT_WORD(result + RESULT_FRONT) = hit.front;

    SpaShade shade = spa_shade(map, hit);
    RESULT_WORD(result + RESULT_COLOR) = spa_bits(shade.color.x);
    RESULT_WORD(result + RESULT_COLOR + 1u) = spa_bits(shade.color.y);
    RESULT_WORD(result + RESULT_COLOR + 2u) = spa_bits(shade.color.z);
    RESULT_WORD(result + RESULT_COVERAGE) = spa_bits(shade.coverage);
    RESULT_WORD(result + RESULT_SHADING_NORMAL) = spa_bits(shade.normal.x);
    RESULT_WORD(result + RESULT_SHADING_NORMAL + 1u) = spa_bits(shade.normal.y);
    RESULT_WORD(result + RESULT_SHADING_NORMAL + 2u) = spa_bits(shade.normal.z);
    RESULT_WORD(result + RESULT_HAS_COLOR) = shade.has_color;
    RESULT_WORD(result + RESULT_HAS_NORMAL) = shade.has_normal;
}

SPA_END

#endif
