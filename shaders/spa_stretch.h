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
// do not fall: flip_x is 2^levels - 1 where x is turned (x = 2^levels - place), else 0; so is flip_y.
struct SpaStretch {
    float x0; // turned, at sigma = 0
    float y0;
    float w0;
    float dx; // over the whole stretch; dx, dy >= 0
    float dy;
    float dw;
    uint flip_x;
    uint flip_y;
    float end_x; // the quadrant's border in turned x: never crossed
    float end_y;
    uint quadrant; // bit 0: x < 0, bit 1: y < 0
    float3 signs;
    float ta; // of the chord, at sigma = 0 and 1
    float tb;
};

// -1 or 1: the side of a coordinate plane on which the ray is at time `at`, if it crosses the plane at
// `crossing`.
SPA_FUNCTION float spa_sign(float position, float direction, float crossing, float at) {
    if (direction == 0.0f) return position < 0.0f ? -1.0f : 1.0f;
    float before = direction > 0.0f ? -1.0f : 1.0f;
    return at < crossing ? before : -before;
}

// When the ray crosses a coordinate plane, within the chord: clamped before anything sorts or subtracts it.
SPA_FUNCTION float spa_crossing(float position, float direction, float t0, float t1) {
    if (direction == 0.0f) return t1;
    return min(max(-position / direction, t0), t1);
}

// Between the times ta < tb, which lie in one octant. False: the stretch lies in the core and is left out.
SPA_FUNCTION bool spa_stretch(SpaMap map, float3 foot, float3 direction, float3 crossings, float ta, float tb,
                              SPA_OUT(SpaStretch) stretch) {
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
    stretch.quadrant = (sx < 0.0f ? 1u : 0u) | (sy < 0.0f ? 2u : 0u);
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
    xa = min(xa, 1.0f) * half_cells;
    ya = min(ya, 1.0f) * half_cells;
    xb = min(xb, 1.0f) * half_cells;
    yb = min(yb, 1.0f) * half_cells;
    bool turn_x = xb < xa;
    bool turn_y = yb < ya;
    stretch.flip_x = turn_x ? (1u << map.levels) - 1u : 0u;
    stretch.flip_y = turn_y ? (1u << map.levels) - 1u : 0u;
    stretch.end_x = turn_x ? side : half_cells;
    stretch.end_y = turn_y ? side : half_cells;
    stretch.x0 = turn_x ? side - xa : xa;
    stretch.y0 = turn_y ? side - ya : ya;
    stretch.dx = (turn_x ? side - xb : xb) - stretch.x0;
    stretch.dy = (turn_y ? side - yb : yb) - stretch.y0;
    stretch.w0 = wa;
    stretch.dw = wb - wa;
    return outside;
}

// The time of a place on the stretch.
SPA_FUNCTION float spa_time(SpaStretch stretch, float sigma) {
    float w1 = stretch.w0 + stretch.dw;
    float start = stretch.ta * stretch.w0;
    float t = (start + sigma * (stretch.tb * w1 - start)) / (stretch.w0 + sigma * stretch.dw);
    return min(max(t, stretch.ta), stretch.tb);
}

SPA_END

#endif
