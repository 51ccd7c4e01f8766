// SPDX-License-Identifier: Apache-2.0
// Simplified meshes of one model: what a renderer without maps would trace instead of the model.
#pragma once

#include "../core/vector.h"
#include "../mesh/model.h"

#include <functional>
#include <span>
#include <vector>

namespace spa::measure {

struct Lod {
    double target_error = 0; // what was asked for: distance in the space of the positions
    double error = 0;        // what the simplifier says it made, by its own measure
    // Without unused and repeated vertices, in an order that is good for caches.
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals; // zero where the model has a crease: several at one place
    std::vector<Triangle> triangles;
};

// One a target error, in their order: as few triangles as meshoptimizer's edge collapses (quadrics; Garland
// and Heckbert 1997) reach within it. Vertices of equal position are united first, so that neither texture
// seams nor creases hold it up: distances are what counts. Colours are not looked at.
//
// normals: one a position. target_errors: descending, > 0. A mesh of more than 300,000 triangles is first
// simplified to a sixteenth of the smallest target error, and all steps start from that: the difference
// cannot be seen in the ladder, and it takes seconds instead of a minute. Parallel in the caller's arena.
// O(triangles log triangles) a step.
std::vector<Lod> simplify(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                          std::span<const Triangle> triangles, std::span<const double> target_errors);

} // namespace spa::measure
