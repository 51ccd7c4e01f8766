// SPDX-License-Identifier: Apache-2.0
#include "fold_maps.h"

#include "judge_samples.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

namespace spa::test {
namespace {

using Generator = std::mt19937_64;

std::uint32_t below(Generator& random, std::size_t count) {
    return std::uniform_int_distribution<std::uint32_t>(0, std::uint32_t(count) - 1)(random);
}
bool chance(Generator& random, double share) {
    return std::uniform_real_distribution<double>(0, 1)(random) < share;
}

std::uint16_t code(double depth) { return std::uint16_t(std::clamp(std::lround(depth * 65535), 1L, 65535L)); }

void each_edge(std::uint32_t cells,
               const std::function<void(std::uint32_t, const std::array<TexelIndex, 2>&)>& visit) {
    for (std::uint32_t edge = 0; edge < edge_count(cells); ++edge)
        if (is_edge(cells, edge)) visit(edge, edge_ends(cells, edge));
}

// A crossing: how deep, and whether it is an outer end.
struct End {
    double depth = 0;
    bool outer = false;
};

std::vector<End> ends_of(const StoredSamples& samples, TexelIndex at) {
    std::vector<End> ends;
    const double size = length(samples.direction(at));
    for (const StoredInterval& interval : samples.intervals(at)) {
        ends.push_back({size / interval.outer, true});
        if (interval.inner > 0) ends.push_back({size / interval.inner, false});
    }
    return ends;
}

bool match(const std::vector<End>& a, const std::vector<End>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const End& x, const End& y) { return x.outer == y.outer; });
}

FoldRecord anything(Generator& random, FoldRecord record) {
    switch (below(random, 6)) {
    case 0: record.index = std::uint8_t(below(random, fold_indices)); break;
    case 1: record.end ^= 1U; break;
    case 2: record.cut[below(random, 2)] = 0; break;
    case 3: record.pair = !record.pair; break;
    case 4: record.cut = {std::uint16_t(below(random, 65536)), std::uint16_t(below(random, 65536))}; break;
    default: record.index ^= 1U;
    }
    return record;
}

// A solid whose intervals depend on the sign of functions of the direction: between samples of different
// signs, surfaces end where the functions, linear there, are 0.
using Sign = std::function<double(Vec3d g)>;

std::uint8_t zero_between(double here, double there) {
    const double f = here / (here - there);
    return std::uint8_t(std::clamp(std::lround(f * 256) - 1, 0L, 255L));
}

// What ends between a sample where `sign` is above 0 and one where it is not.
struct Ending {
    Sign sign;
    bool pair = true;
    std::uint8_t index = 0;
    std::array<double, 2> depths{};
    int place = -1; // of 256; below 0: where the sign is 0
};

// Endings of one edge are recorded in their order.
OwnedPart with_endings(const MadePart& made, const MakeIntervals& intervals,
                       const std::vector<Ending>& endings) {
    OwnedPart owned = make_part(made, intervals);
    const StoredSamples samples(owned.part, 0);
    std::vector<FoldRecord> records;
    each_edge(made.cells, [&](std::uint32_t edge, const std::array<TexelIndex, 2>& at) {
        for (const Ending& ending : endings) {
            const double sign[2] = {ending.sign(samples.direction(at[0])),
                                    ending.sign(samples.direction(at[1]))};
            if ((sign[0] > 0) == (sign[1] > 0)) continue;
            const std::uint8_t end = sign[0] > 0 ? 0 : 1;
            FoldRecord record{edge, ending.pair, end, ending.index};
            record.place =
                ending.place < 0 ? zero_between(sign[end], sign[1U - end]) : std::uint8_t(ending.place);
            record.cut = {code(ending.depths[0]), ending.pair ? code(ending.depths[1]) : std::uint16_t(0)};
            records.push_back(record);
        }
    });
    set_folds(owned, std::move(records));
    return owned;
}

MadeInterval interval(double outer, double inner, Vec3d g) {
    const Vec3d u = normalize(g);
    return {outer, inner, u, u * -1.0};
}

double slanted(Vec3d g) { return g.x + 0.3 * g.y + 0.45 * g.z - 0.21; }
double upright(Vec3d g) { return g.y - 0.2 * g.x + 0.1; }
double round_about(Vec3d g) { return 0.62 - std::abs(g.x - 0.2) - std::abs(g.y + 0.1); }

