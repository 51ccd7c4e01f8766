// SPDX-License-Identifier: Apache-2.0
// spa_event and spa_finish of the text, for the hits on pure cells of one pass.
#include "stream_cell-inl.h"
#include "stream_setup-inl.h"

#if defined(SPA_STREAM_FINISH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPA_STREAM_FINISH_INL
#undef SPA_STREAM_FINISH_INL
#else
#define SPA_STREAM_FINISH_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace spa::trace::HWY_NAMESPACE {

// The finished records of up to one vector of results.
struct HitBlock {
    HWY_ALIGN float t[hn::MaxLanes(df)];
    HWY_ALIGN float normal_x[hn::MaxLanes(df)], normal_y[hn::MaxLanes(df)], normal_z[hn::MaxLanes(df)];
    HWY_ALIGN float map_x[hn::MaxLanes(df)], map_y[hn::MaxLanes(df)];
    HWY_ALIGN std::uint32_t layer[hn::MaxLanes(df)], inner[hn::MaxLanes(df)];
    HWY_ALIGN std::uint32_t by_text[hn::MaxLanes(df)]; // not 0: an edge, which the text has to look at
};

// spa_time
HWY_INLINE VF time_of(const StretchLanes& stretch, VF ta, VF tb, VF sigma) {
    const VF w1 = hn::Add(stretch.w0, stretch.dw);
    const VF start = hn::Mul(ta, stretch.w0);
    const VF t = hn::Div(hn::Add(start, hn::Mul(sigma, hn::Sub(hn::Mul(tb, w1), start))),
                         hn::Add(stretch.w0, hn::Mul(sigma, stretch.dw)));
    return hn::Min(hn::Max(t, ta), tb);
}

