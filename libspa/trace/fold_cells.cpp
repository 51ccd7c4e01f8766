// SPDX-License-Identifier: Apache-2.0
#include "fold_cells.h"

#include "fold_sheets.h"

#include <algorithm>
#include <cmath>

namespace spa::trace {
namespace {

// Corners of a region; what is left of the triangle's lines.
struct Region {
    std::vector<CellPoint> corners;
    std::uint32_t beyond = 0; // bit l: where line l is negative
};

double area(const std::vector<CellPoint>& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const CellPoint& p = polygon[i];
        const CellPoint& q = polygon[(i + 1) % polygon.size()];
        twice += p.u * q.v - q.u * p.v;
    }
    return std::abs(twice) / 2;
}

// The part of a convex polygon where sign * line >= 0.
std::vector<CellPoint> clip(const std::vector<CellPoint>& polygon, const CellPlane& line, double sign) {
    std::vector<CellPoint> result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const CellPoint& p = polygon[i];
        const CellPoint& q = polygon[(i + 1) % polygon.size()];
        const double a = sign * line.at(p.u, p.v);
        const double b = sign * line.at(q.u, q.v);
        if (a >= 0) result.push_back(p);
        if ((a > 0 && b < 0) || (a < 0 && b > 0)) {
            const double f = a / (a - b);
            result.push_back({p.u + f * (q.u - p.u), p.v + f * (q.v - p.v)});
        }
    }
    return result;
}

// Less is rounding: the line passes along a side.
constexpr double least_area = 1e-12;

std::vector<Region> divide(const std::array<CellPoint, 3>& triangle, const std::vector<CellPlane>& lines) {
    std::vector<Region> regions{{{triangle.begin(), triangle.end()}, 0}};
    for (std::size_t l = 0; l < lines.size(); ++l) {
        std::vector<Region> divided;
        for (Region& region : regions) {
            Region inside{clip(region.corners, lines[l], 1), region.beyond};
            Region beyond{clip(region.corners, lines[l], -1), region.beyond | 1U << l};
            const bool has_inside = area(inside.corners) >= least_area;
            const bool has_beyond = area(beyond.corners) >= least_area;
            if (has_inside && has_beyond) {
                divided.push_back(std::move(inside));
                divided.push_back(std::move(beyond));
            } else {
                region.beyond = has_beyond ? beyond.beyond : inside.beyond;
                divided.push_back(std::move(region));
            }
        }
        regions = std::move(divided);
    }
    return regions;
}

CellPoint centroid(const std::vector<CellPoint>& polygon) {
    CellPoint sum;
    for (const CellPoint& p : polygon) sum = {sum.u + p.u, sum.v + p.v};
    return {sum.u / double(polygon.size()), sum.v / double(polygon.size())};
}

// An interval and the regions that it is in.
struct Interval {
    const Sheet* outer = nullptr;
    const Sheet* inner = nullptr; // null: to the centre
    std::uint32_t regions = 0;
};

// The sheets of a region from outside in. False: they do not make intervals.
bool find_intervals(const Sheets& sheets, const Region& region, std::uint32_t number,
                    std::vector<Interval>& intervals) {
    struct Here {
        double w;
        const Sheet* sheet;
    };
    std::vector<Here> here;
    const CellPoint middle = centroid(region.corners);
    for (const Sheet& sheet : sheets.sheets)
        if (sheet.stands(region.beyond)) here.push_back({sheet.plane.at(middle.u, middle.v), &sheet});
    // Of equal W: in the order of their crossings, as sheets are.
    std::stable_sort(here.begin(), here.end(), [](const Here& a, const Here& b) { return a.w < b.w; });
    for (std::size_t i = 0; i < here.size(); ++i)
        if (here[i].sheet->inner != (i % 2 == 1)) return false;
    for (std::size_t i = 0; i < here.size(); i += 2) {
        const Sheet* const outer = here[i].sheet;
        const Sheet* const inner = i + 1 < here.size() ? here[i + 1].sheet : nullptr;
        const auto known = std::find_if(intervals.begin(), intervals.end(), [&](const Interval& k) {
            return k.outer == outer && k.inner == inner;
        });
        if (known != intervals.end())
            known->regions |= 1U << number;
        else
            intervals.push_back({outer, inner, 1U << number});
    }
    return true;
}

// Lines that bound a set of regions, and on which side it is.
struct Bounds {
    std::uint32_t lines = 0, beyond = 0;
};

std::uint32_t regions_within(const std::vector<Region>& regions, const Bounds& bounds) {
    std::uint32_t within = 0;
    for (std::size_t r = 0; r < regions.size(); ++r)
        if (((regions[r].beyond ^ bounds.beyond) & bounds.lines) == 0) within |= 1U << r;
    return within;
}

// The fewest lines that bound the set, greedily; false if it is not convex.
bool find_bounds(const std::vector<Region>& regions, std::uint32_t set, std::size_t lines, Bounds& bounds) {
    bounds = {};
    std::uint32_t all_beyond = ~0U;
    std::uint32_t any_beyond = 0;
    for (std::size_t r = 0; r < regions.size(); ++r) {
        if ((set >> r & 1U) == 0) continue;
        all_beyond &= regions[r].beyond;
        any_beyond |= regions[r].beyond;
    }
    const std::uint32_t known = (1U << lines) - 1;
    bounds = {(all_beyond | ~any_beyond) & known, all_beyond & known};
    if (regions_within(regions, bounds) != set) return false;
    for (std::size_t l = 0; l < lines; ++l) {
        const Bounds fewer{bounds.lines & ~(1U << l), bounds.beyond & ~(1U << l)};
        if (regions_within(regions, fewer) == set) bounds = fewer;
    }
    return true;
}

