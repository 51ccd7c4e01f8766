// SPDX-License-Identifier: Apache-2.0
// What stands around the boot.
#include "scene_builder.h"
#include "shapes.h"

#include <cmath>
#include <numbers>

namespace spa::samples {
namespace {

Model empty_mesh(const Material& material) {
    Model model;
    model.materials.push_back(material);
    return model;
}

// A vertex for a face with this normal.
std::uint32_t add_corner(Model& model, Vec3d position, Vec3d normal) {
    model.positions.push_back(to_float(position));
    model.normals.push_back(to_float(normal));
    return static_cast<std::uint32_t>(model.positions.size() - 1);
}

// A flat face with vertices of its own; corners as seen from the front.
void add_face(Model& model, Vec3d top_left, Vec3d top_right, Vec3d bottom_left, Vec3d bottom_right) {
    const Vec3d normal = normalize(cross(bottom_right - top_left, top_right - bottom_left));
    add_quad(model, {add_corner(model, top_left, normal), add_corner(model, top_right, normal),
                     add_corner(model, bottom_left, normal), add_corner(model, bottom_right, normal)});
}

} // namespace

void append(Model& model, const Model& more, Vec3d offset) {
    const auto first = static_cast<std::uint32_t>(model.positions.size());
    for (const Vec3f& p : more.positions) model.positions.push_back(to_float(to_double(p) + offset));
    model.normals.insert(model.normals.end(), more.normals.begin(), more.normals.end());
    for (const Triangle& triangle : more.triangles) {
        const auto [a, b, c] = triangle.vertex;
        add_triangle(model, a + first, b + first, c + first);
    }
}

Model make_box(Vec3d low, Vec3d high, const Material& material) {
    Model model = empty_mesh(material);
    const auto p = [&](int x, int y, int z) {
        return Vec3d{x == 0 ? low.x : high.x, y == 0 ? low.y : high.y, z == 0 ? low.z : high.z};
    };
    add_face(model, p(0, 1, 1), p(1, 1, 1), p(0, 0, 1), p(1, 0, 1)); // +Z
    add_face(model, p(1, 1, 0), p(0, 1, 0), p(1, 0, 0), p(0, 0, 0)); // -Z
    add_face(model, p(1, 1, 1), p(1, 1, 0), p(1, 0, 1), p(1, 0, 0)); // +X
    add_face(model, p(0, 1, 0), p(0, 1, 1), p(0, 0, 0), p(0, 0, 1)); // -X
    add_face(model, p(0, 1, 0), p(1, 1, 0), p(0, 1, 1), p(1, 1, 1)); // +Y
    add_face(model, p(0, 0, 1), p(1, 0, 1), p(0, 0, 0), p(1, 0, 0)); // -Y
    return model;
}

Model make_turned(std::span<const OutlinePoint> outline, std::uint32_t columns, const Material& material) {
    Model model = empty_mesh(material);
    constexpr Vec4f no_color{1, 1, 1, 1};
    std::vector<std::uint32_t> upper;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const auto [radius, height, sharp] = outline[i];
        const std::vector<std::uint32_t> ring = add_ring(model, radius, height, columns, no_color);
        if (i > 0) join_rings(model, upper, ring);
        // At an edge the surface goes on from a ring of its own.
        upper = sharp ? add_ring(model, radius, height, columns, no_color) : ring;
    }
    model.colors.clear();
    set_smooth_normals(model);
    return model;
}

Model make_arch(const Arch& arch, std::uint32_t segments, const Material& material) {
    Model model = empty_mesh(material);
    const double w = arch.half_width, h = arch.height, d = arch.half_depth, r = arch.radius;
    // From the left foot of the arch over its crown to the right one; above each point one of the upper edge.
    std::vector<Vec3d> below, above;
    for (std::uint32_t i = 0; i <= segments; ++i) {
        const double angle = std::numbers::pi * (1 - double(i) / segments);
        // The feet exactly, so that faces meet in bit-equal positions.
        const bool foot = i == 0 || i == segments;
        const double x = i == 0 ? -r : i == segments ? r : r * std::cos(angle);
        below.push_back({x, foot ? 0 : r * std::sin(angle), 0});
        above.push_back({x, h, 0});
    }
    const auto at = [](Vec3d p, double z) { return Vec3d{p.x, p.y, z}; };
    const Vec3d left_top{-w, h, 0}, left_foot{-w, 0, 0}, right_top{w, h, 0}, right_foot{w, 0, 0};
    const auto add_front_and_back = [&](Vec3d a, Vec3d b, Vec3d c, Vec3d e) {
        add_face(model, at(a, d), at(b, d), at(c, d), at(e, d));
        add_face(model, at(b, -d), at(a, -d), at(e, -d), at(c, -d));
    };
    const auto add_top = [&](Vec3d a, Vec3d b) { add_face(model, at(a, -d), at(b, -d), at(a, d), at(b, d)); };
    add_front_and_back(left_top, above.front(), left_foot, below.front());
    add_top(left_top, above.front());
    for (std::uint32_t i = 0; i < segments; ++i) {
        add_front_and_back(above[i], above[i + 1], below[i], below[i + 1]);
        add_top(above[i], above[i + 1]);
    }
    add_front_and_back(above.back(), right_top, below.back(), right_foot);
    add_top(above.back(), right_top);
    add_face(model, at(left_top, -d), at(left_top, d), at(left_foot, -d), at(left_foot, d));
    add_face(model, at(right_top, d), at(right_top, -d), at(right_foot, d), at(right_foot, -d));
    add_face(model, at(left_foot, d), at(below.front(), d), at(left_foot, -d), at(below.front(), -d));
    add_face(model, at(below.back(), d), at(right_foot, d), at(below.back(), -d), at(right_foot, -d));

    // The inner side, smooth: normals towards the middle.
    std::vector<std::uint32_t> front, back;
    for (const Vec3d& p : below) {
        front.push_back(add_corner(model, at(p, d), normalize(-p)));
        back.push_back(add_corner(model, at(p, -d), normalize(-p)));
    }
    for (std::uint32_t i = 0; i < segments; ++i)
        add_quad(model, {front[i], front[i + 1], back[i], back[i + 1]});
    return model;
}

} // namespace spa::samples
