// SPDX-License-Identifier: Apache-2.0
// What a perfect map of a model would hold: the stored surfaces of exact rays, without texels, bits or a
// baker. Rays and triangles are Embree's (cast_embree.h); how crossings become surfaces is the definition of
// the data (bake/intervals.h).
#pragma once

#include "cast_embree.h"

#include "../bake/intervals.h"
#include "../core/spherical_map.h"
#include "../mesh/components.h"

#include <memory>
#include <span>

namespace spa::measure {

class Reference {
public:
    // The model seen from the centre of `part`, in its frame, with as many layers, or with `layers` if that
    // is more. Units: the radius of the model's own bounding sphere about that centre, whatever the part says
    // (source_radius). model outlives this object; the part need not. threads: 0 = all cores. Throws
    // Error{invalid_data} for a model of zero size; Error{limits} if the part's radius is beyond a thousand
    // times the model's or its thousandth (it is of another object, and distances would say nothing); and
    // bake::Cancelled.
    Reference(const Model& model, const Part& part, std::uint32_t layers, unsigned threads,
              const bake::Progress& progress);

    // In frame units; equal to part.radius but for rounding if the part was baked from this model.
    [[nodiscard]] double source_radius() const { return source_radius_; }
    [[nodiscard]] const bake::CenteredModel& model() const { return *model_; }
    // Of the triangles in the part's object axes: centre at the origin, in units of source_radius.
    [[nodiscard]] const trace::TriangleScene& scene() const {
        return object_scene_ ? *object_scene_ : *scene_;
    }
    // The positions of that scene.
    [[nodiscard]] std::span<const Vec3f> object_positions() const;

    // The surfaces along the directions of all samples of the part's depth grid.
    [[nodiscard]] const bake::SurfaceGrid& shape() const { return shape_; }
    // The same of another grid, and along given directions (frame space; the result is one row of them).
    [[nodiscard]] bake::SurfaceGrid cast(const Grid& grid, const bake::Progress& progress) const;
    [[nodiscard]] bake::SurfaceGrid cast(const Grid& grid, std::span<const CenterRay> rays,
                                         const bake::Progress& progress) const;

private:
    [[nodiscard]] bake::SurfaceGrid pair(const bake::CrossingGrid& crossings) const;

    std::unique_ptr<bake::CenteredModel> model_; // its address stays
    std::vector<Vec3f> object_positions_;        // empty: the same as model_->positions
    std::unique_ptr<trace::TriangleScene> scene_, object_scene_;
    Components components_;
    bake::Orientation orientation_;
    double source_radius_ = 1;
    std::uint32_t layers_ = 1;
    bool outermost_only_ = true;
    unsigned threads_ = 0;
    bake::SurfaceGrid shape_;
};

} // namespace spa::measure
