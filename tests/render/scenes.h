// SPDX-License-Identifier: Apache-2.0
// Small scenes.
#pragma once

#include "../../libspa/mesh/scene.h"

#include <string>

namespace spa::test {

std::uint32_t add_node(Scene& scene, const std::string& name, const Affine& to_world = {},
                       std::uint32_t parent = no_index);

// The model, with its materials and textures, as what a node draws. The scene has normals, uvs and colours
// from then on.
void add_model(Scene& scene, std::uint32_t node, const Model& model);

// A square about `center` with edges 2 a and 2 b, without normals of its own.
Model square(Vec3f center, Vec3f a, Vec3f b, Vec4f color);

Light point_light(Vec3d position, Vec3f intensity);

// With +Y up, which `to - from` is not parallel to.
Camera camera_at(Vec3d from, Vec3d to, double vertical_fov);

// Two walls and a floor about the origin, the floor at y = -1.
void add_room(Scene& scene);

} // namespace spa::test
