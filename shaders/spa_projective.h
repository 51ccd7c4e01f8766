// SPDX-License-Identifier: Apache-2.0
// The projective trace: exact for the stored surface (../docs/tracing.md), on octahedral maps.
//
// In each octant that the ray crosses (at most four) it is a straight segment over the map's cells with w
// linear in sigma (spa_stretch.h). Over each quadrant lies a pyramid of nodes with the ranges of w in which
// anything is solid below them. A node that the ray's own range of w misses is skipped as a whole; otherwise
// the walk goes down, and at a cell the ray is clipped against what stands there (spa_cell.h). Stack-free:
// the place is a pair of integers that only grow, and the level goes up by one where a parent's border is
// crossed.
#ifndef SPA_PROJECTIVE_H
#define SPA_PROJECTIVE_H

#include "spa_cell.h"
#include "spa_stretch.h"

SPA_BEGIN

// The walk begins with 2^SPA_START_BITS nodes a side of a quadrant and climbs to 2^SPA_TOP_BITS where nothing
// is near.
#define SPA_START_BITS 4u
#define SPA_TOP_BITS 2u
// Before and after any time.
#define SPA_NEVER 1e20f
// Borders of nodes are passed this much later than they lie, relative to the stretch: more than rounding
// takes off, so that no stretch is left before its end.
#define SPA_LATER 1.0000004f

// A ray that is beyond a cell's diagonal by less than this, in units of the map's width in cells, is not: it
// is rounding, as at the end of a stretch where the diagonal is the border of its octant.
#define SPA_DIAGONAL 2.4e-7f

// The float of a node's code. Codes are rounded outward: a lower end comes out no greater, an upper end no
// less.
SPA_FUNCTION float spa_decode(SPA_IN(SpaMap) map, uint code) {
    return spa_float(map.code_base + (code << map.code_shift));
}

SPA_FUNCTION bool spa_meets(SPA_IN(SpaMap) map, uint range, float low, float high) {
    return high >= spa_decode(map, range & 0xFFFFu) && low <= spa_decode(map, range >> 16u);
}

// The place of (x, y), counted on the whole map (SpaStretch), among the nodes of a level with 2^bits a side
// of a quadrant: the coarsest level comes first, in a level row by row.
SPA_FUNCTION uint spa_node(uint bits, uint x, uint y) {
    uint before = 0x55555554u & ~(0xFFFFFFFCu << (2u * bits)); // 4 (4^bits - 1)/3
    return before + (y << (bits + 1u)) + x;
}

// x and y: a cell on the whole map.
SPA_FUNCTION SpaTriangle spa_triangle(SPA_IN(SpaMap) map, uint x, uint y, uint beyond) {
    SpaTriangle tri;
    uint middle = (map.width - 1u) / 2u;
    uint low_bits = (1u << map.levels) - 1u;
    tri.step_x = x <= low_bits ? 1u : 0xFFFFFFFFu;
    tri.step_y = y <= low_bits ? 0u - map.width : map.width;
    tri.corner = middle * map.width + middle + (x & low_bits) * tri.step_x + (y & low_bits) * tri.step_y;
    tri.beyond = beyond;
    tri.prisms = SPA_PURE;
    tri.layers = 1u;
    tri.first = 0u;
    tri.low = 0.0f;
    tri.high = SPA_FAR;
    if (map.cells != 0u) {
        uint lists = spa_load(map.words, map.cells + (y << (map.levels + 1u)) + x);
        if (lists != SPA_CELL_PURE) tri.layers = (map.surfaces + 1u) / 2u;
        if (lists > SPA_CELL_LAYERS) {
            uint list = lists + SPA_LIST_WORDS * beyond;
            tri.first = spa_load(map.words, list);
            tri.prisms = spa_load(map.words, list + 1u);
            tri.low = spa_float(spa_load(map.words, list + 2u));
            tri.high = spa_float(spa_load(map.words, list + 3u));
        }
    }
    return tri;
}

// Whether a coordinate is turned.
SPA_FUNCTION bool spa_turned(uint flip) { return (flip & 1u) != 0u; }

