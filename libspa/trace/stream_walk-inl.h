// SPDX-License-Identifier: Apache-2.0
// spa_walk of ../../shaders/spa_projective.h, many stretches at once.
//
// Every lane holds one stretch and takes one step (down, or on to the next node) at a time. A lane that has
// come to a cell waits until enough others have, since what happens in a cell is long; lanes whose stretch
// has ended are filled again with the next ones when enough are free. Two groups of lanes take turns, so that
// one computes while the other waits for its memory.
#include "stream_cell-inl.h"

#if defined(SPA_STREAM_WALK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPA_STREAM_WALK_INL
#undef SPA_STREAM_WALK_INL
#else
#define SPA_STREAM_WALK_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace spa::trace::HWY_NAMESPACE {

// Lane i of `mask`, the k-th of them, becomes from[k]; other lanes keep `old`.
#if HWY_TARGET == HWY_AVX3
HWY_INLINE VF expand(VF old, MU mask, const float* from) {
    return VF{_mm512_mask_expandloadu_ps(old.raw, mask.raw, from)};
}
HWY_INLINE VU expand(VU old, MU mask, const std::uint32_t* from) {
    return VU{_mm512_mask_expandloadu_epi32(old.raw, mask.raw, from)};
}
#else
template <class V, class T>
HWY_INLINE V expand(V old, MU mask, const T* from) {
    const hn::DFromV<V> d;
    HWY_ALIGN std::uint32_t wanted[hn::MaxLanes(du)];
    HWY_ALIGN T lanes[hn::MaxLanes(du)];
    hn::Store(hn::VecFromMask(du, mask), du, wanted);
    hn::Store(old, d, lanes);
    for (std::size_t i = 0; i < hn::Lanes(du); ++i)
        if (wanted[i] != 0) lanes[i] = *from++;
    return hn::Load(d, lanes);
}
#endif

// What all lanes share.
struct WalkConstants {
    const std::uint32_t* nodes = nullptr;
    const std::uint32_t* cells = nullptr; // none: no cell is mixed
    VU levels, start, top;
    VU last; // cell of a quadrant
    VU code_base;
    int code_shift = 0;
    std::size_t lanes = 0, enough_waiting = 0, enough_free = 0;
};

HWY_INLINE WalkConstants walk_constants(const shader::SpaMap& map) {
    WalkConstants constants;
    constants.nodes = map.words.first + map.nodes;
    constants.cells = map.cells == 0 ? nullptr : map.words.first + map.cells;
    constants.levels = hn::Set(du, map.levels);
    constants.start = hn::Set(du, map.levels > SPA_START_BITS ? map.levels - SPA_START_BITS : 0);
    constants.top = hn::Set(du, map.levels > SPA_TOP_BITS ? map.levels - SPA_TOP_BITS : 0);
    constants.last = hn::Set(du, (1U << map.levels) - 1);
    constants.code_base = hn::Set(du, map.code_base);
    constants.code_shift = int(map.code_shift);
    constants.lanes = hn::Lanes(du);
    constants.enough_waiting = (constants.lanes + 1) / 2;
    constants.enough_free = (constants.lanes + 3) / 4;
    return constants;
}

struct WalkLanes {
    StretchLanes stretch;
    VF per_x, per_y;
    VU x, y, level;
    VF s;
    VU job;
    MU alive, waits,
        unknown; // waits: at a cell; unknown: at the first cell of a ray that may begin in the solid
    std::size_t count = 0; // alive
};

HWY_INLINE WalkLanes no_jobs() {
    WalkLanes lanes;
    const VF zero = hn::Zero(df);
    const VU none = hn::Zero(du);
    lanes.stretch = {zero, zero, zero, zero, zero, zero, none, none};
    lanes.per_x = lanes.per_y = lanes.s = zero;
    lanes.x = lanes.y = lanes.level = lanes.job = none;
    lanes.alive = lanes.waits = lanes.unknown = no_word_lanes();
    return lanes;
}

