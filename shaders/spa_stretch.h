// SPDX-License-Identifier: Apache-2.0
// The stretch of a ray in one octant, as the octahedral map sees it: a straight segment.
//
// With the octant's signs, A = s.x p.x, B = s.y p.y, C = s.z p.z and l = A + B + C are linear in t. The
// octahedral map places p at (A, B)/l towards its middle (z >= 0) and at (A + C, B + C)/l towards its
// corners, and w = 1/l: a projective map either way, so the ray is straight in (x, y, w), and everything is
// linear in sigma, 0 at the stretch's start and 1 at its end. t is not: t = (ta wa + sigma (tb wb - ta wa)) /
// w(sigma).
#ifndef SPA_STRETCH_H
#define SPA_STRETCH_H

#include "spa_map.h"

SPA_BEGIN

// x and y count cells from the map's middle, in one quadrant. Traversal goes along axes turned so that they
// do not fall: a turned x is 2^levels - x. Of turned cells, x ^ flip_x is the place on the whole map: in the
// low `levels` bits the cell counted from the middle, in the next one the side of the middle (1: negative x).
struct SpaStretch {
    float x0; // turned, at sigma = 0; below 2^levels
    float y0;
    float w0;
    float dx; // over the whole stretch; dx, dy >= 0
    float dy;
    float dw;
    uint flip_x;
    uint flip_y;
    float3 signs;
    float ta; // of the chord, at sigma = 0 and 1
    float tb;
};

// Smaller parts of a direction count as zero.
#define SPA_TINY 1e-30f
// The greatest float below 1.
#define SPA_BELOW_ONE 0.99999994f

// -1 or 1: the side of a coordinate plane on which the ray is at time `at`, if it crosses the plane at
// `crossing`.
SPA_FUNCTION float spa_sign(float position, float direction, float crossing, float at) {
    if (abs(direction) < SPA_TINY) return position < 0.0f ? -1.0f : 1.0f;
    float before = direction > 0.0f ? -1.0f : 1.0f;
    return at < crossing ? before : -before;
}

// When the ray crosses a coordinate plane, within the chord: clamped before anything sorts or subtracts it.
// per: 1 / direction.
SPA_FUNCTION float spa_crossing(float position, float direction, float per, float t0, float t1) {
    if (abs(direction) < SPA_TINY) return t1;
    return min(max(-position * per, t0), t1);
}

// Between the times ta < tb, which lie in one octant. False: the stretch lies in the core and is left out.
SPA_FUNCTION bool spa_stretch(SPA_IN(SpaMap) map, float3 foot, float3 direction, float3 crossings, float ta,
                              float tb, SPA_OUT(SpaStretch) stretch) {
    float half_cells = float(map.width - 1u) * 0.5f;
    float side = float(1u << map.levels);
    float middle = (ta + tb) * 0.5f;
    float sx = spa_sign(foot.x, direction.x, crossings.x, middle);
    float sy = spa_sign(foot.y, direction.y, crossings.y, middle);
    float sz = spa_sign(foot.z, direction.z, crossings.z, middle);
    // Rounding may leave the octant by a bit; the map has nothing there.
    float3 a =
        float3(max(sx * (foot.x + direction.x * ta), 0.0f), max(sy * (foot.y + direction.y * ta), 0.0f),
               max(sz * (foot.z + direction.z * ta), 0.0f));
    float3 b =
        float3(max(sx * (foot.x + direction.x * tb), 0.0f), max(sy * (foot.y + direction.y * tb), 0.0f),
               max(sz * (foot.z + direction.z * tb), 0.0f));
    float la = a.x + a.y + a.z;
    float lb = b.x + b.y + b.z;
    stretch.signs = float3(sx, sy, sz);
    float core = 1.0f / map.w_core;
    float fa = 0.0f;
    float fb = 1.0f;
    if (la < core) fa = (core - la) / (lb - la);
    if (lb < core) fb = (core - la) / (lb - la);
    bool outside = (la >= core || lb >= core) && fa < fb;
    float3 step = b - a;
    if (lb < core) {
        b = a + step * fb;
        lb = core;
    }
    if (la < core) {
        a = a + step * fa;
        la = core;
    }
    stretch.ta = ta + (tb - ta) * fa;
    stretch.tb = fb < 1.0f ? ta + (tb - ta) * fb : tb;
    float wa = 1.0f / la;
    float wb = 1.0f / lb;
    bool lower = sz < 0.0f;
    float xa = (lower ? a.x + a.z : a.x) * wa;
    float ya = (lower ? a.y + a.z : a.y) * wa;
    float xb = (lower ? b.x + b.z : b.x) * wb;
    float yb = (lower ? b.y + b.z : b.y) * wb;
    xa = min(xa, SPA_BELOW_ONE) * half_cells;
    ya = min(ya, SPA_BELOW_ONE) * half_cells;
    xb = min(xb, SPA_BELOW_ONE) * half_cells;
    yb = min(yb, SPA_BELOW_ONE) * half_cells;
    bool turn_x = xb < xa;
    bool turn_y = yb < ya;
    uint low_bits = (1u << map.levels) - 1u;
    stretch.flip_x = (turn_x ? low_bits : 0u) | (sx < 0.0f ? low_bits + 1u : 0u);
    stretch.flip_y = (turn_y ? low_bits : 0u) | (sy < 0.0f ? low_bits + 1u : 0u);
    float last = side * SPA_BELOW_ONE;
    stretch.x0 = turn_x ? min(side - xa, last) : xa;
    stretch.y0 = turn_y ? min(side - ya, last) : ya;
    stretch.dx = max((turn_x ? side - xb : xb) - stretch.x0, 0.0f);
    stretch.dy = max((turn_y ? side - yb : yb) - stretch.y0, 0.0f);
    stretch.w0 = wa;
    stretch.dw = wb - wa;
    return outside;
}

// The time of a place on the stretch.
SPA_FUNCTION float spa_time(SPA_IN(SpaStretch) stretch, float sigma) {
    float w1 = stretch.w0 + stretch.dw;
    float start = stretch.ta * stretch.w0;
    float t = (start + sigma * (stretch.tb * w1 - start)) / (stretch.w0 + sigma * stretch.dw);
    return min(max(t, stretch.ta), stretch.tb);
}

SPA_END

#endif
