// SPDX-License-Identifier: Apache-2.0
#include "topology.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <vector>

namespace spa::test {
namespace {

using Key = std::array<std::uint32_t, 3>;

Key key_of(Vec3f p) {
    const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
    return {bits(p.x), bits(p.y), bits(p.z)};
}

// For each vertex the number of its position.
std::vector<std::uint32_t> welded(const Model& model, std::uint64_t& count) {
    std::vector<std::uint32_t> order(model.positions.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return key_of(model.positions[a]) < key_of(model.positions[b]);
    });
    std::vector<std::uint32_t> result(order.size());
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && key_of(model.positions[order[i]]) != key_of(model.positions[order[i - 1]])) ++number;
        result[order[i]] = number;
    }
    count = order.empty() ? 0 : number + 1ULL;
    return result;
}

std::uint32_t root(std::vector<std::uint32_t>& parents, std::uint32_t vertex) {
    while (parents[vertex] != vertex) vertex = parents[vertex] = parents[parents[vertex]];
    return vertex;
}

} // namespace

Topology topology_of(const Model& model) {
    Topology result;
    const std::vector<std::uint32_t> number = welded(model, result.vertices);
    result.faces = model.triangles.size();
    std::vector<std::uint64_t> directed, undirected;
    directed.reserve(3 * result.faces);
    std::vector<std::uint32_t> parents(result.vertices);
    std::iota(parents.begin(), parents.end(), 0U);
    for (const Triangle& triangle : model.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint64_t from = number[triangle.vertex.at(i)];
            const std::uint64_t to = number[triangle.vertex.at((i + 1) % 3)];
            directed.push_back(from << 32U | to);
            undirected.push_back(std::min(from, to) << 32U | std::max(from, to));
            parents[root(parents, std::uint32_t(from))] = root(parents, std::uint32_t(to));
        }
        const Vec3d a = to_double(model.positions[triangle.vertex[0]]);
        const Vec3d b = to_double(model.positions[triangle.vertex[1]]);
        const Vec3d c = to_double(model.positions[triangle.vertex[2]]);
        result.volume += dot(a, cross(b, c)) / 6;
    }
    for (std::uint32_t v = 0; v < parents.size(); ++v)
        if (root(parents, v) == v) ++result.components;
    std::sort(directed.begin(), directed.end());
    result.repeated_edges =
        directed.size() -
        static_cast<std::uint64_t>(std::unique(directed.begin(), directed.end()) - directed.begin());
    std::sort(undirected.begin(), undirected.end());
    for (std::size_t i = 0; i < undirected.size();) {
        std::size_t end = i;
        while (end < undirected.size() && undirected[end] == undirected[i]) ++end;
        ++result.edges;
        if (end - i == 1) ++result.border_edges;
        i = end;
    }
    return result;
}

int crossings(const Model& model, Vec3d origin, Vec3d direction) {
    int count = 0;
    for (const Triangle& triangle : model.triangles) {
        const Vec3d a = to_double(model.positions[triangle.vertex[0]]) - origin;
        const Vec3d b = to_double(model.positions[triangle.vertex[1]]) - origin;
        const Vec3d c = to_double(model.positions[triangle.vertex[2]]) - origin;
        const double side = dot(a, cross(b, c));
        const double ab = dot(direction, cross(a, b)), bc = dot(direction, cross(b, c)),
                     ca = dot(direction, cross(c, a));
        const bool inside = (ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0);
        if (inside && side * (ab + bc + ca) > 0) ++count;
    }
    return count;
}

} // namespace spa::test
