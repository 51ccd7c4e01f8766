// SPDX-License-Identifier: Apache-2.0
#include "normals.h"

#include "weld.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

namespace spa {
namespace {

// A corner is 3 * triangle + k.
using Corner = std::size_t;

Corner next_corner(Corner c) { return c % 3 == 2 ? c - 2 : c + 1; }
Corner previous_corner(Corner c) { return c % 3 == 0 ? c + 2 : c - 1; }
std::uint32_t vertex_of(const Model& model, Corner c) { return model.triangles[c / 3].vertex[c % 3]; }
Vec3d position_of(const Model& model, Corner c) { return to_double(model.positions[vertex_of(model, c)]); }

// Corners that share a normal; the representative is the smallest, so results do not depend on the order.
class CornerGroups {
public:
    explicit CornerGroups(std::size_t count) {
        parent_.resize(count); // not parent_(count): GCC 12 warns of a write out of bounds that is not there
        std::iota(parent_.begin(), parent_.end(), Corner{0});
    }
    Corner find(Corner c) {
        while (parent_[c] != c) {
            parent_[c] = parent_[parent_[c]];
            c = parent_[c];
        }
        return c;
    }
    void unite(Corner a, Corner b) {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<Corner> parent_;
};

// The edge from a corner to the next one, between welded vertices.
struct Edge {
    std::uint32_t low, high;
    Corner corner;
    bool rising; // the corner is at `low`
};

std::vector<Edge> sorted_edges(const Model& model) {
    const std::vector<std::uint32_t> welded = weld_positions(model.positions);
    std::vector<Edge> edges;
    edges.reserve(model.triangles.size() * 3);
    for (Corner c = 0; c < model.triangles.size() * 3; ++c) {
        const std::uint32_t a = welded[vertex_of(model, c)];
        const std::uint32_t b = welded[vertex_of(model, next_corner(c))];
        if (a != b) edges.push_back({std::min(a, b), std::max(a, b), c, a < b});
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
    });
    return edges;
}

std::vector<Vec3d> face_normals(const Model& model) {
    std::vector<Vec3d> normals(model.triangles.size());
    for (std::size_t t = 0; t < normals.size(); ++t) {
        const Vec3d a = position_of(model, 3 * t);
        normals[t] = normalize(cross(position_of(model, 3 * t + 1) - a, position_of(model, 3 * t + 2) - a));
    }
    return normals;
}

CornerGroups group_corners(const Model& model, const std::vector<Vec3d>& normals,
                           double crease_angle_degrees) {
    constexpr std::size_t most_compared = 16;
    const double least_cosine =
        std::cos(std::clamp(crease_angle_degrees, 0.0, 180.0) * std::numbers::pi / 180);
    CornerGroups groups(model.triangles.size() * 3);
    const std::vector<Edge> edges = sorted_edges(model);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Edge& edge = edges[i];
        for (std::size_t j = i; j-- > 0 && i - j <= most_compared;) {
            const Edge& other = edges[j];
            if (other.low != edge.low || other.high != edge.high) break;
            const Vec3d a = normals[edge.corner / 3];
            const Vec3d b = normals[other.corner / 3];
            // A rounding error must not separate the halves of a flat face at a crease angle of 0.
            if (!(dot(a, b) >= least_cosine - 1e-12)) continue;
            const auto low = [](const Edge& e) { return e.rising ? e.corner : next_corner(e.corner); };
            const auto high = [](const Edge& e) { return e.rising ? next_corner(e.corner) : e.corner; };
            groups.unite(low(edge), low(other));
            groups.unite(high(edge), high(other));
        }
    }
    return groups;
}

double angle_at(const Model& model, Corner c) {
    const Vec3d p = position_of(model, c);
    const Vec3d a = position_of(model, next_corner(c)) - p;
    const Vec3d b = position_of(model, previous_corner(c)) - p;
    return std::atan2(length(cross(a, b)), dot(a, b));
}

std::uint32_t copy_vertex(Model& model, std::uint32_t vertex) {
    model.positions.push_back(model.positions[vertex]);
    model.normals.emplace_back();
    if (!model.uvs.empty()) model.uvs.push_back(model.uvs[vertex]);
    if (!model.colors.empty()) model.colors.push_back(model.colors[vertex]);
    return std::uint32_t(model.positions.size() - 1);
}

// Gives the corners of each (vertex, group) a vertex of their own: the first group keeps the vertex.
void split_vertices(Model& model, CornerGroups& groups, const std::vector<bool>& missing,
                    const std::vector<Vec3f>& group_normals) {
    struct Claim {
        std::uint32_t vertex;
        Corner group, corner;
    };
    constexpr Corner unclaimed = ~Corner{0};
    std::vector<Corner> owner(missing.size(), unclaimed);
    std::vector<Claim> others;
    for (Corner c = 0; c < model.triangles.size() * 3; ++c) {
        const std::uint32_t vertex = vertex_of(model, c);
        if (!missing[vertex]) continue;
        const Corner group = groups.find(c);
        if (owner[vertex] == unclaimed) {
            owner[vertex] = group;
            model.normals[vertex] = group_normals[group];
        } else if (owner[vertex] != group) {
            others.push_back({vertex, group, c});
        }
    }
    std::sort(others.begin(), others.end(), [](const Claim& a, const Claim& b) {
        return std::tie(a.vertex, a.group, a.corner) < std::tie(b.vertex, b.group, b.corner);
    });
    std::uint32_t copy = no_index;
    for (std::size_t i = 0; i < others.size(); ++i) {
        const Claim& claim = others[i];
        if (i == 0 || claim.vertex != others[i - 1].vertex || claim.group != others[i - 1].group) {
            copy = copy_vertex(model, claim.vertex);
            model.normals[copy] = group_normals[claim.group];
        }
        model.triangles[claim.corner / 3].vertex[claim.corner % 3] = copy;
    }
}

} // namespace

void compute_normals(Model& model, double crease_angle_degrees) {
    model.normals.resize(model.positions.size());
    std::vector<bool> missing(model.positions.size());
    for (std::size_t v = 0; v < missing.size(); ++v) missing[v] = model.normals[v] == Vec3f{};
    if (std::find(missing.begin(), missing.end(), true) == missing.end()) return;

    const std::vector<Vec3d> normals = face_normals(model);
    CornerGroups groups = group_corners(model, normals, crease_angle_degrees);
    std::vector<Vec3d> sums(model.triangles.size() * 3);
    for (Corner c = 0; c < sums.size(); ++c) {
        const Corner group = groups.find(c);
        sums[group] = sums[group] + normals[c / 3] * angle_at(model, c);
    }
    std::vector<Vec3f> group_normals(sums.size());
    for (Corner c = 0; c < sums.size(); ++c) {
        // Opposite faces can cancel; the face's own normal is then as good as any.
        Vec3d normal = normalize(sums[c]);
        if (normal == Vec3d{}) normal = normals[c / 3];
        if (normal == Vec3d{}) normal = {0, 0, 1};
        group_normals[c] = to_float(normal);
    }
    split_vertices(model, groups, missing, group_normals);
    for (Vec3f& normal : model.normals) {
        if (normal == Vec3f{}) normal = {0, 0, 1};
    }
}

} // namespace spa
