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

// Spreads words over the lanes of a mask: lane i, the k-th of them, becomes from[k]; other lanes keep `old`.
class Expander {
public:
#if HWY_TARGET == HWY_AVX3
    HWY_INLINE explicit Expander(MU mask) : mask_(mask) {}

    [[nodiscard]] HWY_INLINE VF operator()(VF old, const float* from) const {
        return VF{_mm512_mask_expandloadu_ps(old.raw, mask_.raw, from)};
    }
    [[nodiscard]] HWY_INLINE VU operator()(VU old, const std::uint32_t* from) const {
        return VU{_mm512_mask_expandloadu_epi32(old.raw, mask_.raw, from)};
    }

private:
    MU mask_;
#else
    HWY_INLINE explicit Expander(MU mask) : mask_(mask), ranks_(ranks(mask)) {}

    [[nodiscard]] HWY_INLINE VF operator()(VF old, const float* from) const {
        const VF spread = hn::TableLookupLanes(hn::LoadU(df, from), hn::IndicesFromVec(df, ranks_));
        return hn::IfThenElse(hn::RebindMask(df, mask_), spread, old);
    }
    [[nodiscard]] HWY_INLINE VU operator()(VU old, const std::uint32_t* from) const {
        const VU spread = hn::TableLookupLanes(hn::LoadU(du, from), hn::IndicesFromVec(du, ranks_));
        return hn::IfThenElse(mask_, spread, old);
    }

private:
    // How many lanes of the mask are before each lane.
    static HWY_INLINE VI ranks(MU mask) {
        HWY_ALIGN std::uint32_t wanted[hn::MaxLanes(du)];
        HWY_ALIGN std::int32_t before[hn::MaxLanes(du)];
        hn::Store(hn::VecFromMask(du, mask), du, wanted);
        std::int32_t count = 0;
        for (std::size_t i = 0; i < hn::Lanes(du); ++i) {
            before[i] = count;
            count += wanted[i] != 0 ? 1 : 0;
        }
        // Those behind the last one of the mask are not used.
        return hn::Min(hn::Load(di, before), hn::Set(di, std::int32_t(hn::Lanes(du)) - 1));
    }

    MU mask_;
    VI ranks_;
#endif
};

// What all lanes share.
struct WalkConstants {
    const std::uint32_t* nodes = nullptr;
    const std::uint32_t* cells = nullptr; // none: all are SPA_CELL_PURE
    const float* cores = nullptr;         // none: in the solid every cell is looked at
    std::uint32_t flags = 0;
    VU levels, start, top;
    VU last; // cell of a quadrant
    VU code_base;
    int code_shift = 0;
    std::size_t lanes = 0, enough_waiting = 0, enough_free = 0;
};

HWY_INLINE WalkConstants walk_constants(const shader::SpaMap& map, std::uint32_t flags) {
    WalkConstants constants;
    constants.nodes = map.words.first + map.nodes;
    constants.cells = map.cells == 0 ? nullptr : map.words.first + map.cells;
    constants.cores = map.cores == 0 ? nullptr : reinterpret_cast<const float*>(map.words.first + map.cores);
    constants.flags = flags;
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
    MU alive, waits;    // waits: at a cell
    MU inside, unknown; // the states; unknown: at a ray's first cell
    bool any_inside = false;
    std::size_t count = 0; // alive
};

HWY_INLINE WalkLanes no_jobs() {
    WalkLanes lanes;
    const VF zero = hn::Zero(df);
    const VU none = hn::Zero(du);
    lanes.stretch = {zero, zero, zero, zero, zero, zero, none, none};
    lanes.per_x = lanes.per_y = lanes.s = zero;
    lanes.x = lanes.y = lanes.level = lanes.job = none;
    lanes.alive = lanes.waits = lanes.inside = lanes.unknown = no_word_lanes();
    return lanes;
}

