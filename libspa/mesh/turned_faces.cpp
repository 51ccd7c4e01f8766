// SPDX-License-Identifier: Apache-2.0
#include "turned_faces.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace spa {
namespace {

struct Edge {
    std::uint64_t key = 0; // of the two vertices, whatever their order
    std::uint32_t triangle = 0;
    bool forward = false; // from the lower vertex to the higher
};

// Disjoint sets whose members are wound like their representative or against it.
class Patches {
public:
    explicit Patches(std::size_t count) : parent_(count), against_parent_(count, 0) {
        for (std::size_t i = 0; i < count; ++i) parent_[i] = std::uint32_t(i);
    }

    // The representative, and whether t is wound against it.
    std::pair<std::uint32_t, std::uint8_t> find(std::uint32_t t) {
        std::uint32_t root = t;
        std::uint8_t against = 0;
        while (parent_[root] != root) {
            against ^= against_parent_[root];
            root = parent_[root];
        }
        // From now on they hang from the representative itself.
        for (std::uint8_t rest = against; parent_[t] != root && t != root;) {
            const std::uint32_t next = parent_[t];
            const std::uint8_t own = against_parent_[t];
            parent_[t] = root;
            against_parent_[t] = rest;
            rest ^= own;
            t = next;
        }
        return {root, against};
    }

    void unite(std::uint32_t s, std::uint32_t t, bool against) {
        const auto [root_s, against_s] = find(s);
        const auto [root_t, against_t] = find(t);
        if (root_s == root_t) return;
        const std::uint32_t low = std::min(root_s, root_t), high = std::max(root_s, root_t);
        parent_[high] = low;
        against_parent_[high] = against_s ^ against_t ^ std::uint8_t(against ? 1 : 0);
    }

private:
    std::vector<std::uint32_t> parent_;
    std::vector<std::uint8_t> against_parent_;
};

} // namespace

std::vector<std::uint8_t> find_turned_faces(const Model& model, std::span<const std::uint32_t> first) {
    std::vector<Edge> edges;
    edges.reserve(3 * model.triangles.size());
    for (std::uint32_t t = 0; t < model.triangles.size(); ++t) {
        const auto& vertex = model.triangles[t].vertex;
        for (unsigned k = 0; k < 3; ++k) {
            const std::uint32_t a = first[vertex[k]];
            const std::uint32_t b = first[vertex[(k + 1) % 3]];
            if (a != b) edges.push_back({std::uint64_t(std::min(a, b)) << 32U | std::max(a, b), t, a < b});
        }
    }
    tbb::parallel_sort(edges.begin(), edges.end(), [](const Edge& l, const Edge& r) {
        return std::tie(l.key, l.triangle, l.forward) < std::tie(r.key, r.triangle, r.forward);
    });
    Patches patches(model.triangles.size());
    for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
        while (j < edges.size() && edges[j].key == edges[i].key) ++j;
        if (j - i == 2)
            patches.unite(edges[i].triangle, edges[i + 1].triangle, edges[i].forward == edges[i + 1].forward);
    }
    std::vector<std::uint8_t> turned(model.triangles.size());
    std::vector<std::int64_t> majority(model.triangles.size(), 0); // of each representative
    for (std::uint32_t t = 0; t < turned.size(); ++t) {
        const auto [root, against] = patches.find(t);
        turned[t] = against;
        majority[root] += against != 0 ? -1 : 1;
    }
    for (std::uint32_t t = 0; t < turned.size(); ++t)
        if (majority[patches.find(t).first] < 0) turned[t] ^= 1U;
    return turned;
}

} // namespace spa
