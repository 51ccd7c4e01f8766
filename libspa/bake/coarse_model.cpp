// SPDX-License-Identifier: Apache-2.0
#include "coarse_model.h"

#include "../core/vector.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <vector>

namespace spa::bake {
namespace {

constexpr std::size_t most_triangles = 16384;
constexpr std::uint32_t cells_a_side = 32;
constexpr std::size_t grain = 16384;
constexpr std::uint32_t cell_bits = 15; // of a cell's number

struct Box {
    Vec3d low{infinity, infinity, infinity};
    Vec3d high{-infinity, -infinity, -infinity};

    void extend(const Box& other) {
        low = {std::min(low.x, other.low.x), std::min(low.y, other.low.y), std::min(low.z, other.low.z)};
        high = {std::max(high.x, other.high.x), std::max(high.y, other.high.y),
                std::max(high.z, other.high.z)};
    }

private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();
};

// Of the vertices that triangles use; marks them.
Box bounds(const Model& model, std::vector<std::uint8_t>& used) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, model.triangles.size(), grain), Box{},
        [&](const auto& range, Box box) {
            for (std::size_t t = range.begin(); t < range.end(); ++t) {
                for (const std::uint32_t v : model.triangles[t].vertex) {
                    const Vec3d p = to_double(model.positions[v]);
                    box.extend({p, p});
                    std::atomic_ref(used[v]).store(1, std::memory_order_relaxed);
                }
            }
            return box;
        },
        [](Box a, const Box& b) {
            a.extend(b);
            return a;
        });
}

std::uint32_t cell_along(double p, double low, double high) {
    if (!(high > low)) return 0;
    const double at = std::clamp((p - low) / (high - low), 0.0, 1.0) * cells_a_side;
    return std::min(std::uint32_t(at), cells_a_side - 1);
}

// The three cells of a triangle in one number, the smallest first, which keeps the winding.
std::uint64_t key_of(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    while (a > b || a > c) {
        const std::uint64_t first = a;
        a = b;
        b = c;
        c = first;
    }
    return a << (2 * cell_bits) | b << cell_bits | c;
}

Model reduce(const Model& model) {
    std::vector<std::uint8_t> used(model.positions.size(), 0);
    const Box box = bounds(model, used);
    std::vector<std::uint16_t> cells(model.positions.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size(), grain), [&](const auto& range) {
        for (std::size_t v = range.begin(); v < range.end(); ++v) {
            if (used[v] == 0) continue;
            const Vec3d p = to_double(model.positions[v]);
            cells[v] = std::uint16_t((cell_along(p.x, box.low.x, box.high.x) * cells_a_side +
                                      cell_along(p.y, box.low.y, box.high.y)) *
                                         cells_a_side +
                                     cell_along(p.z, box.low.z, box.high.z));
        }
    });
    tbb::enumerable_thread_specific<std::vector<std::uint64_t>> lists;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, model.triangles.size(), grain),
                      [&](const auto& range) {
                          std::vector<std::uint64_t>& list = lists.local();
                          for (std::size_t t = range.begin(); t < range.end(); ++t) {
                              const auto& corner = model.triangles[t].vertex;
                              const std::uint16_t a = cells[corner[0]];
                              const std::uint16_t b = cells[corner[1]];
                              const std::uint16_t c = cells[corner[2]];
                              if (a != b && b != c && c != a) list.push_back(key_of(a, b, c));
                          }
                      });
    std::vector<std::uint64_t> keys;
    for (const auto& list : lists) keys.insert(keys.end(), list.begin(), list.end());
    tbb::parallel_sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());

    constexpr std::size_t cell_count = std::size_t(1) << cell_bits;
    std::vector<Vec3d> sums(cell_count);
    std::vector<std::uint32_t> counts(cell_count, 0);
    for (std::size_t v = 0; v < cells.size(); ++v) {
        if (used[v] == 0) continue;
        sums[cells[v]] = sums[cells[v]] + to_double(model.positions[v]);
        ++counts[cells[v]];
    }
    std::vector<std::uint32_t> vertex_of(cell_count, no_index);
    Model coarse;
    const auto vertex = [&](std::uint64_t cell) {
        std::uint32_t& v = vertex_of[cell];
        if (v == no_index) {
            v = std::uint32_t(coarse.positions.size());
            coarse.positions.push_back(to_float(sums[cell] * (1.0 / counts[cell])));
        }
        return v;
    };
    constexpr std::uint64_t one_cell = cell_count - 1;
    for (const std::uint64_t key : keys) {
        const std::uint32_t a = vertex(key >> (2 * cell_bits));
        const std::uint32_t b = vertex(key >> cell_bits & one_cell);
        coarse.triangles.push_back({{a, b, vertex(key & one_cell)}});
    }
    return coarse;
}

} // namespace

Model coarse_model(const Model& model) {
    Model coarse;
    if (model.triangles.size() > most_triangles) coarse = reduce(model);
    if (coarse.triangles.empty()) { // dust, each speck smaller than a cell
        coarse.positions = model.positions;
        coarse.triangles = model.triangles;
    }
    coarse.normals.resize(coarse.positions.size(), {0, 0, 1});
    coarse.triangle_materials.resize(coarse.triangles.size(), 0);
    coarse.materials.resize(1);
    return coarse;
}

} // namespace spa::bake