// Gives the lanes that are free the jobs from `next` on.
HWY_INLINE void refill(const WalkConstants& constants, const StretchBlock& jobs, std::size_t& next,
                       WalkLanes& lanes) {
    const MU fresh = hn::Not(lanes.alive);
    const Expander expand(fresh);
    StretchLanes& stretch = lanes.stretch;
    stretch.x0 = expand(stretch.x0, jobs.x0 + next);
    stretch.y0 = expand(stretch.y0, jobs.y0 + next);
    stretch.w0 = expand(stretch.w0, jobs.w0 + next);
    stretch.dx = expand(stretch.dx, jobs.dx + next);
    stretch.dy = expand(stretch.dy, jobs.dy + next);
    stretch.dw = expand(stretch.dw, jobs.dw + next);
    stretch.flip_x = expand(stretch.flip_x, jobs.flip_x + next);
    stretch.flip_y = expand(stretch.flip_y, jobs.flip_y + next);
    lanes.per_x = expand(lanes.per_x, jobs.per_x + next);
    lanes.per_y = expand(lanes.per_y, jobs.per_y + next);
    lanes.x = expand(lanes.x, jobs.x + next);
    lanes.y = expand(lanes.y, jobs.y + next);
    lanes.job = expand(lanes.job, jobs.number + next);
    lanes.s = hn::IfThenZeroElse(hn::RebindMask(df, fresh), lanes.s);
    // Behind the last job there is nothing; such lanes stay free.
    const MU real =
        hn::RebindMask(du, hn::Lt(hn::BitCast(di, lanes.job), hn::Set(di, std::int32_t(jobs.count))));
    lanes.alive = hn::And(hn::Or(lanes.alive, fresh), real);
    lanes.waits = hn::AndNot(fresh, lanes.waits);
    lanes.level = hn::IfThenElse(fresh, constants.start, lanes.level);
    if (jobs.any_state) {
        const VU state = expand(hn::Zero(du), jobs.state + next);
        const auto begins = [&](std::uint32_t as) {
            return hn::And(hn::And(fresh, real), hn::Eq(state, hn::Set(du, as)));
        };
        lanes.inside = hn::Or(hn::AndNot(fresh, lanes.inside), begins(SPA_INSIDE));
        lanes.unknown = hn::Or(hn::AndNot(fresh, lanes.unknown), begins(SPA_UNKNOWN));
        lanes.any_inside = !hn::AllFalse(du, lanes.inside);
        lanes.waits = hn::Or(lanes.waits, lanes.unknown);
        lanes.level = hn::IfThenZeroElse(lanes.unknown, lanes.level);
    }
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

// Whether the node has something to look for: an end of the solid, from outside or from inside.
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
    const VF low = hn::Min(wa, wb);
    MU met;
    if constexpr (!with_inner) {
        met = hn::RebindMask(du, hn::Ge(high, hn::BitCast(df, gather(constants.nodes, node))));
    } else {
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
        met = hn::RebindMask(du, hn::Or(in(first), in(second)));
    }
    if (!lanes.any_inside) return met;
    if (constants.cores == nullptr) return hn::Or(met, lanes.inside);
    const VI index = hn::BitCast(di, node);
    const MU ends = hn::RebindMask(du, hn::Lt(low, hn::GatherIndex(df, constants.cores, index)));
    return hn::Or(hn::AndNot(lanes.inside, met), hn::And(lanes.inside, ends));
}

// What came of the lanes that the text took through their cells.
struct ByText {
    MU event, inside; // event: to be reported; inside: the state after the cell
    VU before;        // the state before it
};