// A shell in front of a ball: where the shell ends its outer and inner end run into each other.
OwnedPart silhouette(const MadePart& made, const Sign& sign, int place = -1) {
    return with_endings(made,
                        [&](Vec3d g) {
                            std::vector<MadeInterval> found;
                            if (sign(g) > 0) found.push_back(interval(0.85, 0.65, g));
                            found.push_back(interval(0.4, 0, g));
                            return found;
                        },
                        {{sign, true, 0, {0.76, 0.74}, place}});
}

// Two shells, each with an end of its own.
OwnedPart two_shells(const MadePart& made, const Sign& first, const Sign& second) {
    const auto count = [&](Vec3d g) { return (first(g) > 0 ? 1 : 0) + (second(g) > 0 ? 1 : 0); };
    OwnedPart owned = make_part(made, [&](Vec3d g) {
        std::vector<MadeInterval> found;
        if (first(g) > 0) found.push_back(interval(0.95, 0.8, g));
        if (second(g) > 0) found.push_back(interval(0.7, 0.55, g));
        if (count(g) < 3) found.push_back(interval(0.4, 0, g));
        return found;
    });
    const StoredSamples samples(owned.part, 0);
    std::vector<FoldRecord> records;
    each_edge(made.cells, [&](std::uint32_t edge, const std::array<TexelIndex, 2>& at) {
        // The second shell first: it stands behind the first at the same end.
        for (const bool outermost : {false, true}) {
            const Sign& sign = outermost ? first : second;
            const Vec3d g[2] = {samples.direction(at[0]), samples.direction(at[1])};
            const double values[2] = {sign(g[0]), sign(g[1])};
            if ((values[0] > 0) == (values[1] > 0)) continue;
            const std::uint8_t end = values[0] > 0 ? 0 : 1;
            const std::uint8_t index = !outermost && first(g[end]) > 0 ? 2 : 0;
            const double depth = outermost ? 0.87 : 0.62;
            records.push_back({edge,
                               true,
                               end,
                               index,
                               zero_between(values[end], values[1U - end]),
                               {code(depth + 0.01), code(depth)}});
        }
    });
    set_folds(owned, std::move(records));
    return owned;
}

// Records that make no sense, one kind in each part.
std::vector<NamedPart> nonsense_parts() {
    const MadePart made{.cells = 6, .layers = 2, .depth = ElementFormat::u16};
    const std::vector<std::pair<const char*, std::function<void(FoldRecord&)>>> kinds{
        {"index", [](FoldRecord& r) { r.index = 5; }},
        {"sides", [](FoldRecord& r) { r.index = 1; }},
        {"other end", [](FoldRecord& r) { r.end ^= 1U; }},
        {"no code", [](FoldRecord& r) { r.cut[1] = 0; }},
        {"rest", [](FoldRecord& r) { r.pair = false; }}};
    std::vector<NamedPart> parts;
    for (const auto& [name, change] : kinds) {
        OwnedPart owned = silhouette(made, slanted);
        std::vector<FoldRecord> records = decode_folds(owned.part.folds);
        for (FoldRecord& record : records) change(record);
        set_folds(owned, std::move(records));
        parts.push_back({std::string("folds, nonsense: ") + name, std::move(owned)});
    }
    return parts;
}

} // namespace

void set_folds(OwnedPart& owned, std::vector<FoldRecord> records) {
    std::stable_sort(records.begin(), records.end(),
                     [](const FoldRecord& a, const FoldRecord& b) { return a.edge < b.edge; });
    const std::vector<std::byte> bytes = encode_folds(records);
    owned.pixels.push_back(std::make_unique<std::byte[]>(bytes.size()));
    std::copy(bytes.begin(), bytes.end(), owned.pixels.back().get());
    owned.part.folds = {owned.pixels.back().get(), bytes.size()};
}

void add_random_folds(OwnedPart& owned, double nonsense, std::uint32_t seed) {
    Generator random(seed);
    const StoredSamples samples(owned.part, 0);
    std::vector<FoldRecord> records;
    each_edge(samples.cells(), [&](std::uint32_t edge, const std::array<TexelIndex, 2>& at) {
        std::array<std::vector<End>, 2> left{ends_of(samples, at[0]), ends_of(samples, at[1])};
        bool more = chance(random, 0.15); // a record that is not needed
        while (!match(left[0], left[1]) || more) {
            const std::uint8_t end = left[0].size() != left[1].size()
                                         ? (left[0].size() < left[1].size() ? 1 : 0)
                                         : std::uint8_t(below(random, 2));
            std::vector<End>& here = left[end];
            if (here.empty()) break;
            more = false;
            const std::uint32_t index = below(random, here.size());
            const bool pair =
                index + 1 < here.size() && here[index].outer != here[index + 1].outer && chance(random, 0.8);
            const std::uint32_t place = chance(random, 0.2)   ? 255
                                        : chance(random, 0.3) ? 127
                                                              : below(random, 256);
            const double depth = here[index].depth;
            const double inner = pair ? here[index + 1].depth : depth;
            const double middle = (depth + inner) / 2;
            FoldRecord record{edge, pair, end, std::uint8_t(index), std::uint8_t(place)};
            record.cut[0] = code(depth + (middle - depth) * 0.9);
            if (pair) record.cut[1] = code(inner + (middle - inner) * 0.9);
            const auto from = here.begin() + index;
            here.erase(from, from + (pair ? 2 : 1));
            records.push_back(chance(random, nonsense) ? anything(random, record) : record);
        }
    });
    set_folds(owned, std::move(records));
}