// Gives the lanes that are free the jobs from `next` on.
HWY_INLINE void refill(const WalkConstants& constants, const StretchBlock& jobs, std::size_t& next,
                       WalkLanes& lanes) {
    const MU fresh = hn::Not(lanes.alive);
    StretchLanes& stretch = lanes.stretch;
    stretch.x0 = expand(stretch.x0, fresh, jobs.x0 + next);
    stretch.y0 = expand(stretch.y0, fresh, jobs.y0 + next);
    stretch.w0 = expand(stretch.w0, fresh, jobs.w0 + next);
    stretch.dx = expand(stretch.dx, fresh, jobs.dx + next);
    stretch.dy = expand(stretch.dy, fresh, jobs.dy + next);
    stretch.dw = expand(stretch.dw, fresh, jobs.dw + next);
    stretch.flip_x = expand(stretch.flip_x, fresh, jobs.flip_x + next);
    stretch.flip_y = expand(stretch.flip_y, fresh, jobs.flip_y + next);
    lanes.per_x = expand(lanes.per_x, fresh, jobs.per_x + next);
    lanes.per_y = expand(lanes.per_y, fresh, jobs.per_y + next);
    lanes.x = expand(lanes.x, fresh, jobs.x + next);
    lanes.y = expand(lanes.y, fresh, jobs.y + next);
    lanes.job = expand(lanes.job, fresh, jobs.number + next);
    lanes.s = hn::IfThenZeroElse(hn::RebindMask(df, fresh), lanes.s);
    // Behind the last job there is nothing; such lanes stay free.
    const MU real =
        hn::RebindMask(du, hn::Lt(hn::BitCast(di, lanes.job), hn::Set(di, std::int32_t(jobs.count))));
    lanes.alive = hn::And(hn::Or(lanes.alive, fresh), real);
    lanes.unknown =
        hn::And(hn::And(fresh, real), hn::MaskFromVec(expand(hn::Zero(du), fresh, jobs.unknown + next)));
    lanes.waits = hn::Or(hn::AndNot(fresh, lanes.waits), lanes.unknown);
    lanes.level = hn::IfThenElse(fresh, constants.start, lanes.level);
    lanes.level = hn::IfThenZeroElse(lanes.unknown, lanes.level);
    const std::size_t more = std::min(constants.lanes - lanes.count, jobs.count - next);
    lanes.count += more;
    next += more;
}

// Where a lane leaves its node.
struct ExitLanes {
    VU next_x, next_y;
    VF exit_x, exit_y, s1;
};

HWY_INLINE ExitLanes exits(const WalkLanes& lanes) {
    const VU one = hn::Set(du, 1);
    ExitLanes e;
    e.next_x = hn::Shl(hn::Add(hn::Shr(lanes.x, lanes.level), one), lanes.level);
    e.next_y = hn::Shl(hn::Add(hn::Shr(lanes.y, lanes.level), one), lanes.level);
    e.exit_x = hn::Mul(hn::Sub(to_floats(e.next_x), lanes.stretch.x0), lanes.per_x);
    e.exit_y = hn::Mul(hn::Sub(to_floats(e.next_y), lanes.stretch.y0), lanes.per_y);
    e.s1 = hn::Max(hn::Min(hn::Min(e.exit_x, e.exit_y), hn::Set(df, 1.0F)), lanes.s);
    return e;
}

// Moves the lanes of `mask` on to the next node.
HWY_INLINE void advance(const WalkConstants& constants, const ExitLanes& e, MU mask, WalkLanes& lanes) {
    const VU one = hn::Set(du, 1);
    const MF by_x = hn::Le(e.exit_x, e.exit_y);
    const MU by_x_u = hn::RebindMask(du, by_x);
    const StretchLanes& stretch = lanes.stretch;
    // The coordinate that does not pass a border.
    const VF start = hn::IfThenElse(by_x, stretch.y0, stretch.x0);
    const VF change = hn::IfThenElse(by_x, stretch.dy, stretch.dx);
    const VU least = hn::IfThenElse(by_x_u, lanes.y, lanes.x);
    const VU most = hn::Sub(hn::IfThenElse(by_x_u, e.next_y, e.next_x), one);
    const VU along = hn::Max(least, hn::Min(to_words(hn::Add(start, hn::Mul(e.s1, change))), most));
    const VU passed = hn::IfThenElse(by_x_u, e.next_x, e.next_y);
    const MU climbs = hn::And(mask, hn::Eq(hn::And(hn::Shr(passed, lanes.level), one), hn::Zero(du)));
    lanes.level = hn::IfThenElse(climbs, hn::Min(hn::Add(lanes.level, one), constants.top), lanes.level);
    lanes.x = hn::IfThenElse(mask, hn::Min(hn::IfThenElse(by_x_u, passed, along), constants.last), lanes.x);
    lanes.y = hn::IfThenElse(mask, hn::Min(hn::IfThenElse(by_x_u, along, passed), constants.last), lanes.y);
    lanes.s = hn::IfThenElse(hn::RebindMask(df, mask), e.s1, lanes.s);
}

