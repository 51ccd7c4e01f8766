// SPDX-License-Identifier: Apache-2.0
#include "find_folds.h"

#include "cast_points.h"
#include "edge_paths.h"
#include "fold_records.h"
#include "pairing.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace spa::bake {
namespace {

constexpr std::uint32_t steps = 16; // an edge is halved four times
constexpr std::uint32_t not_cast = UINT32_MAX;

// The crossings of one cast point; see EdgeCrossing.
struct PointCrossing {
    float radius = 0;
    std::uint32_t triangle = 0;
    bool inner = false;
};

// An edge that is searched. Pieces between two of its points that have none between them match, or are to be
// halved.
struct Edge {
    std::uint32_t number = 0;
    std::array<std::uint32_t, steps + 1> point{}; // not_cast, or which
    std::uint32_t matches = 0;                    // bit k: the piece that begins at point k does
};

// Of two edges of the border that are the same edge of the object, the one with the lower number stands for
// both. Their ends are swapped.
std::uint32_t twin(std::uint32_t cells, std::uint32_t edge) {
    const auto [a, b] = edge_ends(cells, edge);
    if (edge % 3 == 0 && (a.y == 0 || a.y == cells)) return edge_number(cells, {cells - b.x, a.y}, 0);
    if (edge % 3 == 1 && (a.x == 0 || a.x == cells)) return edge_number(cells, {a.x, cells - b.y}, 1);
    return edge;
}

class FoldFinder {
public:
    FoldFinder(const CenteredModel& model, const Components& components, const Orientation& orientation,
               const SurfaceGrid& surfaces)
        : components_(components), orientation_(orientation), surfaces_(surfaces),
          cells_(surfaces.grid.width - 1), face_normal_(face_normals(model)), caster_(model, cells_, steps) {
        first_.push_back(0);
    }

