// SPDX-License-Identifier: Apache-2.0
#include "shapes.h"

#include "../libspa/core/element_format.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace spa::samples {

Vec4f srgb(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
    return {srgb_to_linear(red), srgb_to_linear(green), srgb_to_linear(blue), 1};
}

Model empty_model(const std::string& material_name) {
    Model model;
    model.materials.emplace_back().name = material_name;
    return model;
}

void set_texture(Model& model, const std::string& name, Image image) {
    Texture texture;
    texture.name = name;
    texture.mips.push_back(std::move(image));
    build_mips(texture);
    model.materials.front().texture = static_cast<std::uint32_t>(model.textures.size());
    model.textures.push_back(std::move(texture));
}

std::uint32_t add_vertex(Model& model, Vec3d position, Vec4f color) {
    model.positions.push_back(to_float(position));
    model.colors.push_back(color);
    return static_cast<std::uint32_t>(model.positions.size() - 1);
}

void add_triangle(Model& model, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    model.triangles.push_back({{a, b, c}});
    model.triangle_materials.push_back(0);
}

void add_quad(Model& model, const Quad& quad) {
    add_triangle(model, quad.top_left, quad.bottom_left, quad.bottom_right);
    add_triangle(model, quad.top_left, quad.bottom_right, quad.top_right);
}

void set_smooth_normals(Model& model) {
    std::vector<Vec3d> sums(model.positions.size());
    for (const Triangle& triangle : model.triangles) {
        const auto [a, b, c] = triangle.vertex;
        const Vec3d origin = to_double(model.positions[a]);
        const Vec3d area =
            cross(to_double(model.positions[b]) - origin, to_double(model.positions[c]) - origin);
        for (const std::uint32_t corner : triangle.vertex) sums[corner] = sums[corner] + area;
    }
    model.normals.clear();
    model.normals.reserve(sums.size());
    for (const Vec3d& sum : sums) model.normals.push_back(to_float(normalize(sum)));
}

std::vector<std::uint32_t> add_ring(Model& model, double radius, double height, std::uint32_t columns,
                                    Vec4f color) {
    if (radius == 0) return std::vector<std::uint32_t>(columns, add_vertex(model, {0, height, 0}, color));
    std::vector<std::uint32_t> ring;
    ring.reserve(columns);
    for (std::uint32_t j = 0; j < columns; ++j) {
        const double phi = 2 * std::numbers::pi * j / columns;
        ring.push_back(add_vertex(model, {radius * std::sin(phi), height, radius * std::cos(phi)}, color));
    }
    return ring;
}

void join_rings(Model& model, const std::vector<std::uint32_t>& upper,
                const std::vector<std::uint32_t>& lower) {
    for (std::size_t j = 0; j < upper.size(); ++j) {
        const std::size_t next = (j + 1) % upper.size();
        if (lower[j] != lower[next]) add_triangle(model, upper[j], lower[j], lower[next]);
        if (upper[j] != upper[next]) add_triangle(model, upper[j], lower[next], upper[next]);
    }
}

IndexedMesh icosphere(int level) {
    const double g = std::numbers::phi;
    IndexedMesh mesh;
    for (const Vec3d& p : {Vec3d{0, 1, g},
                           {0, -1, g},
                           {0, 1, -g},
                           {0, -1, -g},
                           {1, g, 0},
                           {-1, g, 0},
                           {1, -g, 0},
                           {-1, -g, 0},
                           {g, 0, 1},
                           {-g, 0, 1},
                           {g, 0, -1},
                           {-g, 0, -1}})
        mesh.positions.push_back(normalize(p));
    mesh.triangles = {{{0, 1, 8}},  {{0, 8, 4}},  {{0, 4, 5}},  {{0, 5, 9}},  {{0, 9, 1}},
                      {{1, 6, 8}},  {{8, 6, 10}}, {{8, 10, 4}}, {{4, 10, 2}}, {{4, 2, 5}},
                      {{5, 2, 11}}, {{5, 11, 9}}, {{9, 11, 7}}, {{9, 7, 1}},  {{1, 7, 6}},
                      {{3, 6, 7}},  {{3, 7, 11}}, {{3, 11, 2}}, {{3, 2, 10}}, {{3, 10, 6}}};
    for (int i = 0; i < level; ++i) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [entry, is_new] =
                middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.positions.size()));
            if (is_new) mesh.positions.push_back(normalize(mesh.positions[a] + mesh.positions[b]));
            return entry->second;
        };
        std::vector<Triangle> finer;
        finer.reserve(4 * mesh.triangles.size());
        for (const Triangle& triangle : mesh.triangles) {
            const auto [a, b, c] = triangle.vertex;
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            for (const Triangle& part : {Triangle{{a, ab, ca}}, {{b, bc, ab}}, {{c, ca, bc}}, {{ab, bc, ca}}})
                finer.push_back(part);
        }
        mesh.triangles = std::move(finer);
    }
    return mesh;
}

} // namespace spa::samples
