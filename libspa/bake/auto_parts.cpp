// SPDX-License-Identifier: Apache-2.0
#include "auto_parts.h"

#include "coarse_model.h"
#include "surface_views.h"

#include "../mesh/components.h"
#include "../mesh/part_frame.h"
#include "../mesh/piece_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace spa::bake {
namespace {

constexpr double least_gain = 1e-3; // of the whole surface
constexpr std::array places{0.25, 0.5, 0.75};

Vec3d corner(const Model& model, std::uint32_t triangle, unsigned k) {
    return to_double(model.positions[model.triangles[triangle].vertex[k]]);
}

Vec3d plane_normal(const Model& model, std::uint32_t triangle) {
    const Vec3d a = corner(model, triangle, 0);
    return cross(corner(model, triangle, 1) - a, corner(model, triangle, 2) - a);
}

Vec3d middle(const Model& model, std::uint32_t triangle) {
    return (corner(model, triangle, 0) + corner(model, triangle, 1) + corner(model, triangle, 2)) * (1.0 / 3);
}

struct Candidate {
    std::vector<std::uint32_t> triangles; // of the whole
    double area = 0;
    double held = 0; // share
    bool final = false;

    [[nodiscard]] double lost() const { return final ? 0 : area * (1 - held); }
};

class Divider {
public:
    Divider(const Model& model, std::uint32_t layers) : model_(model), layers_(layers) {}

    [[nodiscard]] Candidate judge(std::vector<std::uint32_t> triangles) const {
        Candidate candidate;
        candidate.triangles = std::move(triangles);
        for (const std::uint32_t t : candidate.triangles)
            candidate.area += length(plane_normal(model_, t)) / 2;
        candidate.held = held_share(piece_model(model_, candidate.triangles), layers_);
        return candidate;
    }

    using Halves = std::array<Candidate, 2>;
    [[nodiscard]] std::optional<Halves> best_cut(const Candidate& piece) const {
        const Model model = piece_model(model_, piece.triangles);
        const Axes box = oriented_bounds(model);
        const std::vector<Vec3d> own = middles(model), of_component = component_middles(model, own);
        std::optional<Halves> best;
        double most = 0;
        const auto consider = [&](const std::vector<Vec3d>& points, unsigned axis, double place) {
            std::array<std::vector<std::uint32_t>, 2> sides;
            const double at = dot(box.axis[axis], box.center) + (2 * place - 1) * box.extent[axis];
            for (std::size_t i = 0; i < points.size(); ++i)
                sides[dot(box.axis[axis], points[i]) < at ? 0 : 1].push_back(piece.triangles[i]);
            if (sides[0].empty() || sides[1].empty()) return;
            Halves halves{judge(std::move(sides[0])), judge(std::move(sides[1]))};
            const double held = halves[0].held * halves[0].area + halves[1].held * halves[1].area;
            if (!(held > most)) return;
            most = held;
            best = std::move(halves);
        };
        for (unsigned axis = 0; axis < 3; ++axis) {
            for (const double place : places) consider(own, axis, place);
            consider(of_component, axis, 0.5);
        }
        return best;
    }

private:
    static std::vector<Vec3d> middles(const Model& model) {
        std::vector<Vec3d> points(model.triangles.size());
        for (std::uint32_t t = 0; t < points.size(); ++t) points[t] = middle(model, t);
        return points;
    }

    // For each triangle the mean of the middles of its connected piece.
    static std::vector<Vec3d> component_middles(const Model& model, const std::vector<Vec3d>& own) {
        const Components components = find_components(model);
        std::vector<Vec3d> sums(components.count);
        std::vector<double> counts(components.count);
        for (std::size_t t = 0; t < own.size(); ++t) {
            sums[components.of_triangle[t]] = sums[components.of_triangle[t]] + own[t];
            counts[components.of_triangle[t]] += 1;
        }
        std::vector<Vec3d> points(own.size());
        for (std::size_t t = 0; t < own.size(); ++t) {
            const std::uint32_t c = components.of_triangle[t];
            points[t] = sums[c] * (1 / counts[c]);
        }
        return points;
    }

    const Model& model_;
    std::uint32_t layers_;
};

} // namespace

double held_share(const Model& model, std::uint32_t layers) {
    const Model coarse = coarse_model(model);
    bool moved = false;
    const Vec3d center = bounds_center(model, moved);
    return SurfaceViews(coarse, layers == 1 ? 1 : 2 * layers).from({center, {}}).captured;
}

Partition divide_by_need(const Model& model, std::uint32_t layers, std::uint32_t max_parts, double enough) {
    const Divider divider(model, layers);
    std::vector<Candidate> pieces;
    pieces.push_back(divider.judge(std::move(whole(model).front().triangles)));
    const double area = pieces.front().area;
    const auto held = [&] {
        double sum = 0;
        for (const Candidate& piece : pieces) sum += piece.area * piece.held;
        return sum / area;
    };
    while (pieces.size() < max_parts && held() < enough) {
        const auto worst =
            std::max_element(pieces.begin(), pieces.end(),
                             [](const Candidate& a, const Candidate& b) { return a.lost() < b.lost(); });
        if (!(worst->lost() > least_gain * area)) break;
        auto halves = divider.best_cut(*worst);
        const double gain = halves ? (*halves)[0].held * (*halves)[0].area +
                                         (*halves)[1].held * (*halves)[1].area - worst->held * worst->area
                                   : 0;
        if (!(gain > least_gain * area)) {
            worst->final = true;
            continue;
        }
        *worst = std::move((*halves)[0]);
        pieces.push_back(std::move((*halves)[1]));
    }
    std::sort(pieces.begin(), pieces.end(),
              [](const Candidate& a, const Candidate& b) { return a.triangles[0] < b.triangles[0]; });
    Partition partition;
    for (Candidate& piece : pieces) partition.emplace_back().triangles = std::move(piece.triangles);
    if (partition.size() > 1) overlap_by_one_ring(model, partition);
    return partition;
}

} // namespace spa::bake
