// SPDX-License-Identifier: Apache-2.0
// The fan trace: test rays from the centre to points of the ray, as in "Real-Time Ray Tracing with
// Spherically Projected Object Data" (Winn, Garmsen, Humer, Eckhardt), section 2.3. A point x of the ray
// within the bounding sphere is a hit when |x| <= r(direction of x), the outermost depth stored there.
//
// What the paper leaves open is an option of SpaFan, each with a name; the defaults are spa_fan_defaults().
// One of its sentences contradicts another: more test rays are needed the closer the ray passes to the
// centre, which is what SPA_FAN_BY_DISTANCE does.
#ifndef SPA_FAN_H
#define SPA_FAN_H

#include "spa_depth.h"

SPA_BEGIN

// How many test rays.
#define SPA_FAN_FIXED 0u // SpaFan.count
#define SPA_FAN_BY_DISTANCE                                                                                  \
    1u // 1 + round((count - 1) (1 - d2)), d2 = distance of the ray from the centre / R

// Where on the secant the test points lie.
#define SPA_FAN_EVEN_T 0u     // even in t
#define SPA_FAN_EVEN_ANGLE 1u // even in the angle seen from the centre

// Of N test points, i = 0 .. N-1; where N = 1 it is the perpendicular's foot in every case.
#define SPA_FAN_WITHOUT_ENDS 0u // the secant's share (i + 1)/(N + 1)
#define SPA_FAN_WITH_ENDS 1u    // i/(N - 1): the first and the last test point lie on the sphere
#define SPA_FAN_HALF_ENDS 2u    // (i + 1/2)/N

// Which of several hits counts.
#define SPA_FAN_FIRST 0u  // the first along the ray
#define SPA_FAN_MIDDLE 1u // any: the perpendicular is tested first, then outwards

// Which t is reported.
#define SPA_FAN_T_POINT 0u  // the test point's
#define SPA_FAN_T_SPHERE 1u // where the ray enters the sphere, or begins in it

// Which test ray says where on the map the hit is, and so its colour and normal.
#define SPA_FAN_SHADE_HIT 0u    // the one that hit
#define SPA_FAN_SHADE_FOOT 1u   // the perpendicular
#define SPA_FAN_SHADE_SPHERE 2u // where the ray enters the sphere, or begins in it

// Rays that begin in the solid.
#define SPA_FAN_START_HITS 0u   // have their first test point as a front hit
#define SPA_FAN_START_LEAVES 1u // leave it first: a back hit at the first test point outside

// Which depth a test ray is compared with.
#define SPA_FAN_NEAREST 0u
#define SPA_FAN_BILINEAR 1u

// Directions without surface.
#define SPA_FAN_EMPTY_MISSES 0u
#define SPA_FAN_EMPTY_IS_SPHERE 1u // depth R

struct SpaFan {
    uint
        count; // 0: the sphere itself is hit. At most SPA_FAN_LIMIT; the paper has 0, 1, 3, 5, 10 and 1 to 50
    uint count_rule;
    uint spacing;
    uint ends;
    uint pick; // SPA_FAN_MIDDLE knows front hits alone, of whatever begins in the solid too
    uint report;
    uint shading;
    uint start;
    uint filtering;
    uint empty;
};

#define SPA_FAN_LIMIT 1024u

SPA_FUNCTION SpaFan spa_fan_defaults() {
    SpaFan options;
    options.count = 10u;
    options.count_rule = SPA_FAN_FIXED;
    options.spacing = SPA_FAN_EVEN_T;
    options.ends = SPA_FAN_WITHOUT_ENDS;
    options.pick = SPA_FAN_FIRST;
    options.report = SPA_FAN_T_POINT;
    options.shading = SPA_FAN_SHADE_HIT;
    options.start = SPA_FAN_START_HITS;
    options.filtering = SPA_FAN_NEAREST;
    options.empty = SPA_FAN_EMPTY_MISSES;
    return options;
}

// The whole secant, whatever t_min and t_max are: where the test points lie does not depend on what else a
// ray has met. Times are relative to the foot.
struct SpaSecant {
    float3 foot;
    float3 direction;
    float distance; // of the foot from the centre
    float half_time;
    float half_angle; // from the foot to an end, seen from the centre
    float speed;      // length of the direction
};

SPA_FUNCTION SpaSecant spa_secant(SPA_IN(SpaChord) chord, float3 direction) {
    SpaSecant secant;
    float dd = dot(direction, direction);
    float square = dot(chord.foot, chord.foot);
    secant.foot = chord.foot;
    secant.direction = direction;
    secant.distance = sqrt(square);
    secant.half_time = sqrt(max(0.0f, 1.0f - square) / dd);
    secant.speed = sqrt(dd);
    secant.half_angle = spa_atan2(secant.half_time * secant.speed, secant.distance);
    return secant;
}

SPA_FUNCTION uint spa_fan_count(SPA_IN(SpaFan) options, float distance) {
    uint count = min(options.count, SPA_FAN_LIMIT);
    if (options.count_rule == SPA_FAN_FIXED || count == 0u) return count;
    float share = max(0.0f, 1.0f - distance);
    return 1u + uint(floor(float(count - 1u) * share + 0.5f));
}

