// SPDX-License-Identifier: Apache-2.0
#include "polygon_soup.h"

#include "../../libspa/mesh/normals.h"
#include "polygon.h"
#include "text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>

namespace spa::import {
namespace {

// Model indices are 32 bits wide, and computing normals can give every corner a vertex of its own.
constexpr std::uint64_t most_triangles = (std::uint64_t{no_index} - 1) / 3;

std::string count_of(std::uint64_t count, const char* singular) {
    return std::to_string(count) + " " + singular + (count == 1 ? "" : "s");
}

// Three indices into PolygonSoup::corners.
using CornerTriangle = std::array<std::uint32_t, 3>;

struct Cut {
    std::vector<CornerTriangle> triangles;
    std::vector<std::uint32_t> materials;
    std::vector<std::size_t> run_ends; // how many triangles there are when each run ends
    std::uint64_t crossing_polygons = 0;
};

bool has_area(const PolygonSoup& soup, const CornerTriangle& triangle) {
    const auto position = [&](unsigned k) {
        return to_double(soup.positions[soup.corners[triangle[k]].position]);
    };
    return !(cross(position(1) - position(0), position(2) - position(0)) == Vec3d{});
}

Cut cut_polygons(const PolygonSoup& soup, Report& report) {
    Cut cut;
    cut.triangles.reserve(soup.polygons.size());
    cut.materials.reserve(soup.polygons.size());
    std::vector<Vec3f> points;
    std::vector<std::array<std::uint32_t, 3>> pieces;
    std::size_t first = 0;
    for (const Polygon& polygon : soup.polygons) {
        const auto number = static_cast<std::size_t>(&polygon - soup.polygons.data());
        if (cut.run_ends.size() + 1 < soup.runs.size() && number == soup.runs[cut.run_ends.size() + 1].first)
            cut.run_ends.push_back(cut.triangles.size());
        points.clear();
        for (std::size_t c = first; c < first + polygon.corners; ++c)
            points.push_back(soup.positions[soup.corners[c].position]);
        if (std::all_of(points.begin(), points.end(), is_finite<float>)) {
            pieces.clear();
            if (!triangulate_polygon(points, pieces)) ++cut.crossing_polygons;
            for (const auto& piece : pieces) {
                const CornerTriangle triangle{std::uint32_t(first + piece[0]),
                                              std::uint32_t(first + piece[1]),
                                              std::uint32_t(first + piece[2])};
                if (has_area(soup, triangle)) {
                    cut.triangles.push_back(triangle);
                    cut.materials.push_back(polygon.material);
                } else {
                    ++report.dropped_degenerate;
                }
            }
        } else {
            report.dropped_non_finite += polygon.corners - 2;
        }
        first += polygon.corners;
    }
    cut.run_ends.push_back(cut.triangles.size());
    return cut;
}

// Corners sorted by what they refer to: in buckets by position, then within each bucket.
std::vector<std::uint32_t> sort_corners(const PolygonSoup& soup, const Cut& cut) {
    std::vector<std::uint32_t> begin(soup.positions.size() + 1, 0);
    for (const CornerTriangle& triangle : cut.triangles)
        for (const std::uint32_t c : triangle) ++begin[soup.corners[c].position + 1];
    for (std::size_t p = 1; p < begin.size(); ++p) begin[p] += begin[p - 1];
    std::vector<std::uint32_t> sorted(begin.back());
    std::vector<std::uint32_t> end(begin.begin(), begin.end() - 1);
    for (const CornerTriangle& triangle : cut.triangles)
        for (const std::uint32_t c : triangle) sorted[end[soup.corners[c].position]++] = c;
    const auto less = [&](std::uint32_t a, std::uint32_t b) {
        const PolygonCorner& x = soup.corners[a];
        const PolygonCorner& y = soup.corners[b];
        return std::tie(x.uv, x.normal, x.color, a) < std::tie(y.uv, y.normal, y.color, b);
    };
    for (std::size_t p = 0; p + 1 < begin.size(); ++p)
        std::sort(sorted.begin() + begin[p], sorted.begin() + begin[p + 1], less);
    return sorted;
}

struct Repairs {
    std::uint64_t colors = 0, uvs = 0;
};

void append_vertex(Model& model, const PolygonSoup& soup, const PolygonCorner& corner, Repairs& repairs) {
    model.positions.push_back(soup.positions[corner.position]);
    if (!soup.normals.empty()) {
        const Vec3f normal = corner.normal == no_index ? Vec3f{} : soup.normals[corner.normal];
        model.normals.push_back(is_finite(normal) ? to_float(normalize(to_double(normal))) : Vec3f{});
    }
    if (!soup.uvs.empty()) {
        Vec2f uv = corner.uv == no_index ? Vec2f{} : soup.uvs[corner.uv];
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
            uv = {};
            ++repairs.uvs;
        }
        model.uvs.push_back(uv);
    }
    if (!soup.colors.empty()) {
        Vec4f color = corner.color == no_index ? Vec4f{1, 1, 1, 1} : soup.colors[corner.color];
        if (std::isnan(color.x + color.y + color.z + color.w)) {
            color = {1, 1, 1, 1};
            ++repairs.colors;
        }
        model.colors.push_back(color);
    }
}

bool is_same_vertex(const PolygonCorner& a, const PolygonCorner& b) {
    return a.position == b.position && a.uv == b.uv && a.normal == b.normal && a.color == b.color;
}

// Fills in the vertices and the triangles' indices.
Repairs index_vertices(Model& model, const PolygonSoup& soup, const Cut& cut) {
    Repairs repairs;
    const std::vector<std::uint32_t> sorted = sort_corners(soup, cut);
    std::vector<std::uint32_t> vertex_of_corner(soup.corners.size(), no_index);
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        const PolygonCorner& corner = soup.corners[sorted[i]];
        if (i == 0 || !is_same_vertex(corner, soup.corners[sorted[i - 1]]))
            append_vertex(model, soup, corner, repairs);
        vertex_of_corner[sorted[i]] = std::uint32_t(model.positions.size() - 1);
    }
    model.triangles.reserve(cut.triangles.size());
    for (const CornerTriangle& t : cut.triangles)
        model.triangles.push_back({{vertex_of_corner[t[0]], vertex_of_corner[t[1]], vertex_of_corner[t[2]]}});
    return repairs;
}