    Folds find(std::vector<std::uint8_t>& matching_edges) {
        collect(matching_edges);
        for (std::uint32_t length = steps; length > 1; length /= 2) {
            each_edge([&](Edge& edge) { test_pieces(edge, length); });
            halve(length);
        }
        each_edge([&](Edge& edge) { test_pieces(edge, 1); });
        return write(matching_edges);
    }

private:
    template <class Visit>
    void each_edge(Visit&& visit) {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, edges_.size(), 64), [&](const auto& range) {
            for (std::size_t e = range.begin(); e < range.end(); ++e) visit(edges_[e]);
        });
    }

    // The edges to search, and the crossings at their ends: all of them, not only those of the stored layers.
    void collect(const std::vector<std::uint8_t>& matching_edges) {
        std::vector<std::uint32_t> point_of(std::size_t(cells_ + 1) * (cells_ + 1), not_cast);
        std::vector<TexelIndex> points;
        for (std::uint32_t e = 0; e < matching_edges.size(); ++e) {
            if (matching_edges[e] != 0 || twin(cells_, e) < e) continue;
            Edge edge;
            edge.number = e;
            edge.point.fill(not_cast);
            const std::array<TexelIndex, 2> ends = edge_ends(cells_, e);
            for (const std::size_t end : {0U, 1U}) {
                std::uint32_t& point = point_of[std::size_t(ends[end].y) * (cells_ + 1) + ends[end].x];
                if (point == not_cast) {
                    point = std::uint32_t(points.size());
                    points.push_back({ends[end].x * steps, ends[end].y * steps});
                }
                edge.point[end * steps] = point;
            }
            edges_.push_back(edge);
        }
        cast(points);
        samples_cast_ = points_.size();
    }

    [[nodiscard]] TexelIndex place(const Edge& edge, std::uint32_t step) const {
        const auto [a, b] = edge_ends(cells_, edge.number);
        return {a.x * (steps - step) + b.x * step, a.y * (steps - step) + b.y * step};
    }

    void cast(const std::vector<TexelIndex>& points) {
        const PointCrossings cast = caster_.cast(points);
        Pairing pair(components_, orientation_);
        for (std::size_t i = 0; i < points.size(); ++i) {
            bool thin = false;
            const std::span<const Crossing> crossings(cast.crossings.data() + cast.first[i],
                                                      std::size_t(cast.first[i + 1] - cast.first[i]));
            for (const Interval& interval : pair(crossings, thin)) {
                crossings_.push_back({interval.outer.radius, interval.outer.triangle, false});
                if (interval.inner.radius > 0)
                    crossings_.push_back({interval.inner.radius, interval.inner.triangle, true});
            }
            first_.push_back(crossings_.size());
            points_.push_back(points[i]);
        }
    }

    [[nodiscard]] EdgePoint read(std::uint32_t point, std::uint32_t step) const {
        EdgePoint result;
        result.position = double(step) / steps;
        result.direction = sample_direction(caster_.grid(), points_[point]);
        for (std::size_t i = first_[point]; i < first_[point + 1]; ++i)
            result.crossings.push_back({make_end(double(crossings_[i].radius), crossings_[i].triangle,
                                                 result.direction, face_normal_),
                                        crossings_[i].inner});
        return result;
    }

    [[nodiscard]] double length_of(const Edge& edge) const {
        return 2.0 / cells_ * (edge.number % 3 == 2 ? std::numbers::sqrt2 : 1.0);
    }

    // The pieces of so many steps.
    void test_pieces(Edge& edge, std::uint32_t length) const {
        for (std::uint32_t k = 0; k < steps; k += length) {
            const std::uint32_t a = edge.point[k];
            const std::uint32_t b = edge.point[k + length];
            if (a == not_cast || b == not_cast || (length > 1 && edge.point[k + length / 2] != not_cast))
                continue;
            if (points_match(read(a, k), read(b, k + length), length_of(edge) * length / steps))
                edge.matches |= 1U << k;
        }
    }

    // The pieces of so many steps that do not match.
    void halve(std::uint32_t length) {
        std::vector<TexelIndex> points;
        const auto next = std::uint32_t(points_.size());
        for (Edge& edge : edges_) {
            for (std::uint32_t k = 0; k < steps; k += length) {
                if (edge.point[k] == not_cast || edge.point[k + length] == not_cast ||
                    (edge.matches >> k & 1U) != 0)
                    continue;
                edge.point[k + length / 2] = next + std::uint32_t(points.size());
                points.push_back(place(edge, k + length / 2));
            }
        }
        cast(points);
    }

    Folds write(std::vector<std::uint8_t>& matching_edges) {
        std::vector<EdgeFolds> found(edges_.size());
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, edges_.size(), 64), [&](const auto& range) {
            for (std::size_t e = range.begin(); e < range.end(); ++e) found[e] = folds_of(edges_[e]);
        });
        Folds folds;
        folds.statistics.edges = matching_edges.size();
        folds.statistics.searched = edges_.size();
        folds.statistics.directions = points_.size() - samples_cast_;
        for (const EdgeFolds& edge : found) {
            if (edge.unresolved) ++folds.statistics.unresolved;
            for (const FoldRecord& record : edge.records) {
                folds.records.push_back(record);
                const std::uint32_t other = twin(cells_, record.edge);
                if (other == record.edge) continue;
                folds.records.push_back(record);
                folds.records.back().edge = other;
                folds.records.back().end = std::uint8_t(1 - record.end);
            }
        }
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            if (!found[e].records.empty() || found[e].unresolved) continue;
            matching_edges[edges_[e].number] = 1;
            matching_edges[twin(cells_, edges_[e].number)] = 1;
        }
        for (const FoldRecord& record : folds.records)
            ++(record.pair ? folds.statistics.pairs : folds.statistics.singles);
        std::stable_sort(folds.records.begin(), folds.records.end(),
                         [](const FoldRecord& a, const FoldRecord& b) { return a.edge < b.edge; });
        return folds;
    }

    [[nodiscard]] std::array<std::uint32_t, 2> stored_crossings(std::uint32_t number) const {
        std::array<std::uint32_t, 2> stored{};
        const std::array<TexelIndex, 2> ends = edge_ends(cells_, number);
        for (const std::size_t end : {0U, 1U}) {
            const std::size_t sample = std::size_t(ends[end].y) * (cells_ + 1) + ends[end].x;
            while (stored[end] < surfaces_.surfaces.size() &&
                   surfaces_.surfaces[stored[end]][sample].radius > 0)
                ++stored[end];
        }
        return stored;
    }

    [[nodiscard]] EdgeFolds folds_of(const Edge& edge) const {
        std::vector<EdgePoint> points;
        for (std::uint32_t k = 0; k <= steps; ++k)
            if (edge.point[k] != not_cast) points.push_back(read(edge.point[k], k));
        return fold_records(edge.number, points, EdgePaths(points, length_of(edge)),
                            stored_crossings(edge.number));
    }

    const Components& components_;
    const Orientation& orientation_;
    const SurfaceGrid& surfaces_;
    std::uint32_t cells_;
    FaceNormal face_normal_;
    PointCaster caster_;
    std::vector<Edge> edges_;
    std::vector<TexelIndex> points_; // as samples of the caster's grid
    std::size_t samples_cast_ = 0;   // how many of them, the first ones, are samples of the map
    std::vector<std::size_t> first_; // crossings of each point, and the end
    std::vector<PointCrossing> crossings_;
};

} // namespace

Folds find_folds(const CenteredModel& model, const Components& components, const Orientation& orientation,
                 const SurfaceGrid& surfaces, std::vector<std::uint8_t>& matching_edges) {
    return FoldFinder(model, components, orientation, surfaces).find(matching_edges);
}

} // namespace spa::bake
