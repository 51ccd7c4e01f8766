// SPDX-License-Identifier: Apache-2.0
// What rays meet in the model itself: the judge of every tracer. Embree in its robust mode, then the
// interpolated normal and the colour as bakers have them.
#pragma once

#include "ray_errors.h"

#include "../bake/crossings.h"
#include "../bake/shading.h"
#include "../trace/triangle_scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace spa::measure {

class RayTruth {
public:
    // scene: of model.positions and the model's triangles. Both outlive this object. Rays are in the space of
    // model.positions: normalised space, units of R.
    RayTruth(const bake::CenteredModel& model, const trace::TriangleScene& scene);

    // Answers one entry a ray, parallel in the caller's arena. Normals are interpolated ones, colours those
    // of the very point, without a footprint. Points that a material makes invisible are passed through.
    [[nodiscard]] std::vector<RayAnswer> trace(std::span<const trace::Ray> rays) const;

    // 1 for every ray that passes a silhouette: of its four parallels, moved by `width` to both sides in two
    // directions across it, one hits where the ray itself misses, or the other way round. truth: trace(rays).
    // Others are interior; a stand-in that keeps its silhouettes to within `width` answers them as the model
    // does. Parallel.
    [[nodiscard]] std::vector<std::uint8_t>
    silhouette_band(std::span<const trace::Ray> rays, std::span<const RayAnswer> truth, float width) const;

private:
    struct Found;
    [[nodiscard]] bool find(const trace::Ray& ray, Found& found) const;
    [[nodiscard]] RayAnswer answer(const trace::Ray& ray) const;

    const bake::CenteredModel* model_;
    const trace::TriangleScene* scene_;
    bake::Shader shader_;
};

// Where a point lies in a triangle's plane, in the space of model.positions: weights of its corners, brought
// into the triangle.
Vec3d barycentric_of(const bake::CenteredModel& model, std::uint32_t triangle, Vec3d point);

// Two unit vectors across `direction` (any length > 0) and each other.
struct Across {
    Vec3f first, second;
};
Across across(Vec3f direction);

} // namespace spa::measure
