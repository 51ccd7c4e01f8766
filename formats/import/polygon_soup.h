// SPDX-License-Identifier: Apache-2.0
// What the OBJ, PLY, STL and OFF readers fill in: polygons whose corners index separate arrays, as these
// formats have it; and the way from there to a Model.
#pragma once

#include "import.h"
#include "readers.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace spa::import {

// Indices into the arrays of a PolygonSoup; no_index = none. The reader checks the ranges, as only it can say
// where in the file a bad index is.
struct PolygonCorner {
    std::uint32_t position = no_index;
    std::uint32_t uv = no_index;
    std::uint32_t normal = no_index;
    std::uint32_t color = no_index;
};

struct Polygon {
    std::uint32_t corners = 0; // at least 3: the next so many of PolygonSoup::corners
    std::uint32_t material = 0;
};

// The polygons from one on, up to the next run, belong to a node.
struct PolygonRun {
    std::size_t first = 0;
    std::uint32_t node = 0;
};

struct PolygonSoup {
    std::vector<Vec3f> positions; // may hold NaN and infinities, like the other arrays
    std::vector<Vec2f> uvs;       // v grows downwards, as in Model
    std::vector<Vec3f> normals;   // of any length; zero = missing
    std::vector<Vec4f> colors;    // linear
    std::vector<PolygonCorner> corners;
    std::vector<Polygon> polygons;   // by add_polygon
    std::uint64_t triangles = 0;     // that the polygons make
    std::vector<PolygonRun> runs;    // in the order of the polygons; empty where nobody asks for nodes
    std::vector<Material> materials; // at least one
    std::vector<Texture> textures;
};

// A colour value as a text format states it, sRGB in [0,1], made linear. Values outside are clamped; NaN
// stays NaN.
float display_to_linear(float value);

// The same for red, green and blue; alpha is linear already and only clamped.
Vec4f display_to_linear(Vec4f color);

// Throw Error(invalid_data) if a model cannot hold as many; readers ask before they grow an array.
void check_vertex_count(std::uint64_t count, const std::filesystem::path& path, const Limits& limits);
void check_triangle_count(std::uint64_t count, const std::filesystem::path& path, const Limits& limits);

// Appends a polygon, whose corners are the last ones, unless that makes too many triangles.
void add_polygon(PolygonSoup& soup, const Polygon& polygon, const std::filesystem::path& path,
                 const Limits& limits);

// Cuts the polygons into triangles, drops and counts those with a NaN or infinite corner and those without
// area, makes one vertex of equal corners, normalises the normals and computes the missing ones. Vertices are
// ordered by position, then uv, normal and colour index; triangles keep the order of the file. Warns in
// `report` of what was dropped or repaired. Throws Error(invalid_data) when nothing is left or a limit is
// exceeded. O(n log n) time, linear memory. `triangle_nodes`, if given, gets the node of each triangle by the
// runs, of which the first begins with the first polygon.
Model to_model(PolygonSoup soup, const std::filesystem::path& path, const Limits& limits, Report& report,
               std::vector<std::uint32_t>* triangle_nodes = nullptr);

} // namespace spa::import
