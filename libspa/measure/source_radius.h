// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../mesh/model.h"

namespace spa::measure {

// The distance of the model's farthest vertex in use from `center` (object space), in units of the space that
// `frame` leads out of (spherical_map.h, Part::frame): R, if the part was baked from this model. Throws
// Error{invalid_data} for a model of zero size. O(triangles).
double radius_about(const Model& model, Vec3d center, const Mat3& frame);

} // namespace spa::measure
