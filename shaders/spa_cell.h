// SPDX-License-Identifier: Apache-2.0
// What stands in one cell of an octahedral map, and where a ray enters and leaves it.
//
// The solid in a triangle is a union of convex prisms: between two planes w = c + u x + v y, outer and inner,
// and within up to three half-planes besides the triangle's edges. A pure triangle's prisms are its
// intervals, read from the samples; a mixed one's are listed in the image. Along the ray everything is
// linear, so clipping a piece of the ray takes two values a plane. x and y are the cell's own here, in [0,1],
// from the corner nearest to the map's middle.
#ifndef SPA_CELL_H
#define SPA_CELL_H

#include "spa_map.h"

SPA_BEGIN

#define SPA_OUTSIDE 0u
#define SPA_INSIDE 1u
#define SPA_UNKNOWN 2u // the ray starts within the map's sphere

// What bounds a clipped piece.
#define SPA_BY_EDGE 0u // the triangle's edges: the piece's own end
#define SPA_BY_OUTER 1u
#define SPA_BY_INNER 2u
#define SPA_BY_HALF_PLANE 3u // and above: 3 + index

// Regions of a mixed triangle overlap by this many cells, so that no ray passes between them.
#define SPA_OVERLAP 2e-6f
// Walls of regions that are this near to where a ray leaves a triangle, in cells, are what it leaves by.
#define SPA_PASSED 2e-5f
// Steps lower than this, relative to w, are rounding and no walls.
#define SPA_STEP 1e-5f
// Rounding at the borders of triangles must not make a ray that enters the solid leave and enter again, nor
// one that leaves enter and leave again: this much of w is no reason to.
#define SPA_SLACK 4e-6f
// What rounding along the piece may add, relative to its greater w.
#define SPA_ROUNDING 2.4e-7f
// So much deeper, relative to w, inner ends are for rays that come from outside: they do not slip through
// what has no thickness. Less than the slack, or they would leave at once.
#define SPA_THICKER 1e-6f
// Planes whose values change by no more along a piece of the ray do not say where it passes them.
#define SPA_ALONG 2e-6f

// Words of a triangle's list of prisms: where they are, how many (or SPA_PURE), the least and the greatest w
// in them.
#define SPA_LIST_WORDS 4u
// Words of a prism.
#define SPA_PRISM_WORDS 8u // outer plane (3), inner plane (3), properties, place of the half-planes
// Properties: bits 0-9 layer of the outer end, 10-19 of the inner end, 20-23 number of half-planes, bit 24 +
// n: half-plane n is an open wall.
#define SPA_PRISM_PROPERTIES(outer_layer, inner_layer, half_planes, open)                                    \
    ((outer_layer) | (inner_layer) << 10u | (half_planes) << 20u | (open) << 24u)
#define SPA_MAX_LAYERS 1024u
// Of a list of prisms that stands for a pure triangle.
#define SPA_PURE 0xFFFFFFFFu

struct SpaPlane {
    float c;
    float u;
    float v;
};

struct SpaPrism {
    SpaPlane outer;
    SpaPlane inner;
    uint layer;       // of the outer end, and of walls
    uint inner_layer; // of the inner end
    uint half_planes; // how many
    uint first;       // where
    uint open;        // bit n: half-plane n is an open wall
};

// A piece of the ray within one triangle: sigma, the place in the cell and w at both ends.
struct SpaPiece {
    float s0;
    float u0;
    float v0;
    float w0;
    float s1;
    float u1;
    float v1;
    float w1;
};

struct SpaTriangle {
    uint corner; // sample at the cell's corner nearest to the map's middle
    uint step_x; // to the next sample in x and y, modulo 2^32
    uint step_y;
    uint beyond; // 0: the triangle at that corner, 1: the other one
    uint prisms; // SPA_PURE, or how many
    uint layers; // pure: how many there may be
    uint first;  // where they are
    float low;   // no prism lies outside this range of w
    float high;
};

// Where the ray enters or leaves the solid.
struct SpaEvent {
    float s;
    SpaPlane plane; // that it passes there: w - plane = 0, or a half-plane's plane = 0
    uint by;
    uint layer;
    bool front;
};

struct SpaClip {
    float s0;
    float s1;
    uint by0;
    uint by1;
};