// Takes the lanes of `mask` through their cells, one after the other.
inline HWY_NOINLINE ByText cross_by_text(const shader::SpaMap& map, const WalkConstants& constants,
                                         const StretchBlock& jobs, const WalkLanes& lanes, VF s1, MU mask) {
    HWY_ALIGN std::uint32_t x[hn::MaxLanes(du)], y[hn::MaxLanes(du)], job[hn::MaxLanes(du)],
        wanted[hn::MaxLanes(du)], state[hn::MaxLanes(du)], event[hn::MaxLanes(du)] = {};
    HWY_ALIGN float from[hn::MaxLanes(df)], to[hn::MaxLanes(df)];
    VU before = hn::IfThenElse(lanes.inside, hn::Set(du, SPA_INSIDE), hn::Set(du, SPA_OUTSIDE));
    before = hn::IfThenElse(lanes.unknown, hn::Set(du, SPA_UNKNOWN), before);
    hn::Store(before, du, state);
    hn::Store(lanes.x, du, x);
    hn::Store(lanes.y, du, y);
    hn::Store(lanes.job, du, job);
    hn::Store(hn::VecFromMask(du, mask), du, wanted);
    hn::Store(lanes.s, df, from);
    hn::Store(s1, df, to);
    for (std::size_t i = 0; i < hn::Lanes(du); ++i) {
        if (wanted[i] == 0) continue;
        shader::SpaEvent found = shader::spa_no_event();
        shader::SpaPiece piece{};
        shader::SpaTriangle tri{};
        event[i] = shader::spa_cross_cell(map, load_stretch(map, jobs, job[i]), x[i], y[i], from[i], to[i],
                                          constants.flags, state[i], found, piece, tri)
                       ? 1
                       : 0;
    }
    return {hn::Ne(hn::Load(du, event), hn::Zero(du)),
            hn::And(mask, hn::Eq(hn::Load(du, state), hn::Set(du, SPA_INSIDE))), before};
}

// What the lanes of lanes.waits meet in their cells goes to `results`, and their states change. Gives back
// which of them met something.
template <bool with_inner>
HWY_INLINE MU cross(const shader::SpaMap& map, const WalkConstants& constants, const StretchBlock& jobs,
                    WalkLanes& lanes, VF s1, ResultBlock& results) {
    VU word = hn::Zero(du);
    if (constants.cells != nullptr) {
        const VU row =
            hn::Shl(hn::Xor(lanes.y, lanes.stretch.flip_y), hn::Add(constants.levels, hn::Set(du, 1)));
        word = gather(constants.cells, hn::Add(row, hn::Xor(lanes.x, lanes.stretch.flip_x)));
    }
    const bool has_layers =
        with_inner &&
        !hn::AllFalse(du, hn::And(lanes.waits, hn::Eq(word, hn::Set(du, std::uint32_t(SPA_CELL_LAYERS)))));
    const CrossLanes cells = cross_cells<with_inner>(map, lanes.stretch, {lanes.x, lanes.y, lanes.s, s1},
                                                     has_layers ? (map.surfaces + 1) / 2 : 1);
    // Vectors take rays from outside through pure cells. What begins at an edge of a triangle is looked at
    // twice.
    MU by_text = hn::Or(lanes.inside, hn::And(lanes.unknown, hn::RebindMask(du, cells.starts_inside)));
    by_text = hn::Or(by_text, hn::RebindMask(du, hn::And(cells.any, cells.by_edge)));
    by_text = hn::Or(by_text, hn::Gt(word, hn::Set(du, std::uint32_t(SPA_CELL_LAYERS))));
    if ((constants.flags & SPA_CULL_FRONT) != 0) by_text = lanes.alive;
    by_text = hn::And(by_text, lanes.waits);
    const MU surface = hn::AndNot(by_text, hn::And(lanes.waits, hn::RebindMask(du, cells.any)));
    MU found = surface;
    VU kind = hn::Zero(du);
    if (!hn::AllFalse(du, by_text)) {
        const ByText text = cross_by_text(map, constants, jobs, lanes, s1, by_text);
        found = hn::Or(found, text.event);
        kind = hn::IfThenElseZero(text.event, hn::Add(hn::Set(du, std::uint32_t(Found::event)), text.before));
        lanes.inside = hn::Or(hn::AndNot(by_text, lanes.inside), text.inside);
        lanes.any_inside = !hn::AllFalse(du, lanes.inside);
    }
    lanes.unknown = hn::AndNot(lanes.waits, lanes.unknown);
    if (hn::AllFalse(du, found)) return found;
    const Packer pack(found);
    const std::size_t n = results.count;
    pack(lanes.job, results.job + n);
    pack(kind, results.found + n);
    pack(lanes.x, results.x + n);
    pack(lanes.y, results.y + n);
    pack(lanes.s, results.s0 + n);
    pack(s1, results.s1 + n);
    const StretchLanes& stretch = lanes.stretch;
    pack(stretch.x0, results.x0 + n);
    pack(stretch.y0, results.y0 + n);
    pack(stretch.w0, results.w0 + n);
    pack(stretch.dx, results.dx + n);
    pack(stretch.dy, results.dy + n);
    pack(stretch.dw, results.dw + n);
    pack(stretch.flip_x, results.flip_x + n);
    pack(stretch.flip_y, results.flip_y + n);
    results.count = n + hn::CountTrue(du, found);
    return found;
}

