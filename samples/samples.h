// SPDX-License-Identifier: Apache-2.0
// Models made by code: something to bake without any asset at hand, each with a property that is hard for a
// spherical map.
//
// All are right-handed, +Y up, +Z to the front, metres (boot) or about 1 unit in radius (the others), with
// counter-clockwise front faces and unit normals. Every one except the boot is watertight once vertices of
// bit-equal position are welded: creases and texture seams repeat vertices.
//
//   spa::Model model = spa::samples::make_sample("boot", 4);
//   spa::samples::write_glb(model, "boot.glb");
#pragma once

#include "../libspa/mesh/model.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace spa::samples {

constexpr int max_level = 6;

struct Sample {
    std::string_view name;
    std::string_view description; // one sentence
    int default_level;            // 0..max_level
};

// All samples, in the order to show them in.
//   boot     a boot, open at the top, half orange and half blue; Loop subdivision of one base mesh (Loop
//            1987), level 0..6: 334, 1317, 5233, 20865, 83329, 333057, 1331713 vertices, none repeated
//   sphere   radius 1 about the origin; the colour tells the direction
//   torus    radii 1 and 0.4 about the Y axis, textured
//   cube     edge 1.2, sharp edges, one colour a face
//   spiky    a ball with 42 needles, many of them thinner than a texel
//   cliff    a star-shaped body whose radius jumps by 40 % over 0.01 rad
//   concave  a bowl around a ring wall around a ball on a stem: up to five crossings a direction
//   smooth   a star-shaped ball with gentle bumps of 15 % of its radius and exact normals; level 0..6: 326,
//            1298, 5186, 20738, 82946, 331778, 1327106 vertices, none repeated
// Each level has about four times the triangles of the one below (cliff: from level 3 on).
std::span<const Sample> list();

// nullptr if there is no such sample.
const Sample* find_sample(std::string_view name);

// Throws Error(usage) for an unknown name or a level outside 0..max_level. Deterministic; time and memory
// linear in the number of triangles (boot, level 6: 2.7 million).
Model make_sample(std::string_view name, int level);

// The model as a binary glTF 2.0 file: one mesh with one primitive a material, textures embedded as PNG,
// vertex colours as floats, material names, wrap modes, filters, alpha modes and sidedness kept. Same model,
// same bytes. Throws Error(internal) if the model breaks the rules of model.h or a texture cannot be
// encoded, Error(unsupported) if the file would reach 4 GiB.
std::vector<std::byte> to_glb(const Model& model);

// Writes to_glb(model) under a temporary name beside `path` and renames. Throws Error(input_output), with
// nothing left behind, and what to_glb throws.
void write_glb(const Model& model, const std::filesystem::path& path);

} // namespace spa::samples