// Before anything has happened.
SPA_FUNCTION SpaEvent spa_no_event() {
    SpaEvent event;
    event.s = 0.0f;
    event.plane.c = 0.0f;
    event.plane.u = 0.0f;
    event.plane.v = 0.0f;
    event.by = SPA_BY_EDGE;
    event.layer = 0u;
    event.front = true;
    return event;
}

SPA_FUNCTION float spa_at(SpaPlane plane, float u, float v) { return plane.c + plane.u * u + plane.v * v; }

SPA_FUNCTION SpaPlane spa_load_plane(SPA_IN(SpaMap) map, uint place) {
    SpaPlane plane;
    plane.c = spa_float(spa_load(map.words, place));
    plane.u = spa_float(spa_load(map.words, place + 1u));
    plane.v = spa_float(spa_load(map.words, place + 2u));
    return plane;
}

// The plane through a pure triangle's samples of one surface.
SPA_FUNCTION SpaPlane spa_sample_plane(SPA_IN(SpaMap) map, SPA_IN(SpaTriangle) tri, uint surface) {
    uint place = map.samples + surface * (map.width * map.height) + tri.corner;
    float w10 = spa_float(spa_load(map.words, place + tri.step_x));
    float w01 = spa_float(spa_load(map.words, place + tri.step_y));
    SpaPlane plane;
    if (tri.beyond == 0u) {
        float w00 = spa_float(spa_load(map.words, place));
        plane.c = w00;
        plane.u = w10 - w00;
        plane.v = w01 - w00;
    } else {
        float w11 = spa_float(spa_load(map.words, place + tri.step_x + tri.step_y));
        plane.u = w11 - w01;
        plane.v = w11 - w10;
        plane.c = w11 - (plane.u + plane.v);
    }
    return plane;
}

SPA_FUNCTION SpaPrism spa_prism(SPA_IN(SpaMap) map, SPA_IN(SpaTriangle) tri, uint index) {
    SpaPrism prism;
    if (tri.prisms == SPA_PURE) {
        prism.outer = spa_sample_plane(map, tri, 2u * index);
        prism.inner.c = SPA_FAR;
        prism.inner.u = 0.0f;
        prism.inner.v = 0.0f;
        if (map.surfaces > 1u) prism.inner = spa_sample_plane(map, tri, 2u * index + 1u);
        prism.layer = index;
        prism.inner_layer = index;
        prism.half_planes = 0u;
        prism.first = 0u;
        prism.open = 0u;
    } else {
        uint place = tri.first + index * SPA_PRISM_WORDS;
        uint properties = spa_load(map.words, place + 6u);
        prism.outer = spa_load_plane(map, place);
        prism.inner = spa_load_plane(map, place + 3u);
        prism.layer = properties & 0x3FFu;
        prism.inner_layer = (properties >> 10u) & 0x3FFu;
        prism.half_planes = (properties >> 20u) & 0xFu;
        prism.first = spa_load(map.words, place + 7u);
        prism.open = properties >> 24u;
    }
    return prism;
}

// Stands for what the ray comes from in the solid, where nothing continues it.
SPA_FUNCTION SpaPrism spa_no_prism() {
    SpaPrism prism;
    prism.outer.c = SPA_FAR;
    prism.outer.u = 0.0f;
    prism.outer.v = 0.0f;
    prism.inner = prism.outer;
    prism.layer = 0u;
    prism.inner_layer = 0u;
    prism.half_planes = 0u;
    prism.first = 0u;
    prism.open = 0u;
    return prism;
}

// How many prisms to look at.
SPA_FUNCTION uint spa_prisms(SPA_IN(SpaTriangle) tri) {
    return tri.prisms == SPA_PURE ? tri.layers : tri.prisms;
}