std::vector<NamedPart> made_fold_parts() {
    const MadePart one{.cells = 8, .layers = 1};
    const MadePart two{.cells = 8, .layers = 2};
    const MadePart three{.cells = 6, .layers = 3};
    MadePart open = one;
    open.center_inside = true;
    std::vector<NamedPart> parts;
    parts.push_back({"folds, silhouette", silhouette(two, slanted)});
    parts.push_back({"folds, silhouette at 255", silhouette(two, slanted, 255)});
    parts.push_back({"folds, silhouette at 0", silhouette(two, round_about, 0)});
    parts.push_back({"folds, lines that meet", two_shells(three, slanted, upright)});
    parts.push_back({"folds, lines at one place", two_shells(three, slanted, slanted)});
    parts.push_back(
        {"folds, two lines", two_shells(three, slanted, [](Vec3d g) { return slanted(g) - 0.07; })});
    parts.push_back({"folds, gap that closes",
                     with_endings(two,
                                  [](Vec3d g) {
                                      if (slanted(g) <= 0) return std::vector{interval(0.8, 0, g)};
                                      return std::vector{interval(0.85, 0.7, g), interval(0.4, 0, g)};
                                  },
                                  {{slanted, true, 1, {0.56, 0.54}}})});
    const MakeIntervals bowl = [](Vec3d g) {
        if (round_about(g) <= 0) return std::vector<MadeInterval>{};
        return std::vector{interval(0.8, 0, g)};
    };
    parts.push_back({"folds, border", with_endings(one, bowl, {{round_about, false, 0, {0.75, 0}}})});
    parts.push_back({"folds, open border", with_endings(open, bowl, {{round_about, false, 0, {0.75, 0}}})});
    parts.push_back(
        {"folds, open border at 255", with_endings(open, bowl, {{round_about, false, 0, {0.75, 0}, 255}})});
    parts.push_back(
        {"folds, inner end alone",
         with_endings(one, [](Vec3d g) { return std::vector{interval(0.8, slanted(g) > 0 ? 0.5 : 0, g)}; },
                      {{slanted, false, 1, {0.3, 0}}})});
    // A shell with a gap in it, whose pairs are one within the other; the gap may end earlier.
    for (const double earlier : {0.0, 0.06}) {
        const Sign gap = [earlier](Vec3d g) { return slanted(g) - earlier; };
        parts.push_back({earlier > 0 ? "folds, nested, apart" : "folds, nested",
                         with_endings(three,
                                      [&](Vec3d g) {
                                          if (slanted(g) <= 0) return std::vector<MadeInterval>{};
                                          if (gap(g) <= 0) return std::vector{interval(0.9, 0.4, g)};
                                          return std::vector{interval(0.9, 0.72, g), interval(0.58, 0.4, g)};
                                      },
                                      {{gap, true, 1, {0.66, 0.64}}, {slanted, true, 0, {0.7, 0.6}}})});
    }
    // Ends at the same place everywhere: a shell of no thickness, and one that lies on the ball behind it.
    for (const bool thick : {false, true}) {
        const double inner = thick ? 0.5 : 0.8;
        parts.push_back({thick ? "folds, touching" : "folds, no thickness",
                         with_endings(two,
                                      [&](Vec3d g) {
                                          std::vector<MadeInterval> found;
                                          if (slanted(g) > 0) found.push_back(interval(0.8, inner, g));
                                          found.push_back(interval(0.5, 0, g));
                                          return found;
                                      },
                                      {{slanted, true, 0, {0.8, inner}}})});
    }
    for (NamedPart& part : nonsense_parts()) parts.push_back(std::move(part));
    return parts;
}

