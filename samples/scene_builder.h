// SPDX-License-Identifier: Apache-2.0
// What the scenes are put together with. Internal to this folder.
#pragma once

#include "../libspa/mesh/scene.h"

#include <cstdint>
#include <span>
#include <string>

namespace spa::samples {

Mat3 turn_x(double degrees); // +Y towards +Z
Mat3 turn_y(double degrees); // +Z towards +X
Mat3 turn_z(double degrees); // +X towards +Y

class SceneBuilder {
public:
    // A node that draws `mesh`, which is in its local space and has materials of its own; one of the name of
    // an earlier one is the earlier one. Returns the node.
    std::uint32_t add(const std::string& name, const Affine& to_world, const Model& mesh,
                      std::uint32_t parent = no_index);
    // A node without a mesh.
    std::uint32_t add_group(const std::string& name);

    // The boot, turned, standing at the height place.y with its origin above or below that.
    void add_boot(int level, const Mat3& turn, Vec3d place);

    void add_camera(const std::string& name, Vec3d eye, Vec3d target, double vertical_degrees);
    void add_point_light(const std::string& name, Vec3d position, float watts_per_steradian);

    Scene take() { return std::move(scene_); }

private:
    Scene scene_;
};

// Plaster of albedo 0.8 and stone of a warmer tone.
Material white();
Material stone();

// A box with sharp edges, faces outwards.
Model make_box(Vec3d low, Vec3d high, const Material& material);

// A point of an outline in the half plane through the Y axis.
struct OutlinePoint {
    double radius, height;
    bool sharp = false; // an edge runs round here
};
// The outline turned about the Y axis, from top to bottom, closed if it begins and ends on the axis.
Model make_turned(std::span<const OutlinePoint> outline, std::uint32_t columns, const Material& material);

// A block from -half_width to half_width in x, 0 to height in y, -half_depth to half_depth in z, with a round
// arch of this radius cut out from below.
struct Arch {
    double half_width, height, half_depth, radius;
};
Model make_arch(const Arch& arch, std::uint32_t segments, const Material& material);

// `more` becomes part of `model`; both have one material, that of `model` counts.
void append(Model& model, const Model& more, Vec3d offset = {});

} // namespace spa::samples