void check_bytes(const Model& model, const std::vector<Texture>& textures, const std::filesystem::path& path,
                 const Limits& limits) {
    std::uint64_t bytes = model.positions.size() * vertex_bytes + model.triangles.size() * triangle_bytes;
    for (const Texture& texture : textures)
        for (const Image& image : texture.mips) bytes += image.pixels.size() * sizeof image.pixels[0];
    if (bytes > limits.model_bytes)
        fail(path, "makes a model of " + std::to_string(bytes) + " bytes, more than the limit of " +
                       std::to_string(limits.model_bytes) + "; simplify the mesh");
}

void warn_of(const Cut& cut, const Repairs& repairs, Report& report) {
    if (report.dropped_non_finite > 0)
        warn(report, "Dropped " + count_of(report.dropped_non_finite, "triangle") +
                         " of faces with a corner that is not a finite number.");
    if (cut.crossing_polygons > 0)
        warn(report, count_of(cut.crossing_polygons, "polygon") +
                         " with edges that cross each other or without area: cut into triangles that "
                         "may overlap.");
    if (repairs.colors > 0)
        warn(report, count_of(repairs.colors, "vertex colour") + " not a number: white instead.");
    if (repairs.uvs > 0)
        warn(report, count_of(repairs.uvs, "texture coordinate") + " not finite: (0, 0) instead.");
}

} // namespace

float display_to_linear(float value) {
    if (std::isnan(value)) return value;
    const double s = std::clamp(double(value), 0.0, 1.0);
    return float(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4)); // IEC 61966-2-1
}

Vec4f display_to_linear(Vec4f color) {
    return {display_to_linear(color.x), display_to_linear(color.y), display_to_linear(color.z),
            std::isnan(color.w) ? color.w : std::clamp(color.w, 0.0F, 1.0F)};
}

void check_vertex_count(std::uint64_t count, const std::filesystem::path& path, const Limits& limits) {
    const std::uint64_t most =
        std::min({limits.vertices, std::uint64_t{no_index} - 1, limits.model_bytes / vertex_bytes});
    if (count > most)
        fail(path, "has more than the " + std::to_string(most) +
                       " vertices allowed; simplify the mesh or raise the limit");
}

void check_triangle_count(std::uint64_t count, const std::filesystem::path& path, const Limits& limits) {
    const std::uint64_t most =
        std::min({limits.triangles, most_triangles, limits.model_bytes / triangle_bytes});
    if (count > most)
        fail(path, "has more than the " + std::to_string(most) +
                       " triangles allowed; simplify the mesh or raise the limit");
}

void add_polygon(PolygonSoup& soup, const Polygon& polygon, const std::filesystem::path& path,
                 const Limits& limits) {
    soup.triangles += polygon.corners - 2;
    check_triangle_count(soup.triangles, path, limits);
    soup.polygons.push_back(polygon);
}

Model to_model(PolygonSoup soup, const std::filesystem::path& path, const Limits& limits, Report& report,
               std::vector<std::uint32_t>* triangle_nodes) {
    Cut cut = cut_polygons(soup, report);
    if (cut.triangles.empty()) {
        std::string what = "nothing to bake: ";
        if (report.dropped_degenerate + report.dropped_non_finite == 0) {
            what += "the file holds no faces";
            if (report.ignored_primitives > 0)
                what += ", only " + count_of(report.ignored_primitives, "point or line element");
        } else {
            what += "all faces lack area or have a corner that is not a finite number (" +
                    count_of(report.dropped_degenerate, "triangle") + " without area, " +
                    std::to_string(report.dropped_non_finite) + " not finite)";
        }
        fail(path, what + "; give a mesh with triangles or polygons");
    }
    Model model;
    const Repairs repairs = index_vertices(model, soup, cut);
    check_vertex_count(model.positions.size(), path, limits);
    check_bytes(model, soup.textures, path, limits);
    warn_of(cut, repairs, report);
    model.triangle_materials = std::move(cut.materials);
    if (triangle_nodes != nullptr)
        for (std::size_t run = 0; run < soup.runs.size(); ++run)
            triangle_nodes->resize(cut.run_ends[run], soup.runs[run].node);
    model.materials = std::move(soup.materials);
    model.textures = std::move(soup.textures);
    report.computed_normals =
        std::find(model.normals.begin(), model.normals.end(), Vec3f{}) != model.normals.end() ||
        model.normals.empty();
    soup = {}; // what follows takes as much memory again
    compute_normals(model);
    return model;
}

} // namespace spa::import
