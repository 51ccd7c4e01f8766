// SPDX-License-Identifier: Apache-2.0
#include "components.h"

#include "turned_faces.h"
#include "weld.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <utility>

namespace spa {
namespace {

// Finaliser of splitmix64 (Steele et al. 2014): a bijection that spreads every input bit.
std::uint64_t mix(std::uint64_t v) {
    v = (v ^ (v >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    v = (v ^ (v >> 27U)) * 0x94D049BB133111EBULL;
    return v ^ (v >> 31U);
}

// Disjoint sets that many threads may unite at once (Anderson & Woll 1991). A parent is never larger than its
// child, so the representative is the smallest member, whatever the order of events.
class DisjointSets {
public:
    // parent: of each member, at most itself.
    explicit DisjointSets(std::vector<std::uint32_t> parent) : parent_(std::move(parent)) {}

    std::uint32_t find(std::uint32_t v) {
        for (;;) {
            std::uint32_t parent = load(v);
            if (parent == v) return v;
            const std::uint32_t grandparent = load(parent);
            if (grandparent == parent) return parent;
            // Failing is fine: somebody else shortened the path.
            at(v).compare_exchange_weak(parent, grandparent, std::memory_order_relaxed);
            v = grandparent;
        }
    }
    void unite(std::uint32_t a, std::uint32_t b) {
        for (;;) {
            a = find(a);
            b = find(b);
            if (a == b) return;
            if (a < b) std::swap(a, b);
            std::uint32_t root = a;
            if (at(a).compare_exchange_strong(root, b, std::memory_order_relaxed)) return;
        }
    }

private:
    std::atomic_ref<std::uint32_t> at(std::uint32_t v) { return std::atomic_ref(parent_[v]); }
    std::uint32_t load(std::uint32_t v) { return at(v).load(std::memory_order_relaxed); }

    std::vector<std::uint32_t> parent_;
};

template <class Visit>
void each_triangle(const Model& model, Visit&& visit) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, model.triangles.size(), 16384),
                      [&](const auto& range) {
                          for (std::size_t t = range.begin(); t < range.end(); ++t) visit(t);
                      });
}

// Each edge adds a random number of its own to one of many sums, and its partner takes it away again: a sum
// that is not 0 has an open edge in it. Only the edges of those sums need to be matched one by one, so closed
// meshes cost one linear pass.
struct OpenEdges {
    std::uint64_t count = 0;
    bool any_twice = false; // passed twice more in one direction than in the other
};

OpenEdges count_open_edges(const Model& model, const std::vector<std::uint32_t>& first) {
    constexpr std::uint32_t sums = 1U << 16U; // fit in a cache, one set of them a thread
    const auto each_edge = [&](std::size_t t, auto&& visit) {
        const auto& v = model.triangles[t].vertex;
        const std::array<std::uint32_t, 3> w{first[v[0]], first[v[1]], first[v[2]]};
        for (unsigned k = 0; k < 3; ++k) {
            const std::uint32_t a = w[k];
            const std::uint32_t b = w[(k + 1) % 3];
            if (a == b) continue;
            // By the lower vertex, because neighbours in the file are often neighbours in space.
            const std::uint32_t low = std::min(a, b);
            visit(low % sums, std::uint64_t(low) << 32U | std::max(a, b), a < b ? 1 : -1);
        }
    };
    tbb::enumerable_thread_specific<std::vector<std::uint64_t>> partial(sums);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, model.triangles.size(), 16384),
                      [&](const auto& range) {
                          std::vector<std::uint64_t>& sum = partial.local();
                          for (std::size_t t = range.begin(); t < range.end(); ++t) {
                              each_edge(t, [&](std::uint32_t s, std::uint64_t key, int direction) {
                                  sum[s] += direction > 0 ? mix(key) : 0 - mix(key);
                              });
                          }
                      });
    std::vector<std::uint64_t> balance(sums, 0);
    for (const std::vector<std::uint64_t>& sum : partial) {
        for (std::uint32_t s = 0; s < sums; ++s) balance[s] += sum[s];
    }
    struct Edge {
        std::uint64_t key; // undirected
        int direction;
    };
    tbb::enumerable_thread_specific<std::vector<Edge>> unbalanced;
    each_triangle(model, [&](std::size_t t) {
        each_edge(t, [&](std::uint32_t s, std::uint64_t key, int direction) {
            if (balance[s] != 0) unbalanced.local().push_back({key, direction});
        });
    });
    std::vector<Edge> edges;
    for (const std::vector<Edge>& list : unbalanced) edges.insert(edges.end(), list.begin(), list.end());
    std::sort(edges.begin(), edges.end(), [](const Edge& l, const Edge& r) { return l.key < r.key; });
    OpenEdges open;
    for (std::size_t i = 0; i < edges.size();) {
        std::int64_t sum = 0;
        std::size_t j = i;
        for (; j < edges.size() && edges[j].key == edges[i].key; ++j) sum += edges[j].direction;
        const auto unmatched = std::uint64_t(sum < 0 ? -sum : sum);
        open.count += unmatched;
        if (unmatched > 1) open.any_twice = true;
        i = j;
    }
    return open;
}

} // namespace

Components find_components(const Model& model) {
    const std::vector<std::uint32_t> first = weld_positions(model.positions);
    DisjointSets sets(first);
    each_triangle(model, [&](std::size_t t) {
        const auto& v = model.triangles[t].vertex;
        sets.unite(v[0], v[1]);
        sets.unite(v[1], v[2]);
    });
    Components result;
    result.of_triangle.resize(model.triangles.size());
    each_triangle(model,
                  [&](std::size_t t) { result.of_triangle[t] = sets.find(model.triangles[t].vertex[0]); });
    // From representatives to numbers in order of the first triangle.
    std::vector<std::uint32_t> number(model.positions.size(), no_index);
    for (std::uint32_t& component : result.of_triangle) {
        std::uint32_t& n = number[component];
        if (n == no_index) n = result.count++;
        component = n;
    }
    const OpenEdges open = count_open_edges(model, first);
    result.open_edges = open.count;
    if (open.any_twice) result.turned = find_turned_faces(model, first);
    return result;
}

} // namespace spa
