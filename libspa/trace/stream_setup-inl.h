// SPDX-License-Identifier: Apache-2.0
// spa_chord and spa_stretch of the text, many rays at once.
#include "stream_vectors-inl.h"

#include "ray.h"

#include <cstring>

#if defined(SPA_STREAM_SETUP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPA_STREAM_SETUP_INL
#undef SPA_STREAM_SETUP_INL
#else
#define SPA_STREAM_SETUP_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace spa::trace::HWY_NAMESPACE {

struct VectorLanes {
    VF x, y, z;
};

HWY_INLINE VF dot(const VectorLanes& a, const VectorLanes& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
// a + b s
HWY_INLINE VectorLanes along(const VectorLanes& a, const VectorLanes& b, VF s) {
    return {hn::Add(a.x, hn::Mul(b.x, s)), hn::Add(a.y, hn::Mul(b.y, s)), hn::Add(a.z, hn::Mul(b.z, s))};
}

// One coordinate of a ray: what the text asks of it with spa_crossing, spa_enters_box and spa_leaves_box.
struct CoordinateLanes {
    VF position, per;
    MF still, rises;

    HWY_INLINE CoordinateLanes(VF position_, VF direction)
        : position(position_), per(hn::Div(hn::Set(df, 1.0F), direction)),
          still(hn::Lt(hn::Abs(direction), hn::Set(df, SPA_TINY))), rises(hn::Gt(direction, hn::Zero(df))) {}

    [[nodiscard]] HWY_INLINE VF crossing(VF t0, VF t1) const {
        const VF t = hn::Min(hn::Max(hn::Mul(hn::Neg(position), per), t0), t1);
        return hn::IfThenElse(still, t1, t);
    }
    [[nodiscard]] HWY_INLINE VF enters(float low, float high) const {
        const VF side = hn::IfThenElse(rises, hn::Set(df, low), hn::Set(df, high));
        return hn::IfThenElse(still, hn::Set(df, -SPA_NEVER), hn::Mul(hn::Sub(side, position), per));
    }
    [[nodiscard]] HWY_INLINE VF leaves(float low, float high) const {
        const VF side = hn::IfThenElse(rises, hn::Set(df, high), hn::Set(df, low));
        return hn::IfThenElse(still, hn::Set(df, SPA_NEVER), hn::Mul(hn::Sub(side, position), per));
    }
};

struct RayLanes {
    VectorLanes origin;
    VF t_min;
    VectorLanes direction;
    VF t_max;
};

// A vector of rays that lie one behind the other.
HWY_INLINE RayLanes load_rays(const float* words) {
#if HWY_TARGET == HWY_SCALAR
    const auto at = [&](int index) { return hn::Load(df, words + index); };
    return {{at(0), at(1), at(2)}, at(3), {at(4), at(5), at(6)}, at(7)};
#else
    // Each of the two loads takes half of the rays, its lanes origin and direction by turns.
    RayLanes low, high;
    hn::LoadInterleaved4(df, words, low.origin.x, low.origin.y, low.origin.z, low.t_min);
    hn::LoadInterleaved4(df, words + 4 * hn::Lanes(df), high.origin.x, high.origin.y, high.origin.z,
                         high.t_min);
    const auto even = [](VF a, VF b) { return hn::ConcatEven(df, b, a); };
    const auto odd = [](VF a, VF b) { return hn::ConcatOdd(df, b, a); };
    const VectorLanes& a = low.origin;
    const VectorLanes& b = high.origin;
    return {{even(a.x, b.x), even(a.y, b.y), even(a.z, b.z)},
            even(low.t_min, high.t_min),
            {odd(a.x, b.x), odd(a.y, b.y), odd(a.z, b.z)},
            odd(low.t_min, high.t_min)};
#endif
}

// The chords of the rays that meet the map's sphere.
inline void find_chords(const shader::SpaMap& map, const Ray* rays, std::size_t count, ChordBlock& chords) {
    static_assert(sizeof(Ray) == 8 * sizeof(float));
    const std::size_t lane_count = hn::Lanes(df);
    HWY_ALIGN float last_rays[hn::MaxLanes(df) * 8] = {};
    const VF radius = hn::Set(df, map.radius);
    const VF zero = hn::Zero(df);
    std::size_t n = 0;
    for (std::size_t first = 0; first < count; first += lane_count) {
        const float* words = reinterpret_cast<const float*>(rays + first);
        if (count - first < lane_count) {
            // A vector must not be loaded from behind the last ray.
            std::memcpy(last_rays, words, (count - first) * sizeof(Ray));
            words = last_rays;
        }
        const auto [origin, ray_min, direction, ray_max] = load_rays(words);
        const VF dd = dot(direction, direction);
        VF foot_t = hn::Div(hn::Neg(dot(origin, direction)), dd);
        VectorLanes foot = along(origin, direction, foot_t);
        const VF rest = hn::Div(hn::Neg(dot(foot, direction)), dd);
        foot = along(foot, direction, rest);
        foot_t = hn::Add(foot_t, rest);
        const VF inside = hn::Sub(hn::Mul(radius, radius), dot(foot, foot));
        const VF half_chord = hn::Sqrt(hn::Div(inside, dd));
        const VF t_min = hn::Sub(ray_min, foot_t);
        const VF negative = hn::Neg(half_chord);
        MF unknown = hn::Gt(t_min, negative);
        VF t0 = hn::Max(negative, t_min);
        VF t1 = hn::Min(half_chord, hn::Sub(ray_max, foot_t));
        const CoordinateLanes x(foot.x, direction.x);
        const CoordinateLanes y(foot.y, direction.y);
        const CoordinateLanes z(foot.z, direction.z);
        const VF enters = hn::Max(
            x.enters(map.box_low.x, map.box_high.x),
            hn::Max(y.enters(map.box_low.y, map.box_high.y), z.enters(map.box_low.z, map.box_high.z)));
        const VF leaves = hn::Min(
            x.leaves(map.box_low.x, map.box_high.x),
            hn::Min(y.leaves(map.box_low.y, map.box_high.y), z.leaves(map.box_low.z, map.box_high.z)));
        unknown = hn::And(unknown, hn::Gt(t0, enters));
        const MF chord = hn::Lt(t0, t1);
        t1 = hn::Add(
            t1, hn::Mul(hn::Add(hn::Sub(t1, t0), hn::Abs(hn::Add(foot_t, t1))), hn::Set(df, SPA_LONGER)));
        t0 = hn::Max(t0, enters);
        t1 = hn::Min(t1, leaves);
        // Not every target's Min and Max hand on the NaN of a limit.
        const MF real = hn::And(hn::RebindMask(df, hn::FirstN(du, count - first)), hn::Le(ray_min, ray_max));
        const MF meets = hn::And(real, hn::And(hn::And(hn::Ge(inside, zero), chord), hn::Lt(t0, t1)));
        const std::size_t more = hn::CountTrue(df, meets);
        if (more == 0) continue;

        const VF cx = x.crossing(t0, t1);
        const VF cy = y.crossing(t0, t1);
        const VF cz = z.crossing(t0, t1);
        const VF low = hn::Min(cx, cy);
        const VF high = hn::Max(cx, cy);
        const Packer pack(hn::RebindMask(du, meets));
        pack(hn::Iota(du, std::uint32_t(first)), chords.ray + n);
        pack(foot.x, chords.foot_x + n);
        pack(foot.y, chords.foot_y + n);
        pack(foot.z, chords.foot_z + n);
        pack(foot_t, chords.foot_t + n);
        pack(direction.x, chords.direction_x + n);
        pack(direction.y, chords.direction_y + n);
        pack(direction.z, chords.direction_z + n);
        pack(cx, chords.cross_x + n);
        pack(cy, chords.cross_y + n);
        pack(cz, chords.cross_z + n);
        pack(t0, chords.time[0] + n);
        pack(hn::Min(low, cz), chords.time[1] + n);
        pack(hn::Max(low, hn::Min(high, cz)), chords.time[2] + n);
        pack(hn::Max(high, cz), chords.time[3] + n);
        pack(t1, chords.time[4] + n);
        pack(hn::IfThenElse(hn::RebindMask(du, unknown), hn::Set(du, SPA_UNKNOWN), hn::Set(du, SPA_OUTSIDE)),
             chords.state + n);
        hn::StoreU(hn::Zero(du), du, chords.done + n);
        n += more;
    }
    chords.count = n;
}

// Whether the ray is on the negative side of a coordinate plane (spa_sign).
HWY_INLINE MF is_negative(VF position, VF direction, VF crossing, VF at) {
    const VF zero = hn::Zero(df);
    const MF before = hn::Lt(at, crossing);
    const MF rises = hn::Gt(direction, zero);
    const MF moving = hn::Not(hn::Xor(before, rises));
    return select_mask(hn::Lt(hn::Abs(direction), hn::Set(df, SPA_TINY)), hn::Lt(position, zero), moving);
}

// The stretches of one pass, between two of a chord's five times, of all rays that are not done.
inline void find_stretches(const shader::SpaMap& map, std::size_t pass, ChordBlock& chords,
                           StretchBlock& jobs) {
    const std::size_t lane_count = hn::Lanes(df);
    const VF half_cells = hn::Set(df, float(map.width - 1) * 0.5F);
    const VF side = hn::Set(df, float(1U << map.levels));
    const VF core = hn::Set(df, 1.0F / map.w_core);
    const VF zero = hn::Zero(df);
    const VF one = hn::Set(df, 1.0F);
    const VF below_one = hn::Set(df, SPA_BELOW_ONE);
    const VF last = hn::Mul(side, below_one);
    const VF later = hn::Set(df, SPA_LATER);
    const VF tiny = hn::Set(df, 1e-20F);
    const VU low_bits = hn::Set(du, (1U << map.levels) - 1);
    const VU high_bit = hn::Set(du, 1U << map.levels);
    VU states = hn::Set(du, SPA_OUTSIDE);
    std::size_t n = 0;
    for (std::size_t first = 0; first < chords.count; first += lane_count) {
        const VF ta = hn::LoadU(df, chords.time[pass] + first);
        const VF tb = hn::LoadU(df, chords.time[pass + 1] + first);
        const MU open = hn::AndNot(hn::MaskFromVec(hn::LoadU(du, chords.done + first)),
                                   hn::FirstN(du, chords.count - first));
        const MF wanted = hn::And(hn::RebindMask(df, open), hn::Lt(ta, tb));
        if (hn::AllFalse(df, wanted)) continue;
        const VectorLanes foot{hn::LoadU(df, chords.foot_x + first), hn::LoadU(df, chords.foot_y + first),
                               hn::LoadU(df, chords.foot_z + first)};
        const VectorLanes direction{hn::LoadU(df, chords.direction_x + first),
                                    hn::LoadU(df, chords.direction_y + first),
                                    hn::LoadU(df, chords.direction_z + first)};
        const VF middle = hn::Mul(hn::Add(ta, tb), hn::Set(df, 0.5F));
        const MF left = is_negative(foot.x, direction.x, hn::LoadU(df, chords.cross_x + first), middle);
        const MF below = is_negative(foot.y, direction.y, hn::LoadU(df, chords.cross_y + first), middle);
        const MF lower = is_negative(foot.z, direction.z, hn::LoadU(df, chords.cross_z + first), middle);
        const auto place = [&](VF position, VF change, VF t, MF negative) {
            const VF p = hn::Add(position, hn::Mul(change, t));
            return hn::Max(hn::IfThenElse(negative, hn::Neg(p), p), zero);
        };
        VectorLanes a{place(foot.x, direction.x, ta, left), place(foot.y, direction.y, ta, below),
                      place(foot.z, direction.z, ta, lower)};
        VectorLanes b{place(foot.x, direction.x, tb, left), place(foot.y, direction.y, tb, below),
                      place(foot.z, direction.z, tb, lower)};
        VF la = hn::Add(hn::Add(a.x, a.y), a.z);
        VF lb = hn::Add(hn::Add(b.x, b.y), b.z);
        const MF core_a = hn::Lt(la, core);
        const MF core_b = hn::Lt(lb, core);
        VF start = ta;
        VF end = tb;
        MF outside = wanted;
        if (!hn::AllFalse(df, hn::Or(core_a, core_b))) {
            const VF f = hn::Div(hn::Sub(core, la), hn::Sub(lb, la));
            const VF fa = hn::IfThenElse(core_a, f, zero);
            const VF fb = hn::IfThenElse(core_b, f, one);
            outside = hn::And(outside, hn::AndNot(hn::And(core_a, core_b), hn::Lt(fa, fb)));
            const VectorLanes step{hn::Sub(b.x, a.x), hn::Sub(b.y, a.y), hn::Sub(b.z, a.z)};
            const VectorLanes cut_a = along(a, step, fa);
            const VectorLanes cut_b = along(a, step, fb);
            b = {hn::IfThenElse(core_b, cut_b.x, b.x), hn::IfThenElse(core_b, cut_b.y, b.y),
                 hn::IfThenElse(core_b, cut_b.z, b.z)};
            a = {hn::IfThenElse(core_a, cut_a.x, a.x), hn::IfThenElse(core_a, cut_a.y, a.y),
                 hn::IfThenElse(core_a, cut_a.z, a.z)};
            la = hn::IfThenElse(core_a, core, la);
            lb = hn::IfThenElse(core_b, core, lb);
            const VF length = hn::Sub(tb, ta);
            start = hn::Add(ta, hn::Mul(length, fa));
            end = hn::IfThenElse(hn::Lt(fb, one), hn::Add(ta, hn::Mul(length, fb)), tb);
        }
        const std::size_t more = hn::CountTrue(df, outside);
        if (more == 0) continue;
        const VF wa = hn::Div(one, la);
        const VF wb = hn::Div(one, lb);
        const auto coordinate = [&](VF p, VF z, VF w) {
            return hn::Mul(hn::Min(hn::Mul(hn::IfThenElse(lower, hn::Add(p, z), p), w), below_one),
                           half_cells);
        };
        const VF xa = coordinate(a.x, a.z, wa);
        const VF ya = coordinate(a.y, a.z, wa);
        const VF xb = coordinate(b.x, b.z, wb);
        const VF yb = coordinate(b.y, b.z, wb);
        const MF turn_x = hn::Lt(xb, xa);
        const MF turn_y = hn::Lt(yb, ya);
        const auto start_of = [&](MF turn, VF p) {
            return hn::IfThenElse(turn, hn::Min(hn::Sub(side, p), last), p);
        };
        const VF x0 = start_of(turn_x, xa);
        const VF y0 = start_of(turn_y, ya);
        const auto change = [&](MF turn, VF p, VF from) {
            return hn::Max(hn::Sub(hn::IfThenElse(turn, hn::Sub(side, p), p), from), zero);
        };
        const VF dx = change(turn_x, xb, x0);
        const VF dy = change(turn_y, yb, y0);
        const auto flip = [&](MF turn, MF negative) {
            return hn::Or(hn::IfThenElseZero(hn::RebindMask(du, turn), low_bits),
                          hn::IfThenElseZero(hn::RebindMask(du, negative), high_bit));
        };
        const MU outside_u = hn::RebindMask(du, outside);
        const Packer pack(outside_u);
        pack(hn::Iota(du, std::uint32_t(first)), jobs.chord + n);
        pack(x0, jobs.x0 + n);
        pack(y0, jobs.y0 + n);
        pack(wa, jobs.w0 + n);
        pack(dx, jobs.dx + n);
        pack(dy, jobs.dy + n);
        pack(hn::Sub(wb, wa), jobs.dw + n);
        pack(hn::Div(later, hn::Max(dx, tiny)), jobs.per_x + n);
        pack(hn::Div(later, hn::Max(dy, tiny)), jobs.per_y + n);
        pack(start, jobs.ta + n);
        pack(end, jobs.tb + n);
        pack(flip(turn_x, left), jobs.flip_x + n);
        pack(flip(turn_y, below), jobs.flip_y + n);
        pack(to_words(x0), jobs.x + n);
        pack(to_words(y0), jobs.y + n);
        pack(hn::VecFromMask(du, hn::RebindMask(du, lower)), jobs.lower + n);
        const VU state = hn::LoadU(du, chords.state + first);
        pack(state, jobs.state + n);
        states = hn::Or(states, hn::IfThenElseZero(outside_u, state));
        // A walk leaves a ray outside if it does not say otherwise.
        hn::StoreU(hn::IfThenElse(outside_u, hn::Set(du, SPA_OUTSIDE), state), du, chords.state + first);
        n += more;
    }
    jobs.count = n;
    jobs.any_state = !hn::AllTrue(du, hn::Eq(states, hn::Set(du, SPA_OUTSIDE)));
    // Vectors are loaded whole, also of what lies behind the last job: lanes that get nothing else look at
    // cell 0.
    for (std::size_t i = 0; i < n + lane_count; i += lane_count)
        hn::StoreU(hn::Iota(du, std::uint32_t(i)), du, jobs.number + i);
    for (Words* const words : {&jobs.x, &jobs.y, &jobs.flip_x, &jobs.flip_y})
        hn::StoreU(hn::Zero(du), du, *words + n);
}

} // namespace spa::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