// When the ray is at test point i of `count`.
SPA_FUNCTION float spa_fan_time(SPA_IN(SpaFan) options, SpaSecant secant, uint i, uint count) {
    float place = float(i + 1u) / float(count + 1u);
    if (options.ends == SPA_FAN_WITH_ENDS) place = count > 1u ? float(i) / float(count - 1u) : 0.5f;
    if (options.ends == SPA_FAN_HALF_ENDS) place = (float(i) + 0.5f) / float(count);
    float side = 2.0f * place - 1.0f; // -1 and 1: the ends
    // A ray through the centre sees its points under two angles alone.
    if (options.spacing == SPA_FAN_EVEN_T || secant.distance < SPA_CENTER) return side * secant.half_time;
    float angle = side * secant.half_angle;
    float cosine = spa_sin(0.5f * SPA_PI - abs(angle));
    float time = secant.distance * spa_sin(angle) / (max(cosine, 1e-7f) * secant.speed);
    return max(-secant.half_time, min(time, secant.half_time));
}

// The order of SPA_FAN_MIDDLE: 0, 1, 2, ... to the middle, the one before it, the one behind it, ...
SPA_FUNCTION uint spa_fan_from_middle(uint k, uint count) {
    uint middle = (count - 1u) / 2u;
    // The middle of an even count has one more behind it than before it.
    return (k & 1u) == 1u ? middle + (k + 1u) / 2u : middle - k / 2u;
}

SPA_FUNCTION bool spa_fan_inside(SPA_IN(SpaMap) map, SPA_IN(SpaFan) options, SpaSecant secant, float time) {
    float3 at = secant.foot + secant.direction * time;
    float3 side = spa_side_of(at, secant.direction);
    float depth = 0.0f;
    if (options.filtering == SPA_FAN_NEAREST)
        depth = spa_depth_nearest(map, side);
    else
        depth = spa_depth_bilinear(map, side);
    if (!(depth > 0.0f)) {
        if (options.empty == SPA_FAN_EMPTY_MISSES) return false;
        depth = 1.0f;
    }
    return dot(at, at) <= depth * depth;
}

SPA_FUNCTION SpaHit spa_fan_hit(SPA_IN(SpaMap) map, SPA_IN(SpaRay) ray, SPA_IN(SpaFan) options,
                                SpaSecant secant, SPA_IN(SpaChord) chord, float time, bool front) {
    SpaHit hit = spa_no_hit();
    float reported = options.report == SPA_FAN_T_SPHERE && front ? chord.t0 : time;
    hit.t = max(ray.t_min, min(chord.foot_t + reported, ray.t_max));
    float3 shading = secant.foot + secant.direction * time;
    if (options.shading == SPA_FAN_SHADE_FOOT) shading = secant.foot;
    if (options.shading == SPA_FAN_SHADE_SPHERE) shading = secant.foot + secant.direction * chord.t0;
    shading = spa_side_of(shading, secant.direction);
    hit.map = spa_place(map.mapping, shading);
    hit.front = front ? 1u : 0u;
    // The test ray's own direction, unless the ray would come from the wrong side of it.
    hit.normal = shading;
    float slope = dot(shading, secant.direction);
    if (front && slope >= 0.0f) hit.normal = secant.direction * (-1.0f / secant.speed);
    if (!front && slope <= 0.0f) hit.normal = secant.direction * (1.0f / secant.speed);
    return hit;
}

// flags: SPA_CULL_BACK, SPA_CULL_FRONT. The hit's normal is the direction from the centre or, where the ray
// would come from behind it, the ray's: the paper shades with the stored normal (spa_shade). Time: one depth
// a test ray.
SPA_FUNCTION bool spa_trace_fan(SPA_IN(SpaMap) map, SPA_IN(SpaRay) ray, SPA_IN(SpaFan) options, uint flags,
                                SPA_OUT(SpaHit) hit) {
    hit = spa_no_hit();
    SpaChord chord;
    if (!(ray.t_min <= ray.t_max)) return false;
    if (!spa_chord(ray, 1.0f, chord)) return false;
    SpaSecant secant = spa_secant(chord, ray.direction);
    bool fronts = (flags & SPA_CULL_FRONT) == 0u;
    bool backs = (flags & SPA_CULL_BACK) == 0u;
    uint count = spa_fan_count(options, secant.distance);

    // The sphere itself is a solid too: entered at one end of the secant, left at the other.
    bool inside = count == 0u && chord.starts_inside_sphere;
    if (count == 0u && !inside) {
        if (fronts) {
            hit = spa_fan_hit(map, ray, options, secant, chord, chord.t0, true);
            return true;
        }
        inside = true;
    }
    bool in_order = options.pick == SPA_FAN_FIRST;
    bool leaves = options.start == SPA_FAN_START_LEAVES || !fronts;
    if (count > 0u && in_order && leaves && chord.starts_inside_sphere)
        inside = spa_fan_inside(map, options, secant, chord.t0);

    for (uint k = 0u; k < count; ++k) {
        uint i = in_order ? k : spa_fan_from_middle(k, count);
        float time = spa_fan_time(options, secant, i, count);
        if (time < chord.t0 || time > chord.t1) continue;
        bool now = spa_fan_inside(map, options, secant, time);
        if (now == inside) continue;
        inside = now && in_order;
        if (now ? fronts : backs) {
            hit = spa_fan_hit(map, ray, options, secant, chord, time, now);
            return true;
        }
    }
    // What is solid at the last test point ends at the sphere.
    if (!inside || !backs || !(secant.half_time <= ray.t_max - chord.foot_t)) return false;
    hit = spa_fan_hit(map, ray, options, secant, chord, secant.half_time, false);
    return true;
}

SPA_END

#endif
