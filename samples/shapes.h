// SPDX-License-Identifier: Apache-2.0
// What the samples are made from. Internal to this folder. level: 0..max_level.
#pragma once

#include "../libspa/mesh/model.h"

#include <cstdint>
#include <string>
#include <vector>

namespace spa::samples {

Model make_boot(int level);
Model make_sphere(int level);
Model make_torus(int level);
Model make_cube(int level);
Model make_spiky(int level);
Model make_cliff(int level);
Model make_concave(int level);
Model make_smooth(int level);

// Opaque linear colour of an sRGB triple.
Vec4f srgb(std::uint8_t red, std::uint8_t green, std::uint8_t blue);

// A model without geometry and with one white, one-sided, opaque material of this name.
Model empty_model(const std::string& material_name);

// Gives the only material this texture (mips are built here).
void set_texture(Model& model, const std::string& name, Image image);

// Appends a vertex and returns its index.
std::uint32_t add_vertex(Model& model, Vec3d position, Vec4f color);

// Appends a triangle of material 0.
void add_triangle(Model& model, std::uint32_t a, std::uint32_t b, std::uint32_t c);

// Appends two triangles. Corners as seen from the front.
struct Quad {
    std::uint32_t top_left, top_right, bottom_left, bottom_right;
};
void add_quad(Model& model, const Quad& quad);

// Sets the normals to the area-weighted mean of the triangles around each vertex. Creases are where
// vertices are repeated.
void set_smooth_normals(Model& model);

// Appends a vertex at (x, y, z) = (radius sin phi, height, radius cos phi) for every phi = 2 pi j/columns and
// returns the indices; a row on the axis (radius 0) is one vertex, repeated in the result.
std::vector<std::uint32_t> add_ring(Model& model, double radius, double height, std::uint32_t columns,
                                    Vec4f color);
// Joins two rings of equal length; `upper` is seen above `lower` from the front. Triangles that shrink to an
// edge on the axis are left out.
void join_rings(Model& model, const std::vector<std::uint32_t>& upper,
                const std::vector<std::uint32_t>& lower);

// The unit sphere as an icosahedron whose triangles were split in four `level` times. The vertices of each
// level come first in the next: 12, 42, 162, ...
struct IndexedMesh {
    std::vector<Vec3d> positions;
    std::vector<Triangle> triangles;
};
IndexedMesh icosphere(int level);

} // namespace spa::samples
