// SPDX-License-Identifier: Apache-2.0
// A model as every importer delivers it and every baker takes it: one flat triangle soup in object space,
// with node transforms applied, in rest pose. Nothing here assumes a manifold.
#pragma once

#include "../core/vector.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace spa {

// sRGB colour with straight (not premultiplied) linear alpha, rows top to bottom.
struct Image {
    std::uint32_t width = 0, height = 0;
    std::vector<std::array<std::uint8_t, 4>> pixels; // width * height
};

struct Texture {
    std::string name;        // file name or index, for messages
    std::vector<Image> mips; // level 0 first, each level half the size (at least 1) down to 1x1
};

enum class Wrap : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };
enum class AlphaMode : std::uint8_t { opaque, mask, blend };

constexpr std::uint32_t no_index = 0xFFFFFFFFu;

// Base colour = base_color * vertex colour * texture, each linear RGBA. uv (0,0) is the upper left corner of
// the image, v grows downwards (as in glTF).
struct Material {
    std::string name;
    Vec4f base_color{1, 1, 1, 1};
    std::uint32_t texture = no_index; // index into Model::textures
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    bool nearest = false; // magnification without interpolation (glTF magFilter NEAREST)
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5F; // mask: alpha < cutoff is no surface
    bool double_sided = false; // kept for reports: a baked ray never culls back faces
};

struct Triangle {
    std::array<std::uint32_t, 3> vertex{}; // counter-clockwise seen from the front
};

struct Model {
    // One entry a vertex. normals, uvs and colors are either empty or as long as positions.
    std::vector<Vec3f> positions;
    std::vector<Vec3f> normals; // unit length
    std::vector<Vec2f> uvs;     // of the base-colour texture, texture transform applied
    std::vector<Vec4f> colors;  // linear RGBA
    // One entry a triangle.
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> triangle_materials; // index into materials
    std::vector<Material> materials;               // at least one
    std::vector<Texture> textures;
};

// Builds the smaller levels of texture.mips from level 0: box filter in linear light, colour weighted by
// alpha. Odd sizes halve to floor(n/2), at least 1.
void build_mips(Texture& texture);

} // namespace spa