// Keeps of `clip` what lies where a function is >= 0 that has the values g0 and g1 at the piece's ends. Never
// asks for a change of sign: what is inside at an end stays inside there. slack: how far below 0 a function
// may begin or end without ending what is inside.
SPA_FUNCTION void spa_clip(SPA_INOUT(SpaClip) clip, SPA_IN(SpaPiece) piece, float g0, float g1, float slack,
                           uint by) {
    float least = g0 < 0.0f || g1 >= 0.0f - slack ? 0.0f - slack : 0.0f;
    if (g0 < least && g1 < least) {
        clip.s1 = -1.0f;
    } else if (g0 < least) {
        float s = min(piece.s0 + (piece.s1 - piece.s0) * ((g0 - least) / (g0 - g1)), piece.s1);
        if (s > clip.s0) {
            clip.s0 = s;
            clip.by0 = by;
        }
    } else if (g1 < least) {
        float s = piece.s0 + (piece.s1 - piece.s0) * ((g0 - least) / (g0 - g1));
        if (s < clip.s1) {
            clip.s1 = s;
            clip.by1 = by;
        }
    }
}

// The piece inside a prism; empty if s1 < s0. slack: 0, or SPA_SLACK in the solid. thicker: 0, or SPA_THICKER
// for rays that come from outside.
SPA_FUNCTION SpaClip spa_clip_prism(SPA_IN(SpaMap) map, SPA_IN(SpaPrism) prism, SPA_IN(SpaPiece) piece,
                                    float slack, float thicker) {
    SpaClip clip;
    clip.s0 = piece.s0;
    clip.s1 = piece.s1;
    clip.by0 = SPA_BY_EDGE;
    clip.by1 = SPA_BY_EDGE;
    float w = min(piece.w0, piece.w1);
    float give = slack > 0.0f ? slack * w + SPA_ROUNDING * max(piece.w0, piece.w1) : 0.0f;
    spa_clip(clip, piece, piece.w0 - spa_at(prism.outer, piece.u0, piece.v0),
             piece.w1 - spa_at(prism.outer, piece.u1, piece.v1), give, SPA_BY_OUTER);
    if (clip.s1 < clip.s0) return clip;
    if (prism.inner.c < SPA_FAR)
        spa_clip(clip, piece, spa_at(prism.inner, piece.u0, piece.v0) - (piece.w0 - thicker * w),
                 spa_at(prism.inner, piece.u1, piece.v1) - (piece.w1 - thicker * w), give, SPA_BY_INNER);
    for (uint n = 0u; n < prism.half_planes; n += 1u) {
        SpaPlane plane = spa_load_plane(map, prism.first + 3u * n);
        spa_clip(clip, piece, spa_at(plane, piece.u0, piece.v0) + SPA_OVERLAP,
                 spa_at(plane, piece.u1, piece.v1) + SPA_OVERLAP, 0.0f, SPA_BY_HALF_PLANE + n);
    }
    return clip;
}

// The edge of the triangle that is nearest to a place in it, as a half-plane: the triangle's (towards = 1) or
// the one beyond it (-1).
SPA_FUNCTION SpaPlane spa_edge(uint beyond, float u, float v, float towards) {
    SpaPlane edge;
    float a = beyond == 0u ? u : 1.0f - u;
    float b = beyond == 0u ? v : 1.0f - v;
    float c = 1.0f - a - b;
    float turn = beyond == 0u ? 1.0f : -1.0f;
    edge.c = beyond == 0u ? 0.0f : 1.0f;
    edge.u = turn;
    edge.v = 0.0f;
    if (b < a && b <= c) {
        edge.u = 0.0f;
        edge.v = turn;
    } else if (c < a && c < b) {
        edge.c = beyond == 0u ? 1.0f : -1.0f;
        edge.u = -turn;
        edge.v = -turn;
    }
    edge.c *= towards;
    edge.u *= towards;
    edge.v *= towards;
    return edge;
}