// Of a solid with shells, each end of which has depths of its own, some samples lack neighbouring ends: two
// that would run into each other, or the last one, which is a border. Which, and where between the samples
// they end, is at random; an end that both samples have is the same surface.
OwnedPart random_shells(const MadePart& made, double alone) {
    Generator random(made.seed);
    const std::size_t ends = 2 * std::size_t(made.layers) - 1; // the last interval reaches the centre
    const auto depth = [&](std::size_t end) {
        const double step = 0.8 / double(ends);
        return 0.95 - step * (double(end) + std::uniform_real_distribution<double>(0.2, 0.8)(random));
    };
    const auto which = [&](double at) { return std::size_t((0.95 - at) / (0.8 / double(ends))); };
    OwnedPart owned = make_part(made, [&](Vec3d g) {
        std::vector<std::size_t> left(ends);
        for (std::size_t i = 0; i < ends; ++i) left[i] = i;
        for (int i = 0; i < 2 && left.size() > 1; ++i) {
            if (!chance(random, 0.4)) continue;
            const auto first = left.begin() + below(random, left.size() - 1);
            left.erase(first, first + 2);
        }
        if (left.size() == 1 && chance(random, 0.3)) left.clear();
        std::vector<MadeInterval> found;
        for (std::size_t i = 0; i < left.size(); i += 2)
            found.push_back(interval(depth(left[i]), i + 1 < left.size() ? depth(left[i + 1]) : 0, g));
        return found;
    });
    const StoredSamples samples(owned.part, 0);
    std::vector<FoldRecord> records;
    each_edge(made.cells, [&](std::uint32_t edge, const std::array<TexelIndex, 2>& at) {
        std::array<std::vector<std::size_t>, 2> left;
        for (std::size_t i = 0; i < 2; ++i)
            for (const End& end : ends_of(samples, at[i])) left[i].push_back(which(end.depth));
        const auto lonely = [&](std::size_t i, std::size_t k) {
            return k < left[i].size() &&
                   std::find(left[1 - i].begin(), left[1 - i].end(), left[i][k]) == left[1 - i].end();
        };
        const std::uint32_t usual = below(random, 256);
        for (std::size_t i = 0; i < 2; ++i) {
            for (std::size_t k = left[i].size(); k-- > 0;) {
                if (!lonely(i, k)) continue;
                // The innermost of those that may be a pair, from behind.
                const bool pair = k > 0 && lonely(i, k - 1) && (left[i][k] + left[i][k - 1]) % 2 == 1 &&
                                  !chance(random, alone);
                if (pair) --k;
                FoldRecord record{edge, pair, std::uint8_t(i), std::uint8_t(k)};
                record.place = std::uint8_t(chance(random, 0.1)   ? 255
                                            : chance(random, 0.5) ? usual
                                                                  : below(random, 256));
                record.cut[0] = code(depth(left[i][k]));
                if (pair) record.cut[1] = code(depth(left[i][k + 1]));
                left[i].erase(left[i].begin() + std::ptrdiff_t(k),
                              left[i].begin() + std::ptrdiff_t(k + (pair ? 2 : 1)));
                records.push_back(record);
            }
        }
    });
    set_folds(owned, std::move(records));
    return owned;
}

std::vector<NamedPart> random_fold_parts() {
    using enum ElementFormat;
    std::vector<NamedPart> parts;
    const auto add = [&](const char* name, const MadePart& made, double nonsense) {
        OwnedPart owned = random_part(made);
        add_random_folds(owned, nonsense, made.seed);
        parts.push_back({name, std::move(owned)});
    };
    parts.push_back({"random shells 8, 2 layers",
                     random_shells({.cells = 8, .layers = 2, .center_inside = true, .seed = 31}, 0)});
    parts.push_back({"random shells 10, 3 layers", random_shells({.cells = 10, .layers = 3, .seed = 32}, 0)});
    parts.push_back({"random shells 6, 4 layers",
                     random_shells({.cells = 6, .layers = 4, .mixed_share = 0.3, .seed = 33}, 0.1)});
    add("random folds 2, 2 layers", {.cells = 2, .layers = 2, .seed = 21}, 0);
    add("random folds 6, 1 layer", {.cells = 6, .mixed_share = 0.2, .center_inside = true, .seed = 22}, 0);
    add("random folds 12, 2 layers",
        {.cells = 12, .layers = 2, .depth = u16, .mixed_share = 0.2, .center_inside = true, .seed = 23}, 0);
    add("random folds 10, 3 layers", {.cells = 10, .layers = 3, .mixed_share = 0.3, .seed = 24}, 0.02);
    add("random folds 6, nonsense", {.cells = 6, .layers = 2, .center_inside = true, .seed = 25}, 0.2);
    return parts;
}

} // namespace spa::test
