// SPDX-License-Identifier: Apache-2.0
// The pure cells of ../../shaders/spa_cell.h and spa_cross_cell of spa_projective.h, many rays at once: the
// same operations in the same order, so that the answers are equal bit by bit.
#include "stream_vectors-inl.h"

#if defined(SPA_STREAM_CELL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPA_STREAM_CELL_INL
#undef SPA_STREAM_CELL_INL
#else
#define SPA_STREAM_CELL_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace spa::trace::HWY_NAMESPACE {

// A stretch a lane (SpaStretch).
struct StretchLanes {
    VF x0, y0, w0, dx, dy, dw;
    VU flip_x, flip_y;
};

HWY_INLINE MF has_bit(VU words, std::uint32_t bit) {
    return hn::RebindMask(df, hn::Ne(hn::And(words, hn::Set(du, bit)), hn::Zero(du)));
}

// A cell a lane: where the ray enters and leaves it, and the samples at its corners.
struct CellLanes {
    VU x, y; // turned
    VF s0, s1;
};

struct PlaneLanes {
    VF c, u, v;
};

struct PieceLanes {
    VF s0, u0, v0, w0, s1, u1, v1, w1;
};

// The first event of the rays that come from outside: a surface or an edge of a prism of a pure triangle.
struct CrossLanes {
    MF any;
    VF s;
    MF by_edge, inner; // inner: not the outer plane but the inner one
    VU layer;
    VU beyond;
    PieceLanes piece;
    PlaneLanes plane; // the prism's outer plane, or its inner one where the ray enters there
    MF starts_inside; // at the piece's start the ray is in the solid
    MF grazes; // it begins on the edge of a prism that it leaves again at once: the text knows what that is
};

HWY_INLINE VF plane_at(const PlaneLanes& plane, VF u, VF v) {
    return hn::Add(hn::Add(plane.c, hn::Mul(plane.u, u)), hn::Mul(plane.v, v));
}

HWY_INLINE PieceLanes select(MF mask, const PieceLanes& a, const PieceLanes& b) {
    return {hn::IfThenElse(mask, a.s0, b.s0), hn::IfThenElse(mask, a.u0, b.u0),
            hn::IfThenElse(mask, a.v0, b.v0), hn::IfThenElse(mask, a.w0, b.w0),
            hn::IfThenElse(mask, a.s1, b.s1), hn::IfThenElse(mask, a.u1, b.u1),
            hn::IfThenElse(mask, a.v1, b.v1), hn::IfThenElse(mask, a.w1, b.w1)};
}

HWY_INLINE PlaneLanes select(MF mask, const PlaneLanes& a, const PlaneLanes& b) {
    return {hn::IfThenElse(mask, a.c, b.c), hn::IfThenElse(mask, a.u, b.u), hn::IfThenElse(mask, a.v, b.v)};
}

// W of one surface at a cell's corners, and the planes of its two triangles (spa_sample_plane).
struct CornerLanes {
    VF w00, w10, w01, w11;

    [[nodiscard]] HWY_INLINE PlaneLanes near() const { return {w00, hn::Sub(w10, w00), hn::Sub(w01, w00)}; }
    [[nodiscard]] HWY_INLINE PlaneLanes beyond() const {
        const VF u = hn::Sub(w11, w01);
        const VF v = hn::Sub(w11, w10);
        return {hn::Sub(w11, hn::Add(u, v)), u, v};
    }
    [[nodiscard]] HWY_INLINE PlaneLanes plane(MF of_beyond) const {
        return select(of_beyond, beyond(), near());
    }
};

// The sample at the cell's corner nearest to the map's middle, and the ways to its neighbours.
struct CornerPlaces {
    VI corner, step_x, step_y;
};

// place_x, place_y: cells on the whole map.
HWY_INLINE CornerPlaces corner_places(const shader::SpaMap& map, VU place_x, VU place_y) {
    const auto width = std::int32_t(map.width);
    const std::int32_t middle = std::int32_t(map.width - 1) / 2;
    const std::uint32_t side = 1U << map.levels;
    const auto left = hn::RebindMask(di, has_bit(place_x, side));
    const auto below = hn::RebindMask(di, has_bit(place_y, side));
    const VU low_bits = hn::Set(du, side - 1);
    const VI step_x = hn::IfThenElse(left, hn::Set(di, -1), hn::Set(di, 1));
    const VI step_y = hn::IfThenElse(below, hn::Set(di, width), hn::Set(di, -width));
    const VI x = hn::BitCast(di, hn::And(place_x, low_bits));
    const VI y = hn::BitCast(di, hn::And(place_y, low_bits));
    const VI along_x = hn::IfThenElse(left, hn::Neg(x), x);
    return {hn::Add(hn::Add(hn::Set(di, middle * width + middle), along_x), hn::Mul(y, step_y)), step_x,
            step_y};
}