// The ray from sigma s0 to s1 in the cell (x, y), places turned as in the stretch. True: `event`, in `piece`
// and `tri`, is to be reported.
SPA_FUNCTION bool spa_cross_cell(SPA_IN(SpaMap) map, SPA_IN(SpaStretch) stretch, uint x, uint y, float s0,
                                 float s1, uint flags, SPA_INOUT(uint) state, SPA_INOUT(SpaEvent) event,
                                 SPA_INOUT(SpaPiece) piece, SPA_INOUT(SpaTriangle) tri) {
    float u0 = stretch.x0 + s0 * stretch.dx - float(x);
    float v0 = stretch.y0 + s0 * stretch.dy - float(y);
    float u1 = stretch.x0 + s1 * stretch.dx - float(x);
    float v1 = stretch.y0 + s1 * stretch.dy - float(y);
    if (spa_turned(stretch.flip_x)) {
        u0 = 1.0f - u0;
        u1 = 1.0f - u1;
    }
    if (spa_turned(stretch.flip_y)) {
        v0 = 1.0f - v0;
        v1 = 1.0f - v1;
    }
    float w0 = stretch.w0 + s0 * stretch.dw;
    float w1 = stretch.w0 + s1 * stretch.dw;
    float g0 = u0 + v0 - 1.0f; // beyond the diagonal
    float g1 = u1 + v1 - 1.0f;
    float least = SPA_DIAGONAL * float(map.width - 1u);
    bool two = (g0 < -least && g1 > least) || (g0 > least && g1 < -least);
    float f = two ? g0 / (g0 - g1) : 1.0f;
    float sm = two ? s0 + (s1 - s0) * f : s1;
    float um = two ? u0 + (u1 - u0) * f : u1;
    float vm = two ? v0 + (v1 - v0) * f : v1;
    float wm = two ? w0 + (w1 - w0) * f : w1;
    uint beyond = g0 + g1 > 0.0f ? 1u : 0u;
    if (two) beyond = g0 > 0.0f ? 1u : 0u;
    for (uint n = 0u; n < 2u; n += 1u) {
        piece.s0 = n == 0u ? s0 : sm;
        piece.u0 = n == 0u ? u0 : um;
        piece.v0 = n == 0u ? v0 : vm;
        piece.w0 = n == 0u ? w0 : wm;
        piece.s1 = n == 0u ? sm : s1;
        piece.u1 = n == 0u ? um : u1;
        piece.v1 = n == 0u ? vm : v1;
        piece.w1 = n == 0u ? wm : w1;
        tri = spa_triangle(map, x ^ stretch.flip_x, y ^ stretch.flip_y, n == 0u ? beyond : 1u - beyond);
        bool meets = state != SPA_OUTSIDE ||
                     (max(piece.w0, piece.w1) >= tri.low && min(piece.w0, piece.w1) <= tri.high);
        bool found = false;
        if (meets) found = spa_cross(map, tri, piece, flags, state, event);
        if (found) return true;
        if (!two) return false;
    }
    return false;
}

// The gradient of plane(p) * l(p), linear in map space, for a plane over the cell (x, y) (w - plane = 0 is
// the same as plane * l = 1).
SPA_FUNCTION float3 spa_gradient(SPA_IN(SpaMap) map, SPA_IN(SpaStretch) stretch, SpaPlane plane, uint x,
                                 uint y, uint beyond) {
    uint cells = (map.width - 1u) / 2u;
    float gx = plane.u * float(cells);
    float gy = plane.v * float(cells);
    float gl = plane.c - plane.u * float(x) - plane.v * float(y);
    bool upper = x + y + beyond < cells;
    float3 gradient = float3(gl + gx, gl + gy, upper ? gl : gl + gx + gy);
    return float3(stretch.signs.x * gradient.x, stretch.signs.y * gradient.y,
                  upper ? gradient.z : -gradient.z);
}

