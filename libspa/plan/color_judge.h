// SPDX-License-Identifier: Apache-2.0
// How many texels of colour a model needs, without baking any: what bilinear reads of a colour image of some
// size would give is compared with the model's own colours at directions spread over the sphere.
#pragma once

#include "../core/spherical_map.h"
#include "../mesh/model.h"
#include "../trace/triangle_scene.h"

#include "../bake/crossings.h"

#include <cstdint>
#include <vector>

namespace spa::plan {

class ColorJudge {
public:
    // place: center, frame, radius and mapping; nothing else of it is read. footprint: half-angle in degrees,
    // seen from the centre, of the cone over which both sides are averaged before they are compared; 0:
    // none. O(triangles log(triangles)); parallel in the caller's arena. The model outlives it.
    ColorJudge(const Model& model, const Part& place, double footprint);

    // Mean |difference| of red, green and blue over the outermost surface, in codes of 255; 0 if no direction
    // meets it. cells: of the colour image. O(log(triangles)), whatever the number of cells. Deterministic.
    [[nodiscard]] double error(std::uint32_t cells) const;

private:
    Mapping mapping_;
    bake::CenteredModel centered_;
    trace::TriangleScene scene_;
    std::size_t group_ = 1;              // directions that are averaged
    std::vector<Vec3d> directions_;      // group by group
    std::vector<bake::Crossing> source_; // along each; radius 0: nothing is met
};

} // namespace spa::plan
