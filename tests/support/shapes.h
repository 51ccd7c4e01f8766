// SPDX-License-Identifier: Apache-2.0
// Small models made in the tests, with one plain material, normals and no textures.
#pragma once

#include "../../libspa/mesh/model.h"

#include <cstdint>

namespace spa::test {

// Appends a quad a b c d (counter-clockwise from the front) as two triangles with its own four vertices.
void add_quad(Model& model, Vec3f a, Vec3f b, Vec3f c, Vec3f d);

// Appends a closed uv sphere with `rings` latitude bands, faces outwards (inwards if `inside_out`).
void add_sphere(Model& model, Vec3f center, float radius, std::uint32_t rings, bool inside_out = false);

// An axis-aligned box, faces outwards.
void add_box(Model& model, Vec3f low, Vec3f high);

// A torus around +Y.
void add_torus(Model& model, float major, float minor, std::uint32_t segments);

// An empty model with one white opaque material.
Model empty_model();

// `count` random triangles in the cube [-1,1]^3, of any size and facing.
Model random_soup(std::uint32_t count, std::uint32_t seed);

// Gives every vertex random uv and the model's material a random texture of the given size, mips built.
void add_random_texture(Model& model, std::uint32_t size, std::uint32_t seed);

} // namespace spa::test