// What the ray passes at sigma s, one end of a prism's clip.
SPA_FUNCTION SpaEvent spa_event(SPA_IN(SpaMap) map, SPA_IN(SpaTriangle) tri, SPA_IN(SpaPrism) prism,
                                SPA_IN(SpaPiece) piece, float s, uint by, bool front) {
    SpaEvent event;
    event.s = s;
    event.by = by;
    event.layer = prism.layer;
    event.front = front;
    event.plane = prism.outer;
    if (by == SPA_BY_INNER) {
        event.plane = prism.inner;
        event.layer = prism.inner_layer;
    }
    if (by >= SPA_BY_HALF_PLANE)
        event.plane = spa_load_plane(map, prism.first + 3u * (by - SPA_BY_HALF_PLANE));
    if (by == SPA_BY_EDGE) {
        float f = piece.s1 > piece.s0 ? (s - piece.s0) / (piece.s1 - piece.s0) : 0.0f;
        float u = piece.u0 + f * (piece.u1 - piece.u0);
        float v = piece.v0 + f * (piece.v1 - piece.v0);
        float w = piece.w0 + f * (piece.w1 - piece.w0);
        // Along the piece the ray sinks below the outer end if it enters there, or rises.
        float rise = front ? 1.0f : -1.0f;
        float sinks = (piece.w1 - spa_at(prism.outer, piece.u1, piece.v1)) -
                      (piece.w0 - spa_at(prism.outer, piece.u0, piece.v0));
        float climbs = (spa_at(prism.inner, piece.u1, piece.v1) - piece.w1) -
                       (spa_at(prism.inner, piece.u0, piece.v0) - piece.w0);
        if (rise * sinks >= 0.0f && abs(w - spa_at(prism.outer, u, v)) <= SPA_STEP * w) {
            event.by = SPA_BY_OUTER;
        } else if (rise * climbs >= 0.0f && abs(w - spa_at(prism.inner, u, v)) <= SPA_STEP * w) {
            event.by = SPA_BY_INNER;
            event.plane = prism.inner;
            event.layer = prism.inner_layer;
        } else {
            // Towards the solid: into this triangle, or back into the one before it.
            event.plane = spa_edge(tri.beyond, u, v, front ? 1.0f : -1.0f);
        }
    }
    return event;
}

// Whether the ray at sigma s is in the prism, or outside its ends by no more than `slack`, relative to w;
// slack < 0: inside by more than that.
SPA_FUNCTION bool spa_touches(SPA_IN(SpaMap) map, SPA_IN(SpaPrism) prism, SPA_IN(SpaPiece) piece, float s,
                              float slack) {
    float f = piece.s1 > piece.s0 ? (s - piece.s0) / (piece.s1 - piece.s0) : 0.0f;
    float u = piece.u0 + f * (piece.u1 - piece.u0);
    float v = piece.v0 + f * (piece.v1 - piece.v0);
    float w = piece.w0 + f * (piece.w1 - piece.w0);
    bool touches =
        w * (1.0f + slack) >= spa_at(prism.outer, u, v) && w * (1.0f - slack) <= spa_at(prism.inner, u, v);
    for (uint n = 0u; n < prism.half_planes; n += 1u) {
        SpaPlane plane = spa_load_plane(map, prism.first + 3u * n);
        touches = touches && spa_at(plane, u, v) + SPA_OVERLAP >= 0.0f;
    }
    return touches;
}

// The half-plane, as SPA_BY_..., that the ray at sigma s has passed by no more than rounding at a triangle's
// border may hide, if it is between the prism's ends and not beyond another; else SPA_BY_EDGE.
SPA_FUNCTION uint spa_passed_wall(SPA_IN(SpaMap) map, SPA_IN(SpaPrism) prism, SPA_IN(SpaPiece) piece,
                                  float s) {
    float f = piece.s1 > piece.s0 ? (s - piece.s0) / (piece.s1 - piece.s0) : 0.0f;
    float u = piece.u0 + f * (piece.u1 - piece.u0);
    float v = piece.v0 + f * (piece.v1 - piece.v0);
    float w = piece.w0 + f * (piece.w1 - piece.w0);
    uint wall = SPA_BY_EDGE;
    float least = 0.0f;
    for (uint n = 0u; n < prism.half_planes; n += 1u) {
        float beyond = spa_at(spa_load_plane(map, prism.first + 3u * n), u, v);
        if (beyond < least) {
            least = beyond;
            wall = SPA_BY_HALF_PLANE + n;
        }
    }
    bool near = least >= -SPA_PASSED && w >= spa_at(prism.outer, u, v) && w <= spa_at(prism.inner, u, v);
    return near ? wall : SPA_BY_EDGE;
}