HWY_INLINE CornerLanes corners(const float* samples, const CornerPlaces& places) {
    const VI x = hn::Add(places.corner, places.step_x);
    return {hn::GatherIndex(df, samples, places.corner), hn::GatherIndex(df, samples, x),
            hn::GatherIndex(df, samples, hn::Add(places.corner, places.step_y)),
            hn::GatherIndex(df, samples, hn::Add(x, places.step_y))};
}

// Where the first prism in a triangle begins along a piece, for rays that come from outside.
struct EntryLanes {
    MF any;
    VF s;
    MF by_edge, inner;
    VU layer;
    PlaneLanes plane;
    MF starts_inside, grazes;

    // One more prism, between two planes (spa_clip_prism).
    template <bool with_inner>
    HWY_INLINE void add(const PieceLanes& piece, const PlaneLanes& outer_plane, const PlaneLanes& inner_plane,
                        std::uint32_t of_layer) {
        const VF zero = hn::Zero(df);
        const VF length = hn::Sub(piece.s1, piece.s0);
        const VF g0 = hn::Sub(piece.w0, plane_at(outer_plane, piece.u0, piece.v0));
        const VF g1 = hn::Sub(piece.w1, plane_at(outer_plane, piece.u1, piece.v1));
        const MF before = hn::Lt(g0, zero);
        MF after = hn::Lt(g1, zero);
        const VF cut = hn::Add(piece.s0, hn::Mul(length, hn::Div(g0, hn::Sub(g0, g1))));
        MF met = hn::Not(hn::And(before, after));
        const VF entry = hn::Min(cut, piece.s1);
        const MF cut_entry = hn::And(before, hn::Gt(entry, piece.s0));
        VF at = hn::IfThenElse(cut_entry, entry, piece.s0);
        MF edge = hn::Not(cut_entry);
        MF inside = hn::Not(before);
        MF by_inner = no_lanes();
        if constexpr (with_inner) {
            VF end = piece.s1;
            end = hn::IfThenElse(hn::And(hn::AndNot(before, after), hn::Lt(cut, end)), cut, end);
            const MF bounded = hn::Lt(inner_plane.c, hn::Set(df, SPA_FAR));
            const VF thicker = hn::Mul(hn::Set(df, SPA_THICKER), hn::Min(piece.w0, piece.w1));
            const VF h0 = hn::Sub(plane_at(inner_plane, piece.u0, piece.v0), hn::Sub(piece.w0, thicker));
            const VF h1 = hn::Sub(plane_at(inner_plane, piece.u1, piece.v1), hn::Sub(piece.w1, thicker));
            const MF h_before = hn::And(bounded, hn::Lt(h0, zero));
            const MF h_after = hn::And(bounded, hn::Lt(h1, zero));
            const VF h_cut = hn::Add(piece.s0, hn::Mul(length, hn::Div(h0, hn::Sub(h0, h1))));
            const VF h_entry = hn::Min(h_cut, piece.s1);
            by_inner = hn::And(h_before, hn::Gt(h_entry, at));
            at = hn::IfThenElse(by_inner, h_entry, at);
            edge = hn::AndNot(by_inner, edge);
            end = hn::IfThenElse(hn::And(hn::AndNot(h_before, h_after), hn::Lt(h_cut, end)), h_cut, end);
            met = hn::And(hn::AndNot(hn::And(h_before, h_after), met), hn::Le(at, end));
            inside = hn::And(met, hn::Le(at, piece.s0));
            after = hn::Or(after, h_after);
        }
        starts_inside = hn::Or(starts_inside, inside);
        grazes = hn::Or(grazes, hn::And(met, hn::And(edge, after)));
        const MF better = hn::And(met, hn::Lt(at, s));
        any = hn::Or(any, met);
        s = hn::IfThenElse(better, at, s);
        by_edge = select_mask(better, edge, by_edge);
        if constexpr (with_inner) {
            inner = select_mask(better, by_inner, inner);
            layer = hn::IfThenElse(hn::RebindMask(du, better), hn::Set(du, of_layer), layer);
            plane = select(better, select(by_inner, inner_plane, outer_plane), plane);
        } else {
            plane = select(better, outer_plane, plane);
        }
    }
};

HWY_INLINE EntryLanes no_entry() {
    const VF zero = hn::Zero(df);
    const MF none = no_lanes();
    return {none, hn::Set(df, 2.0F), none, none, hn::Zero(du), {zero, zero, zero}, none, none};
}

