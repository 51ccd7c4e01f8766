// SPDX-License-Identifier: Apache-2.0
// Where the sphere of a part stands: its centre, its frame and its radius. Everything is parallel in the
// caller's arena; results do not depend on it.
#pragma once

#include "model.h"

#include "../core/vector.h"

namespace spa {

// p = center + frame * q, |q| <= radius for every vertex of every triangle; determinant(frame) > 0.
struct PartFrame {
    Vec3d center;
    Mat3 frame;
    double radius = 1;
};

struct Axes {
    Vec3d axis[3];    // orthonormal, right-handed; axis[0] along the largest extent
    Vec3d center;     // of the box
    double extent[3]; // half sizes along the axes, largest first
};

// The smaller (by volume) of the axis-aligned box and the box along the principal axes of the surface; the
// axis-aligned one unless the other is at least 5 % smaller. Vertices that no triangle uses do not count.
// O(triangles).
Axes oriented_bounds(const Model& model);

// The centre of the axis-aligned bounding box. A flat object (thinnest oriented extent below 1 % of the
// widest) would be seen edge-on from there, so the centre is moved behind it, by half its largest half size
// against its mean normal; `moved_off_surface` tells. O(triangles).
Vec3d bounds_center(const Model& model, bool& moved_off_surface);

// The linear map that makes the box a cube of its largest side (of a flat object: only its two wide axes are
// normalised). The identity for a box of zero size.
Mat3 affine_frame(const Axes& box);

// The frame around a given centre. Throws Error{invalid_data} for a model of zero size. O(triangles).
PartFrame make_part_frame(const Model& model, Vec3d center, const Mat3& frame);
// affine: affine_frame of the oriented bounding box; else the identity.
PartFrame make_part_frame(const Model& model, Vec3d center, bool affine);

} // namespace spa