// plane(p) * l(p) at time t, evaluated from the cell's corner.
SPA_FUNCTION float spa_plane_at(SPA_IN(SpaMap) map, SPA_IN(SpaStretch) stretch, float3 foot, float3 direction,
                                SpaPlane plane, uint x, uint y, float t) {
    uint half_cells = (map.width - 1u) / 2u;
    float cells = float(half_cells);
    float a = stretch.signs.x * (foot.x + direction.x * t);
    float b = stretch.signs.y * (foot.y + direction.y * t);
    float c = stretch.signs.z * (foot.z + direction.z * t);
    float l = a + b + c;
    if (stretch.signs.z < 0.0f) {
        a = a + c;
        b = b + c;
    }
    return plane.c * l + plane.u * (cells * a - float(x) * l) + plane.v * (cells * b - float(y) * l);
}

// Fills the record of an event.
SPA_FUNCTION SpaHit spa_finish(SPA_IN(SpaMap) map, SPA_IN(SpaRay) ray, SPA_IN(SpaChord) chord,
                               SPA_IN(SpaStretch) stretch, SPA_IN(SpaEvent) event, SPA_IN(SpaPiece) piece,
                               SPA_IN(SpaTriangle) tri, uint x, uint y) {
    uint low_bits = (1u << map.levels) - 1u;
    uint real_x = (x ^ stretch.flip_x) & low_bits;
    uint real_y = (y ^ stretch.flip_y) & low_bits;
    bool surface = event.by == SPA_BY_OUTER || event.by == SPA_BY_INNER;
    float t = spa_time(stretch, event.s);
    if (surface) {
        // The plane itself is linear in t, which loses less than sigma does.
        float ta = spa_time(stretch, piece.s0);
        float tb = spa_time(stretch, piece.s1);
        float ga =
            spa_plane_at(map, stretch, chord.foot, ray.direction, event.plane, real_x, real_y, ta) - 1.0f;
        float gb =
            spa_plane_at(map, stretch, chord.foot, ray.direction, event.plane, real_x, real_y, tb) - 1.0f;
        // Its value falls where the ray enters by an outer end or leaves by an inner one, else it rises.
        bool falls = event.front == (event.by == SPA_BY_OUTER);
        // Unless the ray all but runs along the plane.
        bool crosses = falls ? ga >= 0.0f && gb < 0.0f : ga < 0.0f && gb >= 0.0f;
        if (crosses && abs(ga - gb) > SPA_ALONG) t = min(max(ta + (tb - ta) * (ga / (ga - gb)), ta), tb);
    }
    float3 normal = spa_gradient(map, stretch, event.plane, real_x, real_y, tri.beyond);
    if (event.by != SPA_BY_OUTER) normal = normal * -1.0f;
    float px = stretch.x0 + event.s * stretch.dx;
    float py = stretch.y0 + event.s * stretch.dy;
    float side = float(1u << map.levels);
    if (spa_turned(stretch.flip_x)) px = side - px;
    if (spa_turned(stretch.flip_y)) py = side - py;
    float cells = float(map.width - 1u);
    SpaHit hit;
    hit.t = min(max(t + chord.foot_t, ray.t_min), ray.t_max);
    hit.map = float2(0.5f + stretch.signs.x * px / cells, 0.5f - stretch.signs.y * py / cells);
    hit.normal = normal;
    hit.layer = event.layer;
    hit.side = surface ? (event.by == SPA_BY_OUTER ? SPA_OUTER : SPA_INNER) : SPA_WALL;
    hit.front = event.front ? 1u : 0u;
    return hit;
}

// Where a walk over a stretch has come to.
struct SpaWalk {
    uint x; // turned
    uint y;
    float s0;
    float s1;
};