class PrismWriter {
public:
    PrismWriter(const Sheets& sheets, const std::vector<Region>& regions, bool center_inside,
                std::vector<FoldPrism>& prisms)
        : sheets_(sheets), regions_(regions), center_inside_(center_inside), prisms_(prisms) {}

    void write(const Interval& interval) {
        Bounds bounds;
        if (find_bounds(regions_, interval.regions, sheets_.lines.size(), bounds)) {
            write(interval, interval.regions, bounds);
            return;
        }
        for (std::size_t r = 0; r < regions_.size(); ++r) {
            if ((interval.regions >> r & 1U) == 0) continue;
            find_bounds(regions_, 1U << r, sheets_.lines.size(), bounds);
            write(interval, 1U << r, bounds);
        }
    }

private:
    void write(const Interval& interval, std::uint32_t set, const Bounds& bounds) {
        FoldPrism prism;
        prism.outer = interval.outer->plane;
        prism.outer_layer = interval.outer->layer;
        prism.to_center = interval.inner == nullptr;
        if (!prism.to_center) {
            prism.inner = interval.inner->plane;
            prism.inner_layer = interval.inner->layer;
        }
        for (std::size_t l = 0; l < sheets_.lines.size(); ++l) {
            if ((bounds.lines >> l & 1U) == 0) continue;
            const double sign = (bounds.beyond >> l & 1U) != 0 ? -1 : 1;
            const CellPlane& line = sheets_.lines[l];
            if (center_inside_ && prism.to_center && interval.outer->ends_alone &&
                interval.outer->line == int(l))
                prism.open |= 1U << prism.half_planes.size();
            prism.half_planes.push_back({sign * line.c, sign * line.u, sign * line.v});
        }
        for (std::size_t r = 0; r < regions_.size(); ++r)
            if ((set >> r & 1U) != 0)
                prism.corners.insert(prism.corners.end(), regions_[r].corners.begin(),
                                     regions_[r].corners.end());
        prisms_.push_back(std::move(prism));
    }

    const Sheets& sheets_;
    const std::vector<Region>& regions_;
    bool center_inside_;
    std::vector<FoldPrism>& prisms_;
};

bool stays_above(const Sheet& sheet, const std::vector<CellPoint>& corners) {
    return std::all_of(corners.begin(), corners.end(), [&](const CellPoint& p) {
        return sheet.plane.at(p.u, p.v) >= least_share_of_w * sheet.least_w;
    });
}

} // namespace

FoldCells::FoldCells(const Part& part)
    : cells_(part.layers.front().outer.depth.width - 1), center_inside_(part.center_inside),
      records_(decode_folds(part.folds)) {
    std::erase_if(records_, [&](const FoldRecord& r) { return !is_edge(cells_, r.edge); });
    std::stable_sort(records_.begin(), records_.end(),
                     [](const FoldRecord& a, const FoldRecord& b) { return a.edge < b.edge; });
}

std::pair<std::size_t, std::size_t> FoldCells::records_of(std::uint32_t edge) const {
    const auto [begin, end] =
        std::equal_range(records_.begin(), records_.end(), FoldRecord{.edge = edge},
                         [](const FoldRecord& a, const FoldRecord& b) { return a.edge < b.edge; });
    return {std::size_t(begin - records_.begin()), std::size_t(end - records_.begin())};
}

bool FoldCells::triangle(std::uint32_t x, std::uint32_t y, unsigned triangle,
                         const std::array<SampleCrossings, 3>& crossings, std::vector<FoldPrism>& prisms,
                         double& core) const {
    prisms.clear();
    std::array<EdgeRecords, 3> edges;
    const std::array<TriangleEdge, 3> around = triangle_edges(cells_, x, y, triangle);
    for (std::size_t k = 0; k < 3; ++k) {
        const auto [begin, end] = records_of(around[k].edge);
        edges[k].edge = around[k];
        edges[k].records = std::span(records_).subspan(begin, end - begin);
        const Grid grid{Mapping::octahedral, cells_ + 1, cells_ + 1};
        const auto [first, second] = edge_ends(cells_, around[k].edge);
        edges[k].direction = {sample_direction(grid, first), sample_direction(grid, second)};
    }
    Sheets sheets;
    if (!find_sheets(triangle, edges, crossings, sheets)) return false;
    const std::vector<Region> regions = divide(triangle_places(triangle), sheets.lines);
    std::vector<Interval> intervals;
    core = 0;
    for (std::size_t r = 0; r < regions.size(); ++r) {
        if (!find_intervals(sheets, regions[r], std::uint32_t(r), intervals)) return false;
        double begins = SPA_FAR;
        for (const Interval& interval : intervals) {
            if ((interval.regions >> r & 1U) == 0) continue;
            if (!stays_above(*interval.outer, regions[r].corners)) return false;
            if (interval.inner != nullptr && !stays_above(*interval.inner, regions[r].corners)) return false;
            if (interval.inner != nullptr) continue;
            begins = 0;
            for (const CellPoint& p : regions[r].corners)
                begins = std::max(begins, interval.outer->plane.at(p.u, p.v));
        }
        core = std::max(core, begins);
    }
    PrismWriter writer(sheets, regions, center_inside_, prisms);
    for (const Interval& interval : intervals) writer.write(interval);
    return true;
}

} // namespace spa::trace
