// SPDX-License-Identifier: Apache-2.0
#include "stand_in.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spa::plan {
namespace {

constexpr double rendered_map_height = 0.6; // of the distance between a map's samples

double sample_distance(const Part& part, const Affine& to_space) {
    const Mat3 m = to_space.linear * part.frame;
    const double scale =
        std::sqrt((dot(m.row[0], m.row[0]) + dot(m.row[1], m.row[1]) + dot(m.row[2], m.row[2])) / 3);
    const ImageView& depth = part.layers.front().outer.depth;
    return part.radius * scale * std::sqrt(4 * std::numbers::pi / (double(depth.width) * depth.height));
}

} // namespace

TrialMap make_trial_map(const Model& model, const bake::Options& options) {
    TrialMap trial{bake::bake_model(model, options), nullptr};
    trial.map = std::make_unique<trace::TraceMap>(trial.part());
    return trial;
}

StandIn::StandIn(const UnitScene& scene, const TrialMap& map, const Affine& node_to_world) {
    const Affine to_unit = scene.to_unit() * node_to_world;
    scene_.add(*map.map, map.part(), to_unit);
    start_height_ =
        std::max(scene.start_height(), float(rendered_map_height * sample_distance(map.part(), to_unit)));
}

bool StandIn::closest_hit(Vec3f origin, Vec3f direction, float max_t, trace::Hit& hit) const {
    return scene_.closest_hit({origin, 0, direction, max_t}, trace::no_flags, hit);
}

bool StandIn::blocked(Vec3f origin, Vec3f direction, float max_t) const {
    return scene_.occluded({origin, 0, direction, max_t}, trace::no_flags);
}

SurfacePoint StandIn::surface(const trace::Hit& hit, Vec3f origin, Vec3f direction,
                              std::uint32_t object) const {
    const trace::Shade shade = scene_.shade(hit);
    const float side = hit.front ? 1.0F : -1.0F;
    SurfacePoint point;
    point.position = origin + direction * hit.t;
    point.plane = hit.normal * side;
    point.normal = shade.normal * side;
    point.albedo = shade.color;
    point.object = object;
    return point;
}

} // namespace spa::plan
