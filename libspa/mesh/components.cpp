// SPDX-License-Identifier: Apache-2.0
#include "components.h"

#include "weld.h"

#include <algorithm>

namespace spa {
namespace {

// Finaliser of splitmix64 (Steele et al. 2014): a bijection that spreads every input bit.
std::uint64_t mix(std::uint64_t v) {
    v = (v ^ (v >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    v = (v ^ (v >> 27U)) * 0x94D049BB133111EBULL;
    return v ^ (v >> 31U);
}

// Disjoint sets; the representative is always the smallest member, so labels are deterministic.
struct DisjointSets {
    std::vector<std::uint32_t> parent;
    std::uint32_t find(std::uint32_t v) {
        while (parent[v] != v) {
            parent[v] = parent[parent[v]];
            v = parent[v];
        }
        return v;
    }
    void unite(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        if (a < b)
            parent[b] = a;
        else
            parent[a] = b;
    }
};

// An open edge unbalances both of its vertices: weigh each directed edge a -> b by a random number of its
// far end; at every vertex of a closed mesh, what leaves equals what arrives. Only triangles at unbalanced
// vertices need their edges matched one by one, so closed meshes cost one linear pass.
std::uint64_t count_open_edges(const Model& model, const std::vector<std::uint32_t>& first) {
    std::vector<std::uint64_t> balance(model.positions.size(), 0);
    const auto each_edge = [&](auto&& visit) {
        for (const Triangle& triangle : model.triangles) {
            for (unsigned k = 0; k < 3; ++k) {
                const std::uint32_t a = first[triangle.vertex[k]];
                const std::uint32_t b = first[triangle.vertex[(k + 1) % 3]];
                if (a != b) visit(a, b);
            }
        }
    };
    each_edge([&](std::uint32_t a, std::uint32_t b) {
        balance[a] += mix(b + 1ULL);
        balance[b] -= mix(a + 1ULL);
    });
    struct Edge {
        std::uint64_t key; // undirected
        int direction;
    };
    std::vector<Edge> edges;
    each_edge([&](std::uint32_t a, std::uint32_t b) {
        if (balance[a] == 0 || balance[b] == 0) return;
        if (a < b)
            edges.push_back({std::uint64_t(a) << 32U | b, 1});
        else
            edges.push_back({std::uint64_t(b) << 32U | a, -1});
    });
    std::sort(edges.begin(), edges.end(), [](const Edge& l, const Edge& r) { return l.key < r.key; });
    std::uint64_t open = 0;
    for (std::size_t i = 0; i < edges.size();) {
        std::int64_t sum = 0;
        std::size_t j = i;
        for (; j < edges.size() && edges[j].key == edges[i].key; ++j) sum += edges[j].direction;
        open += std::uint64_t(sum < 0 ? -sum : sum);
        i = j;
    }
    return open;
}

} // namespace

Components find_components(const Model& model) {
    const std::vector<std::uint32_t> first = weld_positions(model.positions);
    DisjointSets sets{first};
    for (const Triangle& triangle : model.triangles) {
        sets.unite(triangle.vertex[0], triangle.vertex[1]);
        sets.unite(triangle.vertex[0], triangle.vertex[2]);
    }
    Components result;
    result.of_triangle.reserve(model.triangles.size());
    std::vector<std::uint32_t> label(model.positions.size(), no_index);
    for (const Triangle& triangle : model.triangles) {
        std::uint32_t& l = label[sets.find(triangle.vertex[0])];
        if (l == no_index) l = result.count++;
        result.of_triangle.push_back(l);
    }
    result.open_edges = count_open_edges(model, first);
    return result;
}

} // namespace spa