// Whether anything in the node may be solid for the piece of the ray over it (spa_meets).
template <bool with_inner>
HWY_INLINE MU meets(const WalkConstants& constants, const WalkLanes& lanes, VF s1) {
    const StretchLanes& stretch = lanes.stretch;
    const VU bits = hn::Sub(constants.levels, lanes.level);
    const VU before =
        hn::AndNot(hn::Shl(hn::Set(du, 0xFFFFFFFC), hn::Add(bits, bits)), hn::Set(du, 0x55555554));
    const VU row = hn::Shr(hn::Xor(lanes.y, stretch.flip_y), lanes.level);
    const VU column = hn::Shr(hn::Xor(lanes.x, stretch.flip_x), lanes.level);
    const VU node = hn::Add(hn::Add(before, hn::Shl(row, hn::Add(bits, hn::Set(du, 1)))), column);
    const VF wa = hn::Add(stretch.w0, hn::Mul(lanes.s, stretch.dw));
    const VF wb = hn::Add(stretch.w0, hn::Mul(s1, stretch.dw));
    const VF high = hn::Max(wa, wb);
    if constexpr (!with_inner) {
        return hn::RebindMask(du, hn::Ge(high, hn::BitCast(df, gather(constants.nodes, node))));
    } else {
        const VF low = hn::Min(wa, wb);
        const VU low_code = hn::Set(du, 0xFFFF);
        const auto decode = [&](VU code) {
            return hn::BitCast(df,
                               hn::Add(constants.code_base, hn::ShiftLeftSame(code, constants.code_shift)));
        };
        const VU place = hn::Add(node, node);
        const VU first = gather(constants.nodes, place);
        const VU second = gather(constants.nodes + 1, place);
        const auto in = [&](VU range) {
            return hn::And(hn::Ge(high, decode(hn::And(range, low_code))),
                           hn::Le(low, decode(hn::ShiftRight<16>(range))));
        };
        return hn::RebindMask(du, hn::Or(in(first), in(second)));
    }
}

enum class Mixed { nothing, event, unusual };

// A cell with a mixed triangle, by the text.
inline Mixed cross_mixed(const shader::SpaMap& map, const StretchBlock& jobs, std::size_t job,
                         std::uint32_t x, std::uint32_t y, float s0, float s1, bool unknown) {
    shader::SpaEvent event{};
    shader::SpaPiece piece{};
    shader::SpaTriangle tri{};
    shader::uint state = unknown ? SPA_UNKNOWN : SPA_OUTSIDE;
    const bool any =
        shader::spa_cross_cell(map, load_stretch(map, jobs, job), x, y, s0, s1, 0, state, event, piece, tri);
    if (any) return event.front ? Mixed::event : Mixed::unusual;
    return state == SPA_INSIDE ? Mixed::unusual : Mixed::nothing;
}

// The lanes of `mixed`, one after the other.
HWY_NOINLINE void cross_mixed_lanes(const shader::SpaMap& map, const StretchBlock& jobs,
                                    const WalkLanes& lanes, VF s1, MU mixed, MU& event, MU& unusual) {
    HWY_ALIGN std::uint32_t kinds[hn::MaxLanes(du)] = {}, x[hn::MaxLanes(du)], y[hn::MaxLanes(du)],
                            job[hn::MaxLanes(du)], wanted[hn::MaxLanes(du)], unknown[hn::MaxLanes(du)];
    HWY_ALIGN float from[hn::MaxLanes(df)], to[hn::MaxLanes(df)];
    hn::Store(lanes.x, du, x);
    hn::Store(lanes.y, du, y);
    hn::Store(lanes.job, du, job);
    hn::Store(hn::VecFromMask(du, mixed), du, wanted);
    hn::Store(hn::VecFromMask(du, lanes.unknown), du, unknown);
    hn::Store(lanes.s, df, from);
    hn::Store(s1, df, to);
    for (std::size_t i = 0; i < hn::Lanes(du); ++i)
        if (wanted[i] != 0)
            kinds[i] =
                std::uint32_t(cross_mixed(map, jobs, job[i], x[i], y[i], from[i], to[i], unknown[i] != 0));
    const VU kind = hn::Load(du, kinds);
    event = hn::Eq(kind, hn::Set(du, std::uint32_t(Mixed::event)));
    unusual = hn::Eq(kind, hn::Set(du, std::uint32_t(Mixed::unusual)));
}

