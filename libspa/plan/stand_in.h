// SPDX-License-Identifier: Apache-2.0
// A map in the place of an object of a UnitScene.
#pragma once

#include "unit_scene.h"

#include "../bake/bake.h"
#include "../trace/scene.h"
#include "../trace/trace_map.h"

#include <cstdint>
#include <memory>

namespace spa::plan {

// A map as it is rendered.
struct TrialMap {
    bake::Result baked;
    std::unique_ptr<trace::TraceMap> map;

    [[nodiscard]] const Part& part() const { return baked.map.map.parts.front(); }
    // Of memory while it is rendered: the trace image with colours and normals.
    [[nodiscard]] std::uint64_t bytes() const { return map->words().size_bytes(); }
};
// Throws as bake_model and TraceMap do.
TrialMap make_trial_map(const Model& model, const bake::Options& options);

class StandIn {
public:
    // All outlive this object. node_to_world: of the object's node. Throws Error{usage} for a transform
    // without inverse.
    StandIn(const UnitScene& scene, const TrialMap& map, const Affine& node_to_world);

    // The first hit with t <= max_t. In unit space.
    bool closest_hit(Vec3f origin, Vec3f direction, float max_t, trace::Hit& hit) const;
    [[nodiscard]] bool blocked(Vec3f origin, Vec3f direction, float max_t) const;
    [[nodiscard]] SurfacePoint surface(const trace::Hit& hit, Vec3f origin, Vec3f direction,
                                       std::uint32_t object) const;
    // How far above the object's surface rays start, as the renderer has it (docs/rendering.md).
    [[nodiscard]] float start_height() const { return start_height_; }

private:
    trace::Scene scene_;
    float start_height_ = 0;
};

} // namespace spa::plan