// Follows one stretch. True: the ray has an event to report in the cell of `walk`.
SPA_FUNCTION bool spa_walk(SPA_IN(SpaMap) map, SPA_IN(SpaStretch) stretch, uint flags, SPA_INOUT(uint) state,
                           SPA_INOUT(SpaEvent) event, SPA_INOUT(SpaPiece) piece, SPA_INOUT(SpaTriangle) tri,
                           SPA_INOUT(SpaWalk) walk) {
    uint top = map.levels > SPA_TOP_BITS ? map.levels - SPA_TOP_BITS : 0u;
    uint words = (map.flags & SPA_MAP_TWO_RANGES) != 0u ? 2u : 1u;
    uint level = map.levels > SPA_START_BITS ? map.levels - SPA_START_BITS : 0u;
    float per_x = SPA_LATER / max(stretch.dx, 1e-20f);
    float per_y = SPA_LATER / max(stretch.dy, 1e-20f);
    uint last = (1u << map.levels) - 1u;
    uint x = uint(stretch.x0);
    uint y = uint(stretch.y0);
    float s = 0.0f;
    // x + y grows with every step that does not go down.
    uint bound = 2u * (last + 2u) * (top + 2u);
    for (uint step = 0u; step < bound; step += 1u) {
        if (state == SPA_UNKNOWN || (state == SPA_INSIDE && map.cores == 0u)) level = 0u;
        uint next_x = ((x >> level) + 1u) << level;
        uint next_y = ((y >> level) + 1u) << level;
        float exit_x = (float(next_x) - stretch.x0) * per_x;
        float exit_y = (float(next_y) - stretch.y0) * per_y;
        float s1 = max(min(min(exit_x, exit_y), 1.0f), s);
        float wa = stretch.w0 + s * stretch.dw;
        float wb = stretch.w0 + s1 * stretch.dw;
        float low = min(wa, wb);
        float high = max(wa, wb);
        // Whether the node has something to look for: an end of the solid, from outside or from inside.
        bool meets = true;
        uint node =
            spa_node(map.levels - level, (x ^ stretch.flip_x) >> level, (y ^ stretch.flip_y) >> level);
        if (state == SPA_OUTSIDE) {
            uint range = spa_load(map.words, map.nodes + words * node);
            if (words == 1u) {
                meets = high >= spa_float(range);
            } else {
                meets = spa_meets(map, range, low, high);
                if (!meets)
                    meets = spa_meets(map, spa_load(map.words, map.nodes + words * node + 1u), low, high);
            }
        } else if (state == SPA_INSIDE && map.cores != 0u) {
            meets = low < spa_float(spa_load(map.words, map.cores + node));
        }
        if (meets && level > 0u) {
            level -= 1u;
        } else {
            bool found = false;
            if (meets) found = spa_cross_cell(map, stretch, x, y, s, s1, flags, state, event, piece, tri);
            if (found) {
                walk.x = x;
                walk.y = y;
                walk.s0 = s;
                walk.s1 = s1;
                return true;
            }
            if (s1 >= 1.0f) return false;
            bool by_x = exit_x <= exit_y;
            bool climb = false;
            if (by_x) {
                x = next_x;
                y = max(y, min(uint(stretch.y0 + s1 * stretch.dy), next_y - 1u));
                climb = ((x >> level) & 1u) == 0u;
            } else {
                y = next_y;
                x = max(x, min(uint(stretch.x0 + s1 * stretch.dx), next_x - 1u));
                climb = ((y >> level) & 1u) == 0u;
            }
            y = min(y, last);
            x = min(x, last);
            s = s1;
            if (climb) level = min(level + 1u, top);
        }
    }
    return false;
}

// When the ray enters and leaves the box in one coordinate: before anything and after everything if it never
// does.
SPA_FUNCTION float spa_enters_box(float position, float direction, float per, float low, float high) {
    if (abs(direction) < SPA_TINY) return -SPA_NEVER;
    return ((direction > 0.0f ? low : high) - position) * per;
}
SPA_FUNCTION float spa_leaves_box(float position, float direction, float per, float low, float high) {
    if (abs(direction) < SPA_TINY) return SPA_NEVER;
    return ((direction > 0.0f ? high : low) - position) * per;
}

// A chord is followed this much farther than t_max, relative to its own length and to t: a ray that ends at a
// hit's t still has that hit.
#define SPA_LONGER 1e-6f