// Stretches that end in the solid: the ray's next one begins there.
inline HWY_NOINLINE void keep_states(const StretchBlock& jobs, VU job, MU inside, ChordBlock& chords) {
    HWY_ALIGN std::uint32_t all[hn::MaxLanes(du)], wanted[hn::MaxLanes(du)];
    hn::Store(job, du, all);
    hn::Store(hn::VecFromMask(du, inside), du, wanted);
    for (std::size_t i = 0; i < hn::Lanes(du); ++i)
        if (wanted[i] != 0) chords.state[jobs.chord[all[i]]] = SPA_INSIDE;
}

// One step of a group of lanes.
template <bool with_inner>
HWY_INLINE void step(const shader::SpaMap& map, const WalkConstants& constants, std::size_t& next,
                     WalkLanes& lanes, StreamBlock& block) {
    const StretchBlock& jobs = block.stretches;
    if (constants.lanes - lanes.count >= constants.enough_free && next < jobs.count)
        refill(constants, jobs, next, lanes);
    if (lanes.any_inside && constants.cores == nullptr)
        lanes.level = hn::IfThenZeroElse(lanes.inside, lanes.level);
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
        const MU found = cross<with_inner>(map, constants, jobs, lanes, e.s1, block.results);
        on = hn::Or(on, hn::AndNot(found, lanes.waits));
        lanes.alive = hn::AndNot(found, lanes.alive);
        lanes.waits = no_word_lanes();
    }
    const MU ended = hn::And(on, hn::RebindMask(du, hn::Ge(e.s1, hn::Set(df, 1.0F))));
    lanes.alive = hn::AndNot(ended, lanes.alive);
    if (lanes.any_inside) {
        const MU ended_inside = hn::And(ended, lanes.inside);
        if (!hn::AllFalse(du, ended_inside)) keep_states(jobs, lanes.job, ended_inside, block.chords);
        lanes.inside = hn::And(lanes.inside, lanes.alive);
        lanes.any_inside = !hn::AllFalse(du, lanes.inside);
    }
    lanes.count = hn::CountTrue(du, lanes.alive);
    advance(constants, e, hn::AndNot(ended, on), lanes);
}

// Walks all stretches of the block and writes down what they found.
template <bool with_inner>
void walk(const shader::SpaMap& map, std::uint32_t flags, StreamBlock& block) {
    const WalkConstants constants = walk_constants(map, flags);
    block.results.count = 0;
    std::size_t next = 0;
    WalkLanes a = no_jobs();
    WalkLanes b = no_jobs();
    do {
        step<with_inner>(map, constants, next, a, block);
        step<with_inner>(map, constants, next, b, block);
    } while (a.count + b.count > 0 || next < block.stretches.count);
}

} // namespace spa::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
