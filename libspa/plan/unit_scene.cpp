// SPDX-License-Identifier: Apache-2.0
#include "unit_scene.h"

#include "../bake/center.h"
#include "../core/element_format.h"
#include "../core/error.h"
#include "../measure/ray_truth.h"
#include "../mesh/part_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace spa::plan {
namespace {

struct Box {
    Vec3d low, high;
};

Box bounds(const Model& model) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Box box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
    for (const Vec3f position : model.positions) {
        const Vec3d p = to_double(position);
        box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
        box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
    return box;
}

PartFrame unit_frame(const Model& model) {
    const Box box = bounds(model);
    PartFrame frame;
    frame.center = (box.low + box.high) * 0.5;
    frame.radius = length(box.high - box.low) / 2;
    if (!(frame.radius > 0) || !std::isfinite(frame.radius))
        throw Error(ExitCode::invalid_data, "the scene has no size: there is nothing to plan");
    return frame;
}

constexpr double rendered_start_height = 4e-6; // of the diagonal of the scene's box

} // namespace

UnitScene::UnitScene(const Scene& scene, const std::vector<SceneObject>& objects)
    : scene_(&scene), object_of_triangle_(object_of_triangles(scene, objects)),
      scale_(1 / unit_frame(scene.model).radius),
      model_(bake::center_model(scene.model, unit_frame(scene.model))),
      triangles_(model_.positions, scene.model.triangles), shader_(model_),
      start_height_(float(2 * rendered_start_height)) {
    for (int i = 0; i < 3; ++i) to_unit_.linear.row[i] = to_unit_.linear.row[i] * scale_;
    to_unit_.translation = unit_frame(scene.model).center * -scale_;
}

bool UnitScene::visible(const trace::TriangleHit& hit, Vec3f origin, Vec3f direction) const {
    if (!shader_.needs_alpha(hit.triangle)) return true;
    const Vec3d point = to_double(origin) + to_double(direction) * double(hit.t);
    return shader_.color(hit.triangle, measure::barycentric_of(model_, hit.triangle, point), 0).visible;
}

void UnitScene::first_hits(Vec3f origin, Vec3f direction, float max_t, Scratch& scratch,
                           std::vector<ObjectHit>& hits) const {
    hits.clear();
    triangles_.all_hits(origin, direction, max_t, scratch);
    std::sort(scratch.begin(), scratch.end(), [](const trace::TriangleHit& a, const trace::TriangleHit& b) {
        return a.t != b.t ? a.t < b.t : a.triangle < b.triangle;
    });
    for (const trace::TriangleHit& hit : scratch) {
        const std::uint32_t object = object_of_triangle_[hit.triangle];
        const bool known = std::any_of(hits.begin(), hits.end(),
                                       [&](const ObjectHit& earlier) { return earlier.object == object; });
        if (!known && visible(hit, origin, direction)) hits.push_back({hit.t, hit.triangle, object});
    }
}

bool UnitScene::blocked(Vec3f origin, Vec3f direction, float max_t, std::uint32_t but,
                        Scratch& scratch) const {
    trace::TriangleHit hit;
    if (!triangles_.closest_hit(origin, direction, max_t, hit)) return false;
    if (object_of_triangle_[hit.triangle] != but && visible(hit, origin, direction)) return true;
    triangles_.all_hits(origin, direction, max_t, scratch);
    return std::any_of(scratch.begin(), scratch.end(), [&](const trace::TriangleHit& other) {
        return object_of_triangle_[other.triangle] != but && visible(other, origin, direction);
    });
}

SurfacePoint UnitScene::surface(const ObjectHit& hit, Vec3f origin, Vec3f direction) const {
    SurfacePoint point;
    point.object = hit.object;
    point.position = origin + direction * hit.t;
    const Vec3d weights = measure::barycentric_of(model_, hit.triangle, to_double(point.position));
    const auto& v = scene_->model.triangles[hit.triangle].vertex;
    const Vec3d a = to_double(model_.positions[v[0]]);
    point.plane = to_float(
        normalize(cross(to_double(model_.positions[v[1]]) - a, to_double(model_.positions[v[2]]) - a)));
    if (dot(point.plane, direction) > 0) point.plane = -point.plane;
    const Vec3f normal = shader_.normal(hit.triangle, weights);
    point.normal = dot(normal, point.plane) < 0 ? -normal : normal;
    const auto color = shader_.color(hit.triangle, weights, 0).srgba;
    point.albedo = {srgb_to_linear(color[0]), srgb_to_linear(color[1]), srgb_to_linear(color[2])};
    return point;
}

bool UnitScene::lit(std::size_t light, const SurfacePoint& surface, Vec3f start, LitBy& by) const {
    const Light& it = scene_->lights[light];
    Vec3d way = -it.direction;
    Vec3d shadow_way = way;
    double share = 1;
    by.range = std::numeric_limits<float>::infinity();
    if (it.kind != LightKind::directional) {
        const Vec3d position = transform_point(to_unit_, it.position);
        way = position - to_double(surface.position);
        shadow_way = position - to_double(start);
        by.range = 1;
        const double square = dot(way, way);
        if (!(square > 0)) return false;
        way = way * (1 / std::sqrt(square));
        share = scale_ * scale_ / square;
    }
    if (it.kind == LightKind::spot) share *= spot_share(it, -dot(way, it.direction));
    share *= dot(to_double(surface.normal), way);
    if (!(share > 0) || dot(to_double(surface.plane), way) <= 0) return false;
    const auto factor = float(share / std::numbers::pi);
    by.radiance = {surface.albedo.x * it.intensity.x * factor, surface.albedo.y * it.intensity.y * factor,
                   surface.albedo.z * it.intensity.z * factor};
    by.way = to_float(shadow_way);
    return true;
}

} // namespace spa::plan
