// SPDX-License-Identifier: Apache-2.0
#include "judge_folds.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace spa::test {
namespace {

// Barycentric coordinates as whole numbers, up to a common factor; also the coefficients of a line.
// Those of places add up to 256; of lines they stay below 2^17, of points where lines meet below 2^34.
using Whole = std::array<std::int64_t, 3>;

Whole cross(const Whole& a, const Whole& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
std::int64_t dot(const Whole& a, const Whole& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Whole negative(const Whole& a) { return {-a[0], -a[1], -a[2]}; }
// Without a common factor.
Whole reduced(const Whole& a) {
    const std::int64_t factor = std::gcd(a[0], std::gcd(a[1], a[2]));
    return {a[0] / factor, a[1] / factor, a[2] / factor};
}
Vec3d to_vector(const Whole& a) { return {double(a[0]), double(a[1]), double(a[2])}; }
// As coordinates that add up to 1.
Vec3d as_point(const Whole& a) { return to_vector(a) * (1 / double(a[0] + a[1] + a[2])); }

constexpr std::size_t edges = 3; // sides that are no lines

struct Cut {
    Whole place{};
    double w = 0;
    bool single = false;
};

struct Crossing {
    double w = 0;
    bool outer = false;
    std::size_t layer = 0;
    std::array<std::optional<Cut>, 3> cuts;          // towards each corner
    std::array<std::optional<std::size_t>, 3> match; // the crossing of each other corner
    bool in_sheet = false;
};
using Corners = std::array<std::vector<Crossing>, 3>;

struct Sheet {
    std::array<std::optional<std::size_t>, 3> crossing; // of each corner
    bool outer = false;
    std::size_t layer = 0;         // of its crossing at the first corner that has one
    Vec3d w;                       // at the three corners of its plane, wherever the sheet is
    double least = 0;              // of the W that the plane goes through
    std::optional<Whole> line;     // reduced; above 0 on the side of the sheet
    std::optional<std::size_t> at; // that line, among all
    bool single = false;           // cut by single records on both edges
};

std::vector<Crossing> crossings(const std::vector<StoredInterval>& intervals) {
    std::vector<Crossing> found;
    for (std::size_t k = 0; k < intervals.size(); ++k) {
        found.push_back({.w = intervals[k].outer, .outer = true, .layer = k, .cuts = {}, .match = {}});
        if (intervals[k].inner > 0)
            found.push_back({.w = intervals[k].inner, .layer = k, .cuts = {}, .match = {}});
    }
    return found;
}

// Step 2 of one edge, and the cuts of its records.
bool match_edge(const FoldTriangle& triangle, const FoldTriangle::Edge& edge, Corners& corners) {
    std::array<std::vector<std::size_t>, 2> left;
    for (unsigned end = 0; end < 2; ++end)
        for (std::size_t k = 0; k < corners[edge.corner[end]].size(); ++k) left[end].push_back(k);
    for (const FoldRecord& record : edge.records) {
        const unsigned i = edge.corner[record.end];
        const unsigned j = edge.corner[1U - record.end];
        std::vector<std::size_t>& here = left[record.end];
        const std::size_t count = record.pair ? 2 : 1;
        if (record.index + count > here.size()) return false;
        const auto crossing = [&](std::size_t k) -> Crossing& { return corners[i][here[record.index + k]]; };
        if (record.pair && crossing(0).outer == crossing(1).outer) return false;
        const int steps = record.place + 1;
        const double f = steps / 256.0;
        const Vec3d g = triangle.directions[i] * (1 - f) + triangle.directions[j] * f;
        for (std::size_t k = 0; k < count; ++k) {
            if (record.cut[k] == 0) return false;
            Cut cut{{}, length(g) * 65535 / record.cut[k], !record.pair};
            cut.place[i] = 256 - steps;
            cut.place[j] = steps;
            crossing(k).cuts[j] = cut;
        }
        here.erase(here.begin() + record.index, here.begin() + record.index + std::ptrdiff_t(count));
    }
    if (left[0].size() != left[1].size()) return false;
    for (std::size_t k = 0; k < left[0].size(); ++k) {
        Crossing& a = corners[edge.corner[0]][left[0][k]];
        Crossing& b = corners[edge.corner[1]][left[1][k]];
        if (a.outer != b.outer) return false;
        a.match[edge.corner[1]] = left[1][k];
        b.match[edge.corner[0]] = left[0][k];
    }
    return true;
}

// What a crossing matches, and what that matches, and so on.
bool follow(Corners& corners, unsigned i, std::size_t k, Sheet& sheet) {
    if (sheet.crossing[i].has_value()) return *sheet.crossing[i] == k;
    sheet.crossing[i] = k;
    Crossing& crossing = corners[i][k];
    crossing.in_sheet = true;
    for (unsigned j = 0; j < 3; ++j)
        if (crossing.match[j].has_value() && !follow(corners, j, *crossing.match[j], sheet)) return false;
    return true;
}

// The plane that has these values at these points.
Vec3d plane_through(const std::array<Vec3d, 3>& points, const std::array<double, 3>& w) {
    const Barycentric share(points[0], points[1], points[2]);
    return share.form[0] * w[0] + share.form[1] * w[1] + share.form[2] * w[2];
}

// Steps 3 to 5 of one sheet.
bool finish(const Corners& corners, Sheet& sheet) {
    std::vector<Cut> cuts;
    std::vector<Vec3d> points;
    std::vector<double> w;
    for (unsigned i = 0; i < 3; ++i) {
        if (!sheet.crossing[i].has_value()) continue;
        const Crossing& crossing = corners[i][*sheet.crossing[i]];
        if (points.empty()) sheet.layer = crossing.layer;
        sheet.outer = crossing.outer;
        Whole corner{};
        corner[i] = 1;
        points.push_back(to_vector(corner));
        w.push_back(crossing.w);
        for (unsigned j = 0; j < 3; ++j) {
            if (!crossing.cuts[j].has_value()) continue;
            if (sheet.crossing[j].has_value()) return false;
            cuts.push_back(*crossing.cuts[j]);
        }
    }
    if (cuts.size() != (points.size() == 3 ? 0U : 2U)) return false;
    if (points.size() == 1) {
        for (const Cut& cut : cuts) {
            points.push_back(as_point(cut.place));
            w.push_back(cut.w);
        }
    } else if (points.size() == 2) {
        points.push_back((as_point(cuts[0].place) + as_point(cuts[1].place)) * 0.5);
        w.push_back((cuts[0].w + cuts[1].w) / 2);
    }
    sheet.w = plane_through({points[0], points[1], points[2]}, {w[0], w[1], w[2]});
    sheet.least = std::min({w[0], w[1], w[2]});
    if (cuts.empty() || cuts[0].place == cuts[1].place) return true;
    Whole line = reduced(cross(cuts[0].place, cuts[1].place));
    std::int64_t side = 0; // a corner may be on the line, but not all of the sheet's
    for (unsigned i = 0; i < 3; ++i)
        if (sheet.crossing[i].has_value()) side += line[i];
    if (side < 0) line = negative(line);
    sheet.line = line;
    sheet.single = cuts[0].single && cuts[1].single;
    return true;
}

std::optional<std::vector<Sheet>> find_sheets(const FoldTriangle& triangle) {
    Corners corners;
    for (unsigned i = 0; i < 3; ++i) corners[i] = crossings(triangle.intervals[i]);
    for (const FoldTriangle::Edge& edge : triangle.edges)
        if (!match_edge(triangle, edge, corners)) return std::nullopt;
    std::vector<Sheet> sheets;
    for (unsigned i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < corners[i].size(); ++k) {
            if (corners[i][k].in_sheet) continue;
            Sheet sheet;
            if (!follow(corners, i, k, sheet) || !finish(corners, sheet)) return std::nullopt;
            sheets.push_back(sheet);
        }
    }
    return sheets;
}

// The edges of the triangle, and after them the lines: those that are no edge, each once.
std::optional<std::vector<Whole>> find_lines(std::vector<Sheet>& sheets) {
    std::vector<Whole> lines{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    std::vector<Whole> different;
    for (Sheet& sheet : sheets) {
        if (!sheet.line.has_value()) continue;
        const auto same = [&](const Whole& line) {
            return line == *sheet.line || line == negative(*sheet.line);
        };
        if (std::none_of(different.begin(), different.end(), same)) different.push_back(*sheet.line);
        const auto found = std::find_if(lines.begin(), lines.end(), same);
        sheet.at = std::size_t(found - lines.begin());
        if (found == lines.end()) lines.push_back(*sheet.line);
    }
    if (different.size() > most_fold_lines) return std::nullopt;
    return lines;
}

// The corners of where all of these are at least 0; none unless it has an inside.
std::vector<Whole> corners_of(const std::vector<Whole>& sides) {
    std::vector<Whole> corners;
    for (std::size_t a = 0; a < sides.size(); ++a) {
        for (std::size_t b = a + 1; b < sides.size(); ++b) {
            Whole point = cross(sides[a], sides[b]);
            const std::int64_t sum = point[0] + point[1] + point[2];
            if (sum == 0) continue; // parallel
            point = reduced(sum < 0 ? negative(point) : point);
            const auto inside = [&](const Whole& side) { return dot(side, point) >= 0; };
            if (std::all_of(sides.begin(), sides.end(), inside) &&
                std::find(corners.begin(), corners.end(), point) == corners.end())
                corners.push_back(point);
        }
    }
    const auto has_inside = [&](const Whole& side) {
        return std::any_of(corners.begin(), corners.end(),
                           [&](const Whole& corner) { return dot(side, corner) > 0; });
    };
    return std::all_of(sides.begin(), sides.end(), has_inside) ? corners : std::vector<Whole>{};
}

// Step 6 of one region.
bool find_intervals(const std::vector<Sheet>& sheets, const std::vector<Whole>& sides,
                    const std::vector<Whole>& corners, const FoldTriangle& triangle, FoldRegion& region) {
    const auto& g = triangle.directions;
    const Barycentric lambda(g[0], g[1], g[2]);
    const auto form = [&](Vec3d v) {
        return lambda.form[0] * v.x + lambda.form[1] * v.y + lambda.form[2] * v.z;
    };
    for (const Whole& side : sides) region.sides.push_back(form(to_vector(side)));
    Vec3d middle;
    for (const Whole& corner : corners) {
        const Vec3d point = as_point(corner);
        region.corners.push_back(g[0] * point.x + g[1] * point.y + g[2] * point.z);
        middle = middle + point * (1.0 / double(corners.size()));
    }
    std::vector<const Sheet*> there;
    for (const Sheet& sheet : sheets)
        if (!sheet.at.has_value() || sides[*sheet.at] == *sheet.line) there.push_back(&sheet);
    std::stable_sort(there.begin(), there.end(),
                     [&](const Sheet* a, const Sheet* b) { return dot(a->w, middle) < dot(b->w, middle); });
    for (std::size_t k = 0; k < there.size(); ++k) {
        const Sheet& sheet = *there[k];
        if (sheet.outer != (k % 2 == 0)) return false;
        for (const Whole& corner : corners)
            if (dot(sheet.w, as_point(corner)) < sheet.least / 4) return false;
        if (!sheet.outer) continue;
        FoldRegion::Interval interval;
        interval.outer = form(sheet.w);
        interval.layer = sheet.layer;
        interval.to_center = k + 1 == there.size();
        if (!interval.to_center) {
            interval.inner = form(there[k + 1]->w);
            interval.inner_layer = there[k + 1]->layer;
        }
        if (triangle.center_inside && interval.to_center && sheet.single && sheet.at >= edges)
            interval.open = sheet.at;
        region.intervals.push_back(interval);
    }
    return true;
}

} // namespace

std::optional<std::vector<FoldRegion>> divide(const FoldTriangle& triangle) {
    std::optional<std::vector<Sheet>> sheets = find_sheets(triangle);
    if (!sheets.has_value()) return std::nullopt;
    const std::optional<std::vector<Whole>> lines = find_lines(*sheets);
    if (!lines.has_value()) return std::nullopt;
    std::vector<FoldRegion> regions;
    for (std::size_t choice = 0; choice < std::size_t(1) << (lines->size() - edges); ++choice) {
        std::vector<Whole> sides = *lines;
        for (std::size_t k = edges; k < sides.size(); ++k)
            if ((choice >> (k - edges) & 1U) != 0) sides[k] = negative(sides[k]);
        const std::vector<Whole> corners = corners_of(sides);
        if (corners.empty()) continue;
        if (!find_intervals(*sheets, sides, corners, triangle, regions.emplace_back())) return std::nullopt;
    }
    return regions;
}

FoldTable::FoldTable(std::span<const std::byte> folds) : records_(decode_folds(folds)) {
    std::stable_sort(records_.begin(), records_.end(),
                     [](const FoldRecord& a, const FoldRecord& b) { return a.edge < b.edge; });
}

std::array<FoldTriangle::Edge, 3> FoldTable::edges(std::uint32_t cells, TexelIndex cell,
                                                   const GridTriangle& triangle) const {
    const auto number = [&](TexelIndex a, TexelIndex b) {
        if (a.y == b.y) return edge_number(cells, {std::min(a.x, b.x), a.y}, 0);
        if (a.x == b.x) return edge_number(cells, {a.x, std::min(a.y, b.y)}, 1);
        return edge_number(cells, cell, 2);
    };
    std::array<FoldTriangle::Edge, 3> found;
    for (unsigned i = 0; i < 3; ++i) {
        const unsigned j = (i + 1) % 3;
        const std::uint32_t edge = number(triangle.corners[i], triangle.corners[j]);
        const bool forward = edge_ends(cells, edge)[0] == triangle.corners[i];
        found[i].corner = {forward ? i : j, forward ? j : i};
        const auto from = std::partition_point(records_.begin(), records_.end(),
                                               [&](const FoldRecord& r) { return r.edge < edge; });
        const auto to =
            std::partition_point(from, records_.end(), [&](const FoldRecord& r) { return r.edge == edge; });
        found[i].records = {from, to};
    }
    return found;
}

} // namespace spa::test