// Keeps of a chord what lies in the box around the surface. False: nothing does.
SPA_FUNCTION bool spa_in_box(SPA_IN(SpaMap) map, float3 direction, float3 per, SPA_INOUT(SpaChord) chord) {
    float3 low = map.box_low;
    float3 high = map.box_high;
    float enters = max(spa_enters_box(chord.foot.x, direction.x, per.x, low.x, high.x),
                       max(spa_enters_box(chord.foot.y, direction.y, per.y, low.y, high.y),
                           spa_enters_box(chord.foot.z, direction.z, per.z, low.z, high.z)));
    float leaves = min(spa_leaves_box(chord.foot.x, direction.x, per.x, low.x, high.x),
                       min(spa_leaves_box(chord.foot.y, direction.y, per.y, low.y, high.y),
                           spa_leaves_box(chord.foot.z, direction.z, per.z, low.z, high.z)));
    chord.t1 = chord.t1 + ((chord.t1 - chord.t0) + abs(chord.foot_t + chord.t1)) * SPA_LONGER;
    chord.starts_inside_sphere = chord.starts_inside_sphere && chord.t0 > enters;
    chord.t0 = max(chord.t0, enters);
    chord.t1 = min(chord.t1, leaves);
    return chord.t0 < chord.t1;
}

// The first hit of the ray with t_min <= t <= t_max. flags: SPA_CULL_..., SPA_ANY_HIT.
SPA_FUNCTION bool spa_trace_projective(SPA_IN(SpaMap) map, SPA_IN(SpaRay) ray, uint flags,
                                       SPA_OUT(SpaHit) hit) {
    hit = spa_no_hit();
    if (map.mapping != SPA_OCTAHEDRAL) return false;
    if (!(ray.t_min <= ray.t_max)) return false;
    SpaChord chord;
    if (!spa_chord(ray, map.radius, chord)) return false;
    float3 per = float3(1.0f / ray.direction.x, 1.0f / ray.direction.y, 1.0f / ray.direction.z);
    if (!spa_in_box(map, ray.direction, per, chord)) return false;
    float3 crossings = float3(spa_crossing(chord.foot.x, ray.direction.x, per.x, chord.t0, chord.t1),
                              spa_crossing(chord.foot.y, ray.direction.y, per.y, chord.t0, chord.t1),
                              spa_crossing(chord.foot.z, ray.direction.z, per.z, chord.t0, chord.t1));
    float low = min(crossings.x, crossings.y);
    float high = max(crossings.x, crossings.y);
    float first = min(low, crossings.z);
    float second = max(low, min(high, crossings.z));
    float third = max(high, crossings.z);
    uint state = chord.starts_inside_sphere ? SPA_UNKNOWN : SPA_OUTSIDE;
    SpaEvent event = spa_no_event();
    SpaPiece piece;
    piece.s0 = 0.0f;
    piece.u0 = 0.0f;
    piece.v0 = 0.0f;
    piece.w0 = 0.0f;
    piece.s1 = 0.0f;
    piece.u1 = 0.0f;
    piece.v1 = 0.0f;
    piece.w1 = 0.0f;
    SpaTriangle tri = spa_triangle(map, 0u, 0u, 0u);
    SpaWalk walk;
    walk.x = 0u;
    walk.y = 0u;
    walk.s0 = 0.0f;
    walk.s1 = 0.0f;
    float from = chord.t0;
    for (uint n = 0u; n < 4u; n += 1u) {
        float to = n == 0u ? first : (n == 1u ? second : (n == 2u ? third : chord.t1));
        SpaStretch stretch;
        bool found = false;
        if (from < to) {
            if (spa_stretch(map, chord.foot, ray.direction, crossings, from, to, stretch))
                found = spa_walk(map, stretch, flags, state, event, piece, tri, walk);
        }
        if (found) {
            if ((flags & SPA_ANY_HIT) == 0u) {
                hit = spa_finish(map, ray, chord, stretch, event, piece, tri, walk.x, walk.y);
            } else {
                hit.t = min(max(spa_time(stretch, event.s) + chord.foot_t, ray.t_min), ray.t_max);
            }
            return true;
        }
        from = max(from, to);
    }
    return false;
}

SPA_END

#endif