// Whether the piece begins in the prism, but by rounding: it leaves it by an end that it is at.
SPA_FUNCTION bool spa_leaves(SPA_IN(SpaPrism) prism, SPA_IN(SpaPiece) piece, SPA_IN(SpaClip) clip) {
    if (clip.by0 != SPA_BY_EDGE || clip.s1 >= piece.s1) return false;
    float outer = piece.w0 - spa_at(prism.outer, piece.u0, piece.v0);
    float inner = spa_at(prism.inner, piece.u0, piece.v0) - piece.w0;
    float small = SPA_SLACK * min(piece.w0, piece.w1);
    return (clip.by1 == SPA_BY_OUTER && outer < small && inner >= small) ||
           (clip.by1 == SPA_BY_INNER && inner < small && outer >= small);
}

SPA_FUNCTION bool spa_silent(SPA_IN(SpaPrism) prism, SPA_IN(SpaEvent) event, uint flags) {
    if (event.by >= SPA_BY_HALF_PLANE && ((prism.open >> (event.by - SPA_BY_HALF_PLANE)) & 1u) != 0u)
        return true;
    return (flags & (event.front ? SPA_CULL_FRONT : SPA_CULL_BACK)) != 0u;
}

// Follows the ray through one triangle. state: whether the ray is in the solid, before and after. True:
// `event` is to be reported.
SPA_FUNCTION bool spa_cross(SPA_IN(SpaMap) map, SPA_IN(SpaTriangle) tri, SPA_IN(SpaPiece) piece, uint flags,
                            SPA_INOUT(uint) state, SPA_INOUT(SpaEvent) event) {
    uint count = spa_prisms(tri);
    float at = piece.s0;
    if (state == SPA_UNKNOWN) {
        state = SPA_OUTSIDE;
        for (uint n = 0u; n < count; n += 1u) {
            SpaClip clip = spa_clip_prism(map, spa_prism(map, tri, n), piece, 0.0f, 0.0f);
            if (clip.s0 <= at && clip.s1 >= at) state = SPA_INSIDE;
        }
    }
    // Every turn passes one end of a prism.
    for (uint turn = 0u; turn <= 2u * count; turn += 1u) {
        SpaPrism found = spa_no_prism();
        uint by = SPA_BY_EDGE;
        float s = 2.0f;
        if (state == SPA_OUTSIDE) {
            for (uint n = 0u; n < count; n += 1u) {
                SpaPrism prism = spa_prism(map, tri, n);
                SpaClip clip = spa_clip_prism(map, prism, piece, 0.0f, turn == 0u ? SPA_THICKER : 0.0f);
                bool ahead =
                    clip.s0 <= clip.s1 && (clip.s1 > at || turn == 0u) && !spa_leaves(prism, piece, clip);
                if (ahead && max(clip.s0, at) < s) {
                    s = max(clip.s0, at);
                    by = clip.s0 >= at ? clip.by0 : SPA_BY_EDGE;
                    found = prism;
                }
            }
            if (s > 1.5f) return false;
            state = SPA_INSIDE;
            event = spa_event(map, tri, found, piece, s, by, true);
        } else {
            s = at;
            bool grows = true;
            for (uint m = 0u; m < count && grows; m += 1u) {
                grows = false;
                for (uint n = 0u; n < count; n += 1u) {
                    SpaPrism prism = spa_prism(map, tri, n);
                    SpaClip clip = spa_clip_prism(map, prism, piece, SPA_SLACK, 0.0f);
                    if (clip.s0 <= s && clip.s1 > s) {
                        s = clip.s1;
                        by = clip.by1;
                        found = prism;
                        grows = true;
                    }
                }
            }
            if (s >= piece.s1) return false;
            // An end or a wall at which the ray is may just have been missed.
            for (uint k = 0u; k < count && by == SPA_BY_EDGE; k += 1u) {
                SpaPrism prism = spa_prism(map, tri, k);
                uint wall = spa_passed_wall(map, prism, piece, at);
                if (wall != SPA_BY_EDGE) {
                    found = prism;
                    by = wall;
                } else if (spa_touches(map, prism, piece, at, SPA_STEP) &&
                           !spa_touches(map, prism, piece, at, -SPA_STEP)) {
                    found = prism;
                }
            }
            state = SPA_OUTSIDE;
            event = spa_event(map, tri, found, piece, s, by, false);
        }
        at = s;
        if (!spa_silent(found, event, flags)) return true;
    }
    return false;
}

SPA_END

#endif
