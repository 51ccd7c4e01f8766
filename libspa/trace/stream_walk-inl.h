// SPDX-License-Identifier: Apache-2.0
// spa_walk of ../../shaders/spa_projective.h, many stretches at once.
//
// Every lane holds one stretch and takes one step (down, or on to the next node) at a time. A lane that has
// come to a cell waits until enough others have, since what happens in a cell is long; lanes whose stretch
// has ended are filled again with the next ones when enough are free.
#include "stream_cell-inl.h"

#if defined(SPA_STREAM_WALK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SPA_STREAM_WALK_INL
#undef SPA_STREAM_WALK_INL
#else
#define SPA_STREAM_WALK_INL
#endif

HWY_BEFORE_NAMESPACE();
namespace spa::trace::HWY_NAMESPACE {

// What all lanes share.
struct WalkConstants {
    const std::uint32_t* nodes = nullptr;
    VU levels, start, top;
    VF w_max;
    VU code_base;
    int code_shift = 0;
    VU end, turned_end; // the border in x and y, as cells from the middle and turned
};

HWY_INLINE WalkConstants walk_constants(const shader::SpaMap& map) {
    WalkConstants constants;
    constants.nodes = map.words.first + map.nodes;
    constants.levels = hn::Set(du, map.levels);
    constants.start = hn::Set(du, map.levels > SPA_START_BITS ? map.levels - SPA_START_BITS : 0);
    constants.top = hn::Set(du, map.levels > SPA_TOP_BITS ? map.levels - SPA_TOP_BITS : 0);
    constants.w_max = hn::Set(df, map.w_max);
    constants.code_base = hn::Set(du, map.code_base);
    constants.code_shift = int(map.code_shift);
    constants.end = hn::Set(du, (map.width - 1) / 2);
    constants.turned_end = hn::Set(du, 1U << map.levels);
    return constants;
}

struct WalkLanes {
    StretchLanes stretch;
    VF per_x, per_y; // 0 where the ray does not move that way
    VU end_x, end_y;
    VU x, y, level;
    VF s;
    VU job;
    VU waits;   // all bits: at a cell
    VU unknown; // all bits: at the start of a ray that may begin in the solid
};

HWY_INLINE VU bit_mask(VU words, std::uint32_t bit) {
    return hn::VecFromMask(du, hn::Ne(hn::And(words, hn::Set(du, bit)), hn::Zero(du)));
}

// Fills the lanes from `lane` on with the jobs from `job` on.
HWY_INLINE void fill(const WalkConstants& constants, const StretchBlock& jobs, std::size_t job,
                     std::size_t lane, WalkLanes& lanes) {
    // Loaded so that job `job` lands in lane `lane`; what lies before the array's start is never loaded.
    const std::size_t shift = job < lane ? lane - job : 0;
    const VU iota = hn::Iota(du, 0);
    const MU fresh = hn::Not(hn::Gt(hn::Set(du, std::uint32_t(lane)), iota));
    const VI index = hn::BitCast(di, hn::Add(iota, hn::Set(du, std::uint32_t(job - lane))));
    const VI safe = hn::Max(index, hn::Zero(di));
    const auto floats = [&](const Floats& from, VF old) {
        const VF loaded =
            shift == 0 ? hn::LoadU(df, from + (job - lane)) : hn::GatherIndex(df, from + 0, safe);
        return hn::IfThenElse(hn::RebindMask(df, fresh), loaded, old);
    };
    StretchLanes& stretch = lanes.stretch;
    stretch.x0 = floats(jobs.x0, stretch.x0);
    stretch.y0 = floats(jobs.y0, stretch.y0);
    stretch.w0 = floats(jobs.w0, stretch.w0);
    stretch.dx = floats(jobs.dx, stretch.dx);
    stretch.dy = floats(jobs.dy, stretch.dy);
    stretch.dw = floats(jobs.dw, stretch.dw);
    const VU turn =
        shift == 0 ? hn::LoadU(du, jobs.turn + (job - lane)) : gather(jobs.turn + 0, hn::BitCast(du, safe));
    const VU side = hn::Sub(constants.turned_end, hn::Set(du, 1));
    const VU turn_x = bit_mask(turn, turn_flip_x);
    const VU turn_y = bit_mask(turn, turn_flip_y);
    const auto words = [&](VU loaded, VU old) { return hn::IfThenElse(fresh, loaded, old); };
    stretch.quadrant = words(hn::And(turn, hn::Set(du, turn_quadrant)), stretch.quadrant);
    stretch.flip_x = words(hn::And(turn_x, side), stretch.flip_x);
    stretch.flip_y = words(hn::And(turn_y, side), stretch.flip_y);
    const VF zero = hn::Zero(df);
    const VF tiny = hn::Set(df, 1e-20F);
    const VF one = hn::Set(df, 1.0F);
    const auto reciprocal = [&](VF change) {
        return hn::IfThenElseZero(hn::Gt(change, zero), hn::Div(one, hn::Max(change, tiny)));
    };
    lanes.per_x = hn::IfThenElse(hn::RebindMask(df, fresh), reciprocal(stretch.dx), lanes.per_x);
    lanes.per_y = hn::IfThenElse(hn::RebindMask(df, fresh), reciprocal(stretch.dy), lanes.per_y);
    const VU ends_x = hn::Or(hn::And(turn_x, constants.turned_end), hn::AndNot(turn_x, constants.end));
    const VU ends_y = hn::Or(hn::And(turn_y, constants.turned_end), hn::AndNot(turn_y, constants.end));
    lanes.end_x = words(ends_x, lanes.end_x);
    lanes.end_y = words(ends_y, lanes.end_y);
    const VU unit = hn::Set(du, 1);
    lanes.x = words(hn::Min(to_words(stretch.x0), hn::Sub(lanes.end_x, unit)), lanes.x);
    lanes.y = words(hn::Min(to_words(stretch.y0), hn::Sub(lanes.end_y, unit)), lanes.y);
    const VU unknown = bit_mask(turn, turn_unknown);
    lanes.unknown = words(unknown, lanes.unknown);
    lanes.level = words(hn::AndNot(unknown, constants.start), lanes.level);
    lanes.waits = words(unknown, lanes.waits);
    lanes.s = hn::IfThenElse(hn::RebindMask(df, fresh), zero, lanes.s);
    lanes.job = words(hn::BitCast(du, index), lanes.job);
}

HWY_INLINE WalkLanes compress(const WalkLanes& lanes, MU keep) {
    const MF keep_f = hn::RebindMask(df, keep);
    const auto f = [&](VF v) { return hn::Compress(v, keep_f); };
    const auto u = [&](VU v) { return hn::Compress(v, keep); };
    const StretchLanes& s = lanes.stretch;
    return {{f(s.x0), f(s.y0), f(s.w0), f(s.dx), f(s.dy), f(s.dw), u(s.quadrant), u(s.flip_x), u(s.flip_y)},
            f(lanes.per_x),
            f(lanes.per_y),
            u(lanes.end_x),
            u(lanes.end_y),
            u(lanes.x),
            u(lanes.y),
            u(lanes.level),
            f(lanes.s),
            u(lanes.job),
            u(lanes.waits),
            u(lanes.unknown)};
}

// Where a lane leaves its node.
struct ExitLanes {
    VU next_x, next_y;
    VF exit_x, exit_y, s1;
};

HWY_INLINE ExitLanes exits(const WalkLanes& lanes) {
    const VF zero = hn::Zero(df);
    const VF never = hn::Set(df, SPA_NEVER);
    const VU one = hn::Set(du, 1);
    ExitLanes e;
    e.next_x = hn::Shl(hn::Add(hn::Shr(lanes.x, lanes.level), one), lanes.level);
    e.next_y = hn::Shl(hn::Add(hn::Shr(lanes.y, lanes.level), one), lanes.level);
    const MF goes_x = hn::And(hn::Gt(lanes.per_x, zero), hn::RebindMask(df, hn::Lt(e.next_x, lanes.end_x)));
    const MF goes_y = hn::And(hn::Gt(lanes.per_y, zero), hn::RebindMask(df, hn::Lt(e.next_y, lanes.end_y)));
    e.exit_x =
        hn::IfThenElse(goes_x, hn::Mul(hn::Sub(to_floats(e.next_x), lanes.stretch.x0), lanes.per_x), never);
    e.exit_y =
        hn::IfThenElse(goes_y, hn::Mul(hn::Sub(to_floats(e.next_y), lanes.stretch.y0), lanes.per_y), never);
    e.s1 = hn::Max(hn::Min(hn::Min(e.exit_x, e.exit_y), hn::Set(df, 1.0F)), lanes.s);
    return e;
}

// Moves the lanes of `mask` on to the next node.
HWY_INLINE void advance(const WalkConstants& constants, const ExitLanes& e, MU mask, WalkLanes& lanes) {
    const VF zero = hn::Zero(df);
    const VU one = hn::Set(du, 1);
    const MU by_x = hn::RebindMask(du, hn::Le(e.exit_x, e.exit_y));
    const StretchLanes& stretch = lanes.stretch;
    const VU at_x = to_words(hn::Max(hn::Add(stretch.x0, hn::Mul(e.s1, stretch.dx)), zero));
    const VU at_y = to_words(hn::Max(hn::Add(stretch.y0, hn::Mul(e.s1, stretch.dy)), zero));
    VU x = hn::IfThenElse(by_x, e.next_x, hn::Max(lanes.x, hn::Min(at_x, hn::Sub(e.next_x, one))));
    VU y = hn::IfThenElse(by_x, hn::Max(lanes.y, hn::Min(at_y, hn::Sub(e.next_y, one))), e.next_y);
    const VU moved = hn::IfThenElse(by_x, x, y);
    const MU climbs = hn::Eq(hn::And(hn::Shr(moved, lanes.level), one), hn::Zero(du));
    const VU level = hn::IfThenElse(climbs, hn::Min(hn::Add(lanes.level, one), constants.top), lanes.level);
    x = hn::Min(x, hn::Sub(lanes.end_x, one));
    y = hn::Min(y, hn::Sub(lanes.end_y, one));
    lanes.x = hn::IfThenElse(mask, x, lanes.x);
    lanes.y = hn::IfThenElse(mask, y, lanes.y);
    lanes.level = hn::IfThenElse(mask, level, lanes.level);
    lanes.s = hn::IfThenElse(hn::RebindMask(df, mask), e.s1, lanes.s);
}

// Whether anything in the node may be solid for the piece of the ray over it (spa_meets).
template <bool with_inner>
HWY_INLINE MU meets(const WalkConstants& constants, const WalkLanes& lanes, VF s1) {
    const StretchLanes& stretch = lanes.stretch;
    const VU bits = hn::Sub(constants.levels, lanes.level);
    const VU twice = hn::Add(bits, bits);
    const VU one = hn::Set(du, 1);
    const VU before =
        hn::And(hn::Set(du, 0x55555554), hn::Sub(hn::Shl(hn::Set(du, 2), hn::Add(twice, one)), one));
    const VU row = hn::Shr(hn::Xor(lanes.y, stretch.flip_y), lanes.level);
    const VU column = hn::Shr(hn::Xor(lanes.x, stretch.flip_x), lanes.level);
    const VU node =
        hn::Add(before, hn::Add(hn::Shl(hn::Add(hn::Shl(stretch.quadrant, bits), row), bits), column));
    const VF wa = hn::Min(hn::Add(stretch.w0, hn::Mul(lanes.s, stretch.dw)), constants.w_max);
    const VF wb = hn::Min(hn::Add(stretch.w0, hn::Mul(s1, stretch.dw)), constants.w_max);
    const VF high = hn::Max(wa, wb);
    const VU low_bits = hn::Set(du, 0xFFFF);
    const auto decode = [&](VU code) {
        return hn::BitCast(df, hn::Add(constants.code_base, hn::ShiftLeftSame(code, constants.code_shift)));
    };
    if constexpr (!with_inner) {
        // What is solid reaches the centre.
        const VU range = gather(constants.nodes, node);
        return hn::RebindMask(du, hn::Ge(high, decode(hn::And(range, low_bits))));
    } else {
        const VF low = hn::Min(wa, wb);
        const VU place = hn::Add(node, node);
        const VU first = gather(constants.nodes, place);
        const VU second = gather(constants.nodes + 1, place);
        const auto in = [&](VU range) {
            return hn::And(hn::Ge(high, decode(hn::And(range, low_bits))),
                           hn::Le(low, decode(hn::ShiftRight<16>(range))));
        };
        return hn::RebindMask(du, hn::Or(in(first), in(second)));
    }
}

HWY_INLINE MU mask_of(VU words) { return hn::MaskFromVec(words); }

// A cell with a mixed triangle, by the text.
inline Found cross_mixed(const shader::SpaMap& map, const StretchBlock& jobs, std::size_t job,
                         std::uint32_t x, std::uint32_t y, float s0, float s1, bool unknown) {
    shader::SpaEvent event{};
    shader::SpaPiece piece{};
    shader::SpaTriangle tri{};
    shader::uint state = unknown ? SPA_UNKNOWN : SPA_OUTSIDE;
    const bool any =
        shader::spa_cross_cell(map, load_stretch(map, jobs, job), x, y, s0, s1, 0, state, event, piece, tri);
    if (any) return event.front ? Found::event : Found::unusual;
    return state == SPA_INSIDE ? Found::unusual : Found::nothing;
}

// Walks all jobs of the block and writes down what they found.
template <bool with_inner>
void walk(const shader::SpaMap& map, const StretchBlock& jobs, ResultBlock& results) {
    const WalkConstants constants = walk_constants(map);
    const std::size_t lane_count = hn::Lanes(du);
    const std::size_t enough_waiting = (lane_count * 3 + 7) / 8;
    const std::size_t enough_free = (lane_count + 3) / 4;
    const std::uint32_t* const cell_lists = map.cells == 0 ? nullptr : map.words.first + map.cells;
    WalkLanes lanes{};
    std::size_t alive_count = 0;
    std::size_t next = 0;
    MU alive = no_word_lanes();
    for (;;) {
        if (next < jobs.count && lane_count - alive_count >= enough_free) {
            lanes = compress(lanes, alive);
            fill(constants, jobs, next, alive_count, lanes);
            const std::size_t more = std::min(lane_count - alive_count, jobs.count - next);
            next += more;
            alive_count += more;
            alive = hn::FirstN(du, alive_count);
        }
        if (alive_count == 0) break;
        const ExitLanes e = exits(lanes);
        MU waits = hn::And(alive, mask_of(lanes.waits));
        const MU steps = hn::AndNot(waits, alive);
        const MU met = meets<with_inner>(constants, lanes, e.s1);
        const MU at_cells = hn::Eq(lanes.level, hn::Zero(du));
        waits = hn::Or(waits, hn::And(steps, hn::And(met, at_cells)));
        const MU down = hn::AndNot(at_cells, hn::And(steps, met));
        MU on = hn::AndNot(met, steps);
        lanes.level = hn::IfThenElse(down, hn::Sub(lanes.level, hn::Set(du, 1)), lanes.level);
        const std::size_t waiting = hn::CountTrue(du, waits);
        if (waiting >= enough_waiting || (waiting > 0 && waiting == alive_count) ||
            (waiting > 0 && hn::AllFalse(du, steps))) {
            const CellLanes cell{lanes.x, lanes.y, lanes.s, e.s1};
            MU pure = waits;
            MU unusual = no_word_lanes();
            MU event = no_word_lanes();
            if (cell_lists != nullptr) {
                const VU quadrant =
                    hn::Shl(lanes.stretch.quadrant, hn::Add(constants.levels, constants.levels));
                const VU row = hn::Shl(hn::Xor(lanes.y, lanes.stretch.flip_y), constants.levels);
                const VU column = hn::Xor(lanes.x, lanes.stretch.flip_x);
                const VU place = hn::IfThenElseZero(waits, hn::Add(quadrant, hn::Add(row, column)));
                const MU mixed = hn::And(waits, hn::Ne(gather(cell_lists, place), hn::Zero(du)));
                if (!hn::AllFalse(du, mixed)) {
                    pure = hn::AndNot(mixed, waits);
                    HWY_ALIGN std::uint32_t kinds[hn::MaxLanes(du)] = {}, lane_x[hn::MaxLanes(du)],
                                            lane_y[hn::MaxLanes(du)], lane_job[hn::MaxLanes(du)],
                                            is_mixed[hn::MaxLanes(du)], is_unknown[hn::MaxLanes(du)];
                    HWY_ALIGN float from[hn::MaxLanes(df)], to[hn::MaxLanes(df)];
                    hn::Store(lanes.x, du, lane_x);
                    hn::Store(lanes.y, du, lane_y);
                    hn::Store(lanes.job, du, lane_job);
                    hn::Store(hn::VecFromMask(du, mixed), du, is_mixed);
                    hn::Store(lanes.unknown, du, is_unknown);
                    hn::Store(lanes.s, df, from);
                    hn::Store(e.s1, df, to);
                    for (std::size_t i = 0; i < lane_count; ++i)
                        if (is_mixed[i] != 0)
                            kinds[i] = std::uint32_t(cross_mixed(map, jobs, lane_job[i], lane_x[i], lane_y[i],
                                                                 from[i], to[i], is_unknown[i] != 0));
                    const VU kind = hn::Load(du, kinds);
                    event = hn::Eq(kind, hn::Set(du, std::uint32_t(Found::event)));
                    unusual = hn::Eq(kind, hn::Set(du, std::uint32_t(Found::unusual)));
                }
            }
            MU surface = no_word_lanes();
            if (!hn::AllFalse(du, pure)) {
                const CrossLanes cross = cross_cells<with_inner>(map, lanes.stretch, cell);
                const MU inside = hn::And(mask_of(lanes.unknown), hn::RebindMask(du, cross.starts_inside));
                unusual = hn::Or(unusual, hn::And(pure, inside));
                surface = hn::AndNot(inside, hn::And(pure, hn::RebindMask(du, cross.any)));
            }
            const MU found = hn::Or(surface, hn::Or(event, unusual));
            if (!hn::AllFalse(du, found)) {
                VU kind = hn::IfThenElseZero(surface, hn::Set(du, std::uint32_t(Found::surface)));
                kind = hn::IfThenElse(event, hn::Set(du, std::uint32_t(Found::event)), kind);
                kind = hn::IfThenElse(unusual, hn::Set(du, std::uint32_t(Found::unusual)), kind);
                // Lanes that found nothing write past the last job.
                const VI at =
                    hn::BitCast(di, hn::IfThenElse(found, lanes.job, hn::Set(du, std::uint32_t(block_rays))));
                hn::ScatterIndex(kind, du, results.found + 0, at);
                hn::ScatterIndex(lanes.x, du, results.x + 0, at);
                hn::ScatterIndex(lanes.y, du, results.y + 0, at);
                hn::ScatterIndex(lanes.s, df, results.s0 + 0, at);
                hn::ScatterIndex(e.s1, df, results.s1 + 0, at);
                alive = hn::AndNot(found, alive);
            }
            on = hn::Or(on, hn::AndNot(found, waits));
            lanes.unknown = hn::IfThenZeroElse(waits, lanes.unknown);
            waits = no_word_lanes();
        }
        lanes.waits = hn::VecFromMask(du, waits);
        const MU ended = hn::And(on, hn::RebindMask(du, hn::Ge(e.s1, hn::Set(df, 1.0F))));
        alive = hn::AndNot(ended, alive);
        alive_count = hn::CountTrue(du, alive);
        advance(constants, e, hn::AndNot(ended, on), lanes);
    }
}

} // namespace spa::trace::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
