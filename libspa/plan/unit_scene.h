// SPDX-License-Identifier: Apache-2.0
// A scene ready for rays that ask which objects they meet: scaled to about the size of 1 around the origin,
// as Embree's single precision wants it. Everything here is in that space unless it says otherwise.
#pragma once

#include "scene_objects.h"

#include "../bake/crossings.h"
#include "../bake/shading.h"
#include "../trace/triangle_scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace spa::plan {

// A surface that light leaves.
struct SurfacePoint {
    Vec3f position;
    Vec3f plane;  // unit normal of the surface, on the side of the ray that found it
    Vec3f normal; // unit, for shading, on the same side
    Vec3f albedo; // linear
    std::uint32_t object = no_index;
};

// The first hit of one object along a ray.
struct ObjectHit {
    float t = 0;
    std::uint32_t triangle = 0, object = 0;
};

// What one light gives a surface if nothing is between.
struct LitBy {
    Vec3f radiance;  // that the surface sends out, by a diffuse material
    Vec3f way;       // of the shadow ray, from its start
    float range = 0; // its t_max
};

class UnitScene {
public:
    // Both outlive this object. Parallel in the caller's arena. Throws Error{invalid_data} for a scene of
    // zero size, Error{internal} if Embree fails.
    UnitScene(const Scene& scene, const std::vector<SceneObject>& objects);

    // Room for what one ray hits; one a thread.
    using Scratch = std::vector<trace::TriangleHit>;

    // The first visible hit of each object with 0 < t < max_t, nearest first. Replaces the content of `hits`.
    void first_hits(Vec3f origin, Vec3f direction, float max_t, Scratch& scratch,
                    std::vector<ObjectHit>& hits) const;
    // Whether an object other than `but` is hit with 0 < t < max_t.
    [[nodiscard]] bool blocked(Vec3f origin, Vec3f direction, float max_t, std::uint32_t but,
                               Scratch& scratch) const;
    [[nodiscard]] SurfacePoint surface(const ObjectHit& hit, Vec3f origin, Vec3f direction) const;

    [[nodiscard]] std::size_t lights() const { return scene_->lights.size(); }
    // False if the light does not reach the front of the surface. start: where the shadow ray begins.
    bool lit(std::size_t light, const SurfacePoint& surface, Vec3f start, LitBy& by) const;

    [[nodiscard]] const Affine& to_unit() const { return to_unit_; }
    [[nodiscard]] double scale() const { return scale_; } // unit lengths a world length
    // How far above triangles rays start, as the renderer has it (docs/rendering.md).
    [[nodiscard]] float start_height() const { return start_height_; }

private:
    [[nodiscard]] bool visible(const trace::TriangleHit& hit, Vec3f origin, Vec3f direction) const;

    const Scene* scene_;
    std::vector<std::uint32_t> object_of_triangle_;
    double scale_ = 1;
    Affine to_unit_;
    bake::CenteredModel model_;
    trace::TriangleScene triangles_;
    bake::Shader shader_;
    float start_height_ = 0;
};

} // namespace spa::plan