// The rays of `lanes` through the cells: all of them pure, with so many layers at most.
template <bool with_inner>
HWY_INLINE CrossLanes cross_cells(const shader::SpaMap& map, const StretchLanes& stretch,
                                  const CellLanes& cell, std::uint32_t layers) {
    const VF one = hn::Set(df, 1.0F);
    const VF zero = hn::Zero(df);
    const MF flip_x = has_bit(stretch.flip_x, 1);
    const MF flip_y = has_bit(stretch.flip_y, 1);
    const VF x = to_floats(cell.x);
    const VF y = to_floats(cell.y);
    const auto place = [&](VF start, VF change, VF s, VF from, MF flip) {
        const VF p = hn::Sub(hn::Add(start, hn::Mul(s, change)), from);
        return hn::IfThenElse(flip, hn::Sub(one, p), p);
    };
    const VF u0 = place(stretch.x0, stretch.dx, cell.s0, x, flip_x);
    const VF v0 = place(stretch.y0, stretch.dy, cell.s0, y, flip_y);
    const VF u1 = place(stretch.x0, stretch.dx, cell.s1, x, flip_x);
    const VF v1 = place(stretch.y0, stretch.dy, cell.s1, y, flip_y);
    const VF w0 = hn::Add(stretch.w0, hn::Mul(cell.s0, stretch.dw));
    const VF w1 = hn::Add(stretch.w0, hn::Mul(cell.s1, stretch.dw));
    const VF g0 = hn::Sub(hn::Add(u0, v0), one);
    const VF g1 = hn::Sub(hn::Add(u1, v1), one);
    const VF least = hn::Set(df, SPA_DIAGONAL * float(map.width - 1));
    const VF low = hn::Neg(least);
    const MF two =
        hn::Or(hn::And(hn::Lt(g0, low), hn::Gt(g1, least)), hn::And(hn::Gt(g0, least), hn::Lt(g1, low)));
    const VF f = hn::Div(g0, hn::Sub(g0, g1));
    const auto middle = [&](VF a, VF b) {
        return hn::IfThenElse(two, hn::Add(a, hn::Mul(hn::Sub(b, a), f)), b);
    };
    const VF sm = middle(cell.s0, cell.s1);
    const VF um = middle(u0, u1);
    const VF vm = middle(v0, v1);
    const VF wm = middle(w0, w1);
    const MF first_beyond = select_mask(two, hn::Gt(g0, zero), hn::Gt(hn::Add(g0, g1), zero));
    const PieceLanes first{cell.s0, u0, v0, w0, sm, um, vm, wm};
    const PieceLanes second{sm, um, vm, wm, cell.s1, u1, v1, w1};

    const CornerPlaces places =
        corner_places(map, hn::Xor(cell.x, stretch.flip_x), hn::Xor(cell.y, stretch.flip_y));
    const auto* const samples = reinterpret_cast<const float*>(map.words.first + map.samples);
    const std::size_t count = std::size_t(map.width) * map.height;

    EntryLanes in_first = no_entry();
    EntryLanes in_second = no_entry();
    const MF second_beyond = hn::Not(first_beyond);
    for (std::uint32_t k = 0; k < layers; ++k) {
        const CornerLanes outer = corners(samples + (with_inner ? 2 * k : k) * count, places);
        if (k > 0 &&
            hn::AllTrue(df, hn::Ge(hn::Min(hn::Min(outer.w00, outer.w10), hn::Min(outer.w01, outer.w11)),
                                   hn::Set(df, SPA_FAR))))
            break;
        CornerLanes inner = outer;
        if constexpr (with_inner) inner = corners(samples + (2 * k + 1) * count, places);
        in_first.add<with_inner>(first, outer.plane(first_beyond), inner.plane(first_beyond), k);
        in_second.add<with_inner>(second, outer.plane(second_beyond), inner.plane(second_beyond), k);
    }
    const MF later = hn::AndNot(in_first.any, hn::And(in_second.any, two));
    const MU later_u = hn::RebindMask(du, later);
    return {hn::Or(in_first.any, later),
            hn::IfThenElse(later, in_second.s, in_first.s),
            select_mask(later, in_second.by_edge, in_first.by_edge),
            select_mask(later, in_second.inner, in_first.inner),
            hn::IfThenElse(later_u, in_second.layer, in_first.layer),
            hn::IfThenElseZero(hn::RebindMask(du, hn::Xor(first_beyond, later)), hn::Set(du, 1)),
            select(later, second, first),
            select(later, in_second.plane, in_first.plane),
            in_first.starts_inside,
            hn::Or(in_first.grazes, hn::And(in_second.grazes, two))};
}

} // namespace spa::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