// The results from `first` on, a vector of them; those that are no hits on a pure cell give nonsense.
template <bool with_inner>
HWY_INLINE void finish(const shader::SpaMap& map, const StreamBlock& block, const Ray* rays,
                       std::size_t first, HitBlock& hits) {
    const ChordBlock& chords = block.chords;
    const StretchBlock& jobs = block.stretches;
    const ResultBlock& results = block.results;
    // Lanes behind the last result do what the first one does.
    const MU real = hn::FirstN(du, results.count - first);
    const VI job = hn::BitCast(di, hn::IfThenElseZero(real, hn::LoadU(du, results.job + first)));
    const auto of_job = [&](const Floats& from) { return hn::GatherIndex(df, from + 0, job); };
    const auto word_of_job = [&](const Words& from) { return gather(from + 0, hn::BitCast(du, job)); };
    const std::uint32_t side = 1U << map.levels;
    const auto load = [&](const Floats& from) { return hn::LoadU(df, from + first); };
    const StretchLanes stretch{load(results.x0),
                               load(results.y0),
                               load(results.w0),
                               load(results.dx),
                               load(results.dy),
                               load(results.dw),
                               hn::IfThenElseZero(real, hn::LoadU(du, results.flip_x + first)),
                               hn::IfThenElseZero(real, hn::LoadU(du, results.flip_y + first))};
    const MF flip_x = has_bit(stretch.flip_x, 1);
    const MF flip_y = has_bit(stretch.flip_y, 1);
    const CellLanes cell{hn::IfThenElseZero(real, hn::LoadU(du, results.x + first)),
                         hn::IfThenElseZero(real, hn::LoadU(du, results.y + first)), load(results.s0),
                         load(results.s1)};
    const CrossLanes cross = cross_cells<with_inner>(map, stretch, cell, (map.surfaces + 1) / 2);
    const PieceLanes& piece = cross.piece;

    const VF zero = hn::Zero(df);
    hn::Store(hn::VecFromMask(du, hn::RebindMask(du, cross.by_edge)), du, hits.by_text);

    const VF ta = of_job(jobs.ta);
    const VF tb = of_job(jobs.tb);
    const VI chord = hn::BitCast(di, word_of_job(jobs.chord));
    const auto of_chord = [&](const Floats& from) { return hn::GatherIndex(df, from + 0, chord); };
    const VectorLanes foot{of_chord(chords.foot_x), of_chord(chords.foot_y), of_chord(chords.foot_z)};
    const VectorLanes direction{of_chord(chords.direction_x), of_chord(chords.direction_y),
                                of_chord(chords.direction_z)};
    const MF left = has_bit(stretch.flip_x, side);
    const MF below = has_bit(stretch.flip_y, side);
    const MF lower = hn::RebindMask(df, hn::MaskFromVec(word_of_job(jobs.lower)));
    const VU low_bits = hn::Set(du, side - 1);
    const VU real_x = hn::And(hn::Xor(cell.x, stretch.flip_x), low_bits);
    const VU real_y = hn::And(hn::Xor(cell.y, stretch.flip_y), low_bits);
    const VF x = to_floats(real_x);
    const VF y = to_floats(real_y);
    const std::uint32_t half_cells = (map.width - 1) / 2;
    const auto cells = float(half_cells);
    const PlaneLanes& plane = cross.plane;
    const auto signed_by = [](MF negative, VF v) { return hn::IfThenElse(negative, hn::Neg(v), v); };
    const auto plane_minus_one = [&](VF t) {
        VF a = signed_by(left, hn::Add(foot.x, hn::Mul(direction.x, t)));
        VF b = signed_by(below, hn::Add(foot.y, hn::Mul(direction.y, t)));
        const VF c = signed_by(lower, hn::Add(foot.z, hn::Mul(direction.z, t)));
        const VF l = hn::Add(hn::Add(a, b), c);
        a = hn::IfThenElse(lower, hn::Add(a, c), a);
        b = hn::IfThenElse(lower, hn::Add(b, c), b);
        const VF many = hn::Set(df, cells);
        const VF along_u = hn::Mul(plane.u, hn::Sub(hn::Mul(many, a), hn::Mul(x, l)));
        const VF along_v = hn::Mul(plane.v, hn::Sub(hn::Mul(many, b), hn::Mul(y, l)));
        return hn::Sub(hn::Add(hn::Add(hn::Mul(plane.c, l), along_u), along_v), hn::Set(df, 1.0F));
    };
    const VF t_start = time_of(stretch, ta, tb, piece.s0);
    const VF t_end = time_of(stretch, ta, tb, piece.s1);
    const VF ga = plane_minus_one(t_start);
    const VF gb = plane_minus_one(t_end);
    const VF exact = hn::Min(
        hn::Max(hn::Add(t_start, hn::Mul(hn::Sub(t_end, t_start), hn::Div(ga, hn::Sub(ga, gb)))), t_start),
        t_end);
    const MF a_below = hn::Lt(ga, zero);
    const MF b_below = hn::Lt(gb, zero);
    const MF crosses = select_mask(cross.inner, hn::AndNot(b_below, a_below), hn::AndNot(a_below, b_below));
    const MF changes = hn::And(crosses, hn::Gt(hn::Abs(hn::Sub(ga, gb)), hn::Set(df, SPA_ALONG)));
    const VF t = hn::IfThenElse(changes, exact, time_of(stretch, ta, tb, cross.s));
    const VI ray =
        hn::ShiftLeft<3>(hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(chords.ray + 0), chord));
    const auto* const words = reinterpret_cast<const float*>(rays);
    const VF t_min = hn::GatherIndex(df, words + 3, ray);
    const VF t_max = hn::GatherIndex(df, words + 7, ray);
    hn::Store(hn::Min(hn::Max(hn::Add(t, of_chord(chords.foot_t)), t_min), t_max), df, hits.t);

    // spa_gradient
    const VF gx = hn::Mul(plane.u, hn::Set(df, cells));
    const VF gy = hn::Mul(plane.v, hn::Set(df, cells));
    const VF gl = hn::Sub(hn::Sub(plane.c, hn::Mul(plane.u, x)), hn::Mul(plane.v, y));
    const MF upper =
        hn::RebindMask(df, hn::Lt(hn::Add(hn::Add(real_x, real_y), cross.beyond), hn::Set(du, half_cells)));
    const VF gradient_x = signed_by(left, hn::Add(gl, gx));
    const VF gradient_y = signed_by(below, hn::Add(gl, gy));
    const VF gradient_z = hn::IfThenElse(upper, gl, hn::Neg(hn::Add(hn::Add(gl, gx), gy)));
    const VectorLanes normal{signed_by(cross.inner, gradient_x), signed_by(cross.inner, gradient_y),
                             signed_by(cross.inner, gradient_z)};
    const VF length = hn::Sqrt(dot(normal, normal));
    const VF scale = hn::Div(hn::Set(df, 1.0F), length);
    const auto unit = [&](VF v) { return hn::IfThenElseZero(hn::Gt(length, zero), hn::Mul(v, scale)); };
    hn::Store(unit(normal.x), df, hits.normal_x);
    hn::Store(unit(normal.y), df, hits.normal_y);
    hn::Store(unit(normal.z), df, hits.normal_z);

    const auto place = [&](VF start, VF change, MF turned) {
        const VF p = hn::Add(start, hn::Mul(cross.s, change));
        return hn::IfThenElse(turned, hn::Sub(hn::Set(df, float(side)), p), p);
    };
    const VF whole = hn::Set(df, float(map.width - 1));
    const VF half = hn::Set(df, 0.5F);
    const VF px = signed_by(left, place(stretch.x0, stretch.dx, flip_x));
    const VF py = signed_by(below, place(stretch.y0, stretch.dy, flip_y));
    hn::Store(hn::Add(half, hn::Div(px, whole)), df, hits.map_x);
    hn::Store(hn::Sub(half, hn::Div(py, whole)), df, hits.map_y);
    hn::Store(cross.layer, du, hits.layer);
    hn::Store(hn::IfThenElseZero(hn::RebindMask(du, cross.inner), hn::Set(du, 1)), du, hits.inner);
}

} // namespace spa::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
