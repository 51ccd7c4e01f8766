// SPDX-License-Identifier: Apache-2.0
// Linear steps, then secants: the trace of distance impostors (Szirmay-Kalos, Aszodi, Lazanyi, Premecz:
// "Approximate Ray-Tracing on the GPU with Distance Impostors", 2005) on the outermost surface, with bilinear
// depths. What lies between two steps is missed.
#ifndef SPA_MARCH_H
#define SPA_MARCH_H

#include "spa_depth.h"

SPA_BEGIN

struct SpaMarch {
    uint steps;   // linear, even in t over the ray's chord of the sphere around the surface; 1 to
                  // SPA_MARCH_LIMIT
    uint secants; // refinements after that, at most SPA_MARCH_LIMIT
};

#define SPA_MARCH_LIMIT 1024u

SPA_FUNCTION SpaMarch spa_march_defaults() {
    SpaMarch options;
    options.steps = 32u;
    options.secants = 3u;
    return options;
}

// How far the ray is above the surface at this time; SPA_FAR where there is no surface.
SPA_FUNCTION float spa_march_height(SPA_IN(SpaMap) map, float3 foot, float3 direction, float time) {
    float3 at = foot + direction * time;
    float depth = spa_depth_bilinear(map, spa_side_of(at, direction));
    if (!(depth > 0.0f)) return SPA_FAR;
    return sqrt(dot(at, at)) - depth;
}

// Between a time on one side of the surface and one on the other.
SPA_FUNCTION float spa_march_between(float time0, float height0, float time1, float height1) {
    // Heights beside a direction without surface say nothing but their sign.
    if (height0 >= SPA_FAR || height1 >= SPA_FAR || height0 == height1) return 0.5f * (time0 + time1);
    float share = height0 / (height0 - height1);
    return time0 + (time1 - time0) * max(0.0f, min(share, 1.0f));
}

// Difference of the depths on both sides of a direction; where there is none, `depth` stands for it.
SPA_FUNCTION float spa_march_slope(SPA_IN(SpaMap) map, float3 direction, float3 step, float depth) {
    float before = spa_depth_bilinear(map, direction - step);
    float behind = spa_depth_bilinear(map, direction + step);
    if (!(before > 0.0f)) before = depth;
    if (!(behind > 0.0f)) behind = depth;
    return behind - before;
}

// The gradient of the height at a point of this direction, by differences over two samples. Not normalised.
SPA_FUNCTION float3 spa_march_normal(SPA_IN(SpaMap) map, float3 at) {
    float length_of = sqrt(dot(at, at));
    float3 up = at * (1.0f / length_of);
    float depth = spa_depth_bilinear(map, up);
    if (!(depth > 0.0f)) return up;
    // Two directions across (Duff et al., "Building an Orthonormal Basis, Revisited", 2017).
    float side = up.z < 0.0f ? -1.0f : 1.0f;
    float a = -1.0f / (side + up.z);
    float b = up.x * up.y * a;
    float3 along = float3(1.0f + side * up.x * up.x * a, side * b, -side * up.x);
    float3 across = float3(b, side + up.y * up.y * a, -up.y);
    float step = SPA_PI / float(max(map.height, 4u));
    float slope0 = spa_march_slope(map, up, along * step, depth) / (2.0f * step * depth);
    float slope1 = spa_march_slope(map, up, across * step, depth) / (2.0f * step * depth);
    return up - along * slope0 - across * slope1;
}

// flags: SPA_CULL_BACK, SPA_CULL_FRONT, SPA_ANY_HIT. Time: four depths a step, and 20 for the normal.
SPA_FUNCTION bool spa_trace_march(SPA_IN(SpaMap) map, SPA_IN(SpaRay) ray, SPA_IN(SpaMarch) options,
                                  uint flags, SPA_OUT(SpaHit) hit) {
    hit = spa_no_hit();
    SpaChord chord;
    if (!(ray.t_min <= ray.t_max)) return false;
    if (!spa_chord(ray, map.radius, chord)) return false;
    bool fronts = (flags & SPA_CULL_FRONT) == 0u;
    bool backs = (flags & SPA_CULL_BACK) == 0u;
    // Where the steps are does not depend on t_min and t_max: those of the whole chord, and its two ends.
    float square = dot(chord.foot, chord.foot);
    float half_chord = sqrt(max(0.0f, map.radius * map.radius - square) / dot(ray.direction, ray.direction));
    uint steps = max(1u, min(options.steps, SPA_MARCH_LIMIT));
    uint secants = min(options.secants, SPA_MARCH_LIMIT);

    float time = chord.t0;
    float height = spa_march_height(map, chord.foot, ray.direction, time);
    bool inside = chord.starts_inside_sphere && height <= 0.0f;
    bool found = !inside && height <= 0.0f && fronts;
    if (!found) inside = height <= 0.0f;
    float last_time = time;
    float last_height = height;
    bool front = true;
    for (uint i = 1u; i <= steps && !found; ++i) {
        float next = half_chord * (2.0f * float(i) / float(steps) - 1.0f);
        next = min(next, chord.t1);
        if (next <= time) continue;
        last_time = time;
        last_height = height;
        time = next;
        height = spa_march_height(map, chord.foot, ray.direction, time);
        bool now = height <= 0.0f;
        if (now == inside) continue;
        inside = now;
        front = now;
        found = now ? fronts : backs;
    }
    // What is solid at the end of the chord ends there.
    bool ends = !found && inside && backs && half_chord <= ray.t_max - chord.foot_t;
    if (!found && !ends) return false;
    if (ends) front = false;

    float found_time = time;
    if (found && last_time < time) {
        found_time = spa_march_between(last_time, last_height, time, height);
        for (uint k = 0u; k < secants; ++k) {
            float middle = spa_march_height(map, chord.foot, ray.direction, found_time);
            if ((middle <= 0.0f) == front) {
                time = found_time;
                height = middle;
            } else {
                last_time = found_time;
                last_height = middle;
            }
            found_time = spa_march_between(last_time, last_height, time, height);
        }
    }
    hit.t = max(ray.t_min, min(chord.foot_t + found_time, ray.t_max));
    if ((flags & SPA_ANY_HIT) != 0u) return true;
    float3 at = spa_side_of(chord.foot + ray.direction * found_time, ray.direction);
    hit.map = spa_place(map.mapping, at);
    hit.normal = spa_march_normal(map, at);
    hit.front = front ? 1u : 0u;
    return true;
}

SPA_END

#endif
