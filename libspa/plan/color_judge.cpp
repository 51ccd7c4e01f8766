// SPDX-License-Identifier: Apache-2.0
#include "color_judge.h"

#include "candidate.h"

#include "../bake/center.h"
#include "../core/element_format.h"
#include "../measure/cast_embree.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace spa::plan {
namespace {

constexpr std::size_t places = 1536;       // that are compared
constexpr std::size_t cone_directions = 8; // at each, with a footprint
// The model's own colours are filtered for texels of a map of so many cells: finer than any that is tried.
constexpr std::uint32_t source_cells = 4096;

// Even over the sphere: a golden spiral.
Vec3d spiral(std::size_t i, std::size_t count) {
    const double y = 1 - 2 * (double(i) + 0.5) / double(count);
    const double angle = double(i) * std::numbers::pi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - y * y);
    return {r * std::cos(angle), y, r * std::sin(angle)};
}

// `count` directions in a cone of this half-angle around `axis`, even over its cross-section; for one the
// axis.
void add_cone(Vec3d axis, double half_angle, std::size_t count, std::vector<Vec3d>& directions) {
    const Vec3d right = normalize(cross(axis, std::abs(axis.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0}));
    const Vec3d up = cross(right, axis);
    for (std::size_t k = 0; k < count; ++k) {
        const double r = count == 1 ? 0 : std::tan(half_angle) * std::sqrt((double(k) + 0.5) / double(count));
        const double angle = double(k) * std::numbers::pi * (3 - std::sqrt(5.0));
        directions.push_back(axis + right * (r * std::cos(angle)) + up * (r * std::sin(angle)));
    }
}

// The mean, in linear light, of colours with weights.
struct MeanColor {
    std::array<double, 3> sum{};
    double weight = 0;

    void add(const std::array<std::uint8_t, 4>& srgb, double w) {
        for (std::size_t c = 0; c < 3; ++c) sum[c] += w * double(srgb_to_linear(srgb[c]));
        weight += w;
    }
    void add(const MeanColor& other) {
        for (std::size_t c = 0; c < 3; ++c) sum[c] += other.sum[c] / other.weight;
        weight += 1;
    }
    [[nodiscard]] int code(std::size_t c) const { return linear_to_srgb(float(sum[c] / weight)); }
};

// The outermost crossing along each ray; of radius 0 where there is none.
std::vector<bake::Crossing> outermost(const bake::CenteredModel& model, const trace::TriangleScene& scene,
                                      const Grid& grid, const std::vector<measure::CenterRay>& rays) {
    const bake::CrossingGrid cast = measure::cast_embree(model, scene, grid, rays, {.outermost_only = true});
    std::vector<bake::Crossing> result(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (cast.first[i] != cast.first[i + 1]) result[i] = cast.crossings[cast.first[i]];
    return result;
}

TexelIndex nearest_sample(const Grid& grid, Vec3d direction) {
    const Vec2d at = position_of(grid, direction);
    return wrap(grid, std::llround(at.x), std::llround(at.y));
}

// The four samples around a position, with bilinear weights.
struct Corner {
    TexelIndex texel;
    double weight = 0;
};
std::array<Corner, 4> corners_of(const Grid& grid, Vec3d direction) {
    const Vec2d at = position_of(grid, direction);
    const double x = std::floor(at.x), y = std::floor(at.y);
    std::array<Corner, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t row = k / 2;
        const double dx = double(k % 2), dy = double(row);
        corners[k] = {wrap(grid, std::int64_t(x + dx), std::int64_t(y + dy)),
                      (1 - std::abs(at.x - x - dx)) * (1 - std::abs(at.y - y - dy))};
    }
    return corners;
}

} // namespace

ColorJudge::ColorJudge(const Model& model, const Part& place, double footprint)
    : mapping_(place.mapping),
      centered_(bake::center_model(model, {place.center, place.frame, place.radius})),
      scene_(centered_.positions, model.triangles), group_(footprint > 0 ? cone_directions : 1) {
    for (std::size_t i = 0; i < places; ++i)
        add_cone(spiral(i, places), footprint * std::numbers::pi / 180, group_, directions_);
    const Grid grid = grid_of(mapping_, source_cells);
    std::vector<measure::CenterRay> rays;
    rays.reserve(directions_.size());
    for (const Vec3d direction : directions_) rays.push_back({nearest_sample(grid, direction), direction});
    source_ = outermost(centered_, scene_, grid, rays);
}

double ColorJudge::error(std::uint32_t cells) const {
    const Grid grid = grid_of(mapping_, cells);
    std::vector<measure::CenterRay> rays;
    rays.reserve(4 * directions_.size());
    for (const Vec3d direction : directions_)
        for (const Corner& corner : corners_of(grid, direction))
            rays.push_back({corner.texel, sample_direction(grid, corner.texel)});
    const std::vector<bake::Crossing> stored = outermost(centered_, scene_, grid, rays);

    double sum = 0;
    std::size_t compared = 0;
    for (std::size_t first = 0; first < directions_.size(); first += group_) {
        MeanColor exact, read;
        for (std::size_t i = first; i < first + group_; ++i) {
            const std::array<Corner, 4> corners = corners_of(grid, directions_[i]);
            MeanColor bilinear;
            for (std::size_t k = 0; k < 4; ++k)
                if (stored[4 * i + k].radius > 0) bilinear.add(stored[4 * i + k].color, corners[k].weight);
            if (!(source_[i].radius > 0) || !(bilinear.weight > 0)) continue;
            exact.add(source_[i].color, 1);
            read.add(bilinear);
        }
        if (!(exact.weight > 0)) continue;
        int difference = 0;
        for (std::size_t c = 0; c < 3; ++c) difference += std::abs(exact.code(c) - read.code(c));
        sum += difference / 3.0;
        ++compared;
    }
    return compared == 0 ? 0 : sum / double(compared);
}

} // namespace spa::plan
