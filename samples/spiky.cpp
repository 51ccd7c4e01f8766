// SPDX-License-Identifier: Apache-2.0
#include "shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace spa::samples {
namespace {

constexpr double body_radius = 0.45;
constexpr std::uint32_t needle_count = 42; // on the vertices of the icosphere of level 1

struct Needle {
    double base;   // radius of the foot on the unit sphere, radians
    double height; // distance of the tip from the centre
    Vec4f color;
};

// Thick, thin and hair-like. At 256 octahedral cells a texel is about 0.01 rad: the thin ones sink below it
// on the way to the tip, the hair ones are narrower than it from the foot on.
Needle needle_of(std::uint32_t vertex) {
    if (vertex < 12) return {0.09, 1.0, srgb(225, 60, 40)};
    if (vertex % 2 == 0) return {0.025, 0.85, srgb(240, 200, 40)};
    return {0.0025, 0.95, srgb(60, 200, 90)};
}

class Builder {
public:
    Model build(int level) && {
        for (const Triangle& triangle : sphere_.triangles) add_body(triangle);
        for (const Triangle& triangle : sphere_.triangles) {
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t vertex = triangle.vertex.at(i);
                if (vertex < needle_count)
                    add_needle_side(vertex, triangle.vertex.at((i + 1) % 3), triangle.vertex.at((i + 2) % 3));
            }
        }
        for (int i = 0; i < level; ++i) split_triangles();
        set_smooth_normals(model_);
        return std::move(model_);
    }

private:
    // Where the edge from a needle's vertex to a neighbour leaves the needle's foot.
    Vec3d foot(std::uint32_t vertex, std::uint32_t neighbour) const {
        const Vec3d axis = sphere_.positions[vertex];
        const Vec3d towards = sphere_.positions[neighbour];
        const Vec3d tangent = normalize(towards - axis * dot(towards, axis));
        const double base = needle_of(vertex).base;
        return (axis * std::cos(base) + tangent * std::sin(base)) * body_radius;
    }

    // Vertices are found again under a key: a vertex of the sphere twice, or a needle's vertex and the
    // neighbour that its foot points to. The needles repeat those of the body along the foot: it is a crease.
    using Keys = std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>;
    std::uint32_t vertex_at(Keys& keys, std::pair<std::uint32_t, std::uint32_t> key, Vec3d position,
                            Vec4f color, bool on_body) {
        const auto [entry, is_new] = keys.try_emplace(key, 0);
        if (is_new) {
            entry->second = add_vertex(model_, position, color);
            on_body_.push_back(on_body);
        }
        return entry->second;
    }

    std::uint32_t body_foot(std::uint32_t vertex, std::uint32_t neighbour) {
        return vertex_at(body_, {vertex, neighbour}, foot(vertex, neighbour), body_color_, true);
    }
    std::uint32_t needle_foot(std::uint32_t vertex, std::uint32_t neighbour) {
        return vertex_at(needle_, {vertex, neighbour}, foot(vertex, neighbour), needle_of(vertex).color,
                         true);
    }

    // A triangle of the sphere less the corners that needles stand on: a convex polygon.
    void add_body(const Triangle& triangle) {
        std::vector<std::uint32_t> polygon;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t vertex = triangle.vertex.at(i);
            if (vertex >= needle_count) {
                const Vec3d position = sphere_.positions[vertex] * body_radius;
                polygon.push_back(vertex_at(body_, {vertex, vertex}, position, body_color_, true));
            } else {
                polygon.push_back(body_foot(vertex, triangle.vertex.at((i + 2) % 3)));
                polygon.push_back(body_foot(vertex, triangle.vertex.at((i + 1) % 3)));
            }
        }
        for (std::size_t i = 2; i < polygon.size(); ++i)
            add_triangle(model_, polygon[0], polygon[i - 1], polygon[i]);
    }

    void add_needle_side(std::uint32_t vertex, std::uint32_t next, std::uint32_t previous) {
        const Needle needle = needle_of(vertex);
        const Vec3d position = sphere_.positions[vertex] * needle.height;
        const std::uint32_t tip = vertex_at(needle_, {vertex, vertex}, position, needle.color, false);
        add_triangle(model_, tip, needle_foot(vertex, next), needle_foot(vertex, previous));
    }

    // The middle of an edge that lies on the body moves out onto the sphere.
    std::uint32_t middle(Keys& middles, std::uint32_t a, std::uint32_t b) {
        const bool on_body = on_body_[a] && on_body_[b];
        // The sum is the same from both sides of the edge, also where a crease repeats its ends.
        Vec3d position = (to_double(model_.positions[a]) + to_double(model_.positions[b])) * 0.5;
        if (on_body) position = normalize(position) * body_radius;
        return vertex_at(middles, std::minmax(a, b), position, model_.colors[a], on_body);
    }

    void split_triangles() {
        const std::vector<Triangle> coarse = std::exchange(model_.triangles, {});
        model_.triangle_materials.clear();
        Keys middles;
        for (const Triangle& triangle : coarse) {
            const auto [a, b, c] = triangle.vertex;
            const std::uint32_t ab = middle(middles, a, b), bc = middle(middles, b, c),
                                ca = middle(middles, c, a);
            add_triangle(model_, a, ab, ca);
            add_triangle(model_, b, bc, ab);
            add_triangle(model_, c, ca, bc);
            add_triangle(model_, ab, bc, ca);
        }
    }

    // Level 2 is the coarsest on which no two needles are neighbours.
    const IndexedMesh sphere_ = icosphere(2);
    const Vec4f body_color_ = srgb(110, 125, 150);
    Model model_ = empty_model("needles");
    std::vector<bool> on_body_; // one entry a vertex
    Keys body_, needle_;
};

} // namespace

Model make_spiky(int level) { return Builder().build(level); }

} // namespace spa::samples