// What the lanes of lanes.waits meet in their cells goes to `results`. Gives back which of them met
// something.
template <bool with_inner>
HWY_INLINE MU cross(const shader::SpaMap& map, const WalkConstants& constants, const StretchBlock& jobs,
                    const WalkLanes& lanes, VF s1, ResultBlock& results) {
    MU pure = lanes.waits;
    MU unusual = no_word_lanes();
    MU event = no_word_lanes();
    if (constants.cells != nullptr) {
        const VU row =
            hn::Shl(hn::Xor(lanes.y, lanes.stretch.flip_y), hn::Add(constants.levels, hn::Set(du, 1)));
        const VU place = hn::Add(row, hn::Xor(lanes.x, lanes.stretch.flip_x));
        const MU mixed = hn::And(lanes.waits, hn::Ne(gather(constants.cells, place), hn::Zero(du)));
        if (!hn::AllFalse(du, mixed)) {
            pure = hn::AndNot(mixed, pure);
            cross_mixed_lanes(map, jobs, lanes, s1, mixed, event, unusual);
        }
    }
    const CrossLanes cells = cross_cells<with_inner>(map, lanes.stretch, {lanes.x, lanes.y, lanes.s, s1});
    const MU inside = hn::And(lanes.unknown, hn::RebindMask(du, cells.starts_inside));
    unusual = hn::Or(unusual, hn::And(pure, inside));
    const MU surface = hn::AndNot(inside, hn::And(pure, hn::RebindMask(du, cells.any)));
    const MU found = hn::Or(surface, hn::Or(event, unusual));
    if (hn::AllFalse(du, found)) return found;
    VU kind = hn::IfThenElseZero(event, hn::Set(du, std::uint32_t(Found::event)));
    kind = hn::IfThenElse(unusual, hn::Set(du, std::uint32_t(Found::unusual)), kind);
    const MF found_f = hn::RebindMask(df, found);
    const std::size_t n = results.count;
    append(lanes.job, found, results.job + n);
    append(kind, found, results.found + n);
    append(lanes.x, found, results.x + n);
    append(lanes.y, found, results.y + n);
    append(lanes.s, found_f, results.s0 + n);
    append(s1, found_f, results.s1 + n);
    const StretchLanes& stretch = lanes.stretch;
    append(stretch.x0, found_f, results.x0 + n);
    append(stretch.y0, found_f, results.y0 + n);
    append(stretch.w0, found_f, results.w0 + n);
    append(stretch.dx, found_f, results.dx + n);
    append(stretch.dy, found_f, results.dy + n);
    append(stretch.dw, found_f, results.dw + n);
    append(stretch.flip_x, found, results.flip_x + n);
    append(stretch.flip_y, found, results.flip_y + n);
    results.count = n + hn::CountTrue(du, found);
    return found;
}

// One step of a group of lanes.
template <bool with_inner>
HWY_INLINE void step(const shader::SpaMap& map, const WalkConstants& constants, const StretchBlock& jobs,
                     std::size_t& next, WalkLanes& lanes, ResultBlock& results) {
    if (constants.lanes - lanes.count >= constants.enough_free && next < jobs.count)
        refill(constants, jobs, next, lanes);
    const ExitLanes e = exits(lanes);
    const MU met = meets<with_inner>(constants, lanes, e.s1);
    const MU steps = hn::AndNot(lanes.waits, lanes.alive);
    const MU at_cells = hn::Eq(lanes.level, hn::Zero(du));
    const MU meeting = hn::And(steps, met);
    lanes.waits = hn::Or(lanes.waits, hn::And(meeting, at_cells));
    lanes.level =
        hn::IfThenElse(hn::AndNot(at_cells, meeting), hn::Sub(lanes.level, hn::Set(du, 1)), lanes.level);
    MU on = hn::AndNot(met, steps);
    const std::size_t waiting = hn::CountTrue(du, lanes.waits);
    if (waiting >= constants.enough_waiting || (waiting > 0 && hn::AllFalse(du, steps))) {
        const MU found = cross<with_inner>(map, constants, jobs, lanes, e.s1, results);
        on = hn::Or(on, hn::AndNot(found, lanes.waits));
        lanes.alive = hn::AndNot(found, lanes.alive);
        lanes.unknown = hn::AndNot(lanes.waits, lanes.unknown);
        lanes.waits = no_word_lanes();
    }
    const MU ended = hn::And(on, hn::RebindMask(du, hn::Ge(e.s1, hn::Set(df, 1.0F))));
    lanes.alive = hn::AndNot(ended, lanes.alive);
    lanes.count = hn::CountTrue(du, lanes.alive);
    advance(constants, e, hn::AndNot(ended, on), lanes);
}

// Walks all jobs and writes down what they found.
template <bool with_inner>
void walk(const shader::SpaMap& map, const StretchBlock& jobs, ResultBlock& results) {
    const WalkConstants constants = walk_constants(map);
    results.count = 0;
    std::size_t next = 0;
    WalkLanes a = no_jobs();
    WalkLanes b = no_jobs();
    do {
        step<with_inner>(map, constants, jobs, next, a, results);
        step<with_inner>(map, constants, jobs, next, b, results);
    } while (a.count + b.count > 0 || next < jobs.count);
}

} // namespace spa::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
