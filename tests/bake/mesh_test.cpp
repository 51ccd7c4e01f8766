// SPDX-License-Identifier: Apache-2.0
// Welding, pieces and frames, against slow and simple versions of themselves.
#include "../../libspa/mesh/components.h"
#include "../../libspa/mesh/part_frame.h"
#include "../../libspa/mesh/weld.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <bit>
#include <map>
#include <random>
#include <tuple>

namespace spa {
namespace {

std::vector<std::uint32_t> weld_by_map(const std::vector<Vec3f>& positions) {
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> first;
    std::vector<std::uint32_t> result;
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        const auto bits = [](float v) { return std::bit_cast<std::uint32_t>(v == 0 ? 0.0F : v); };
        const Vec3f p = positions[i];
        result.push_back(first.emplace(std::tuple(bits(p.x), bits(p.y), bits(p.z)), i).first->second);
    }
    return result;
}

TEST(Weld, FindsTheFirstOfEqualPositions) {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> coordinate(-8, 8);
    std::vector<Vec3f> positions;
    for (int i = 0; i < 20000; ++i) {
        const auto any = [&] {
            const int k = coordinate(random);
            return k == 0 ? (i % 2 == 0 ? 0.0F : -0.0F) : float(k) / 3;
        };
        positions.push_back({any(), any(), any()});
    }
    EXPECT_EQ(weld_positions(positions), weld_by_map(positions));
    EXPECT_TRUE(weld_positions({}).empty());
}

// The inverse of an odd number modulo 2^64, by Newton's iteration.
std::uint64_t inverse_of(std::uint64_t odd) {
    std::uint64_t inverse = odd;
    for (int i = 0; i < 6; ++i) inverse *= 2 - odd * inverse;
    return inverse;
}

// Positions of which all have one hash, as somebody would choose them who knows it (weld.cpp).
TEST(Weld, CollidingHashesChangeNothing) {
    std::vector<Vec3f> positions;
    const std::uint64_t inverse = inverse_of(0x9E3779B97F4A7C15ULL);
    for (std::uint64_t k = 0; positions.size() < 30000; ++k) {
        const std::uint64_t h = 0x12345678ULL << 32U | (k * 2654435761U & 0xFFFFFFFFU);
        const std::uint64_t xy = h * inverse;
        const auto z = std::uint32_t(h ^ (h >> 32U) ^ 0xABCDEF01U);
        const Vec3f p{std::bit_cast<float>(std::uint32_t(xy >> 32U)), std::bit_cast<float>(std::uint32_t(xy)),
                      std::bit_cast<float>(z)};
        if (!is_finite(p)) continue;
        positions.push_back(p);
        if (k % 3 == 0) positions.push_back(positions[positions.size() / 2]);
    }
    EXPECT_EQ(weld_positions(positions), weld_by_map(positions));
}

Model soup(unsigned seed, std::uint32_t vertices, std::uint32_t triangles) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<std::uint32_t> vertex(0, vertices - 1);
    std::uniform_real_distribution<float> coordinate(-1, 1);
    Model model;
    for (std::uint32_t v = 0; v < vertices; ++v) {
        // Every fourth lies where an earlier one does.
        model.positions.push_back(v % 4 == 3
                                      ? model.positions[v / 2]
                                      : Vec3f{coordinate(random), coordinate(random), coordinate(random)});
    }
    for (std::uint32_t t = 0; t < triangles; ++t)
        model.triangles.push_back({{vertex(random), vertex(random), vertex(random)}});
    return model;
}

TEST(Components, AreThoseOfASearchAndEdgesThoseOfAMap) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Model model = soup(seed, 3000, 700 + 300 * seed);
        const std::vector<std::uint32_t> first = weld_by_map(model.positions);
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::int64_t> edges;
        std::vector<std::vector<std::uint32_t>> triangles_at(model.positions.size());
        for (std::uint32_t t = 0; t < model.triangles.size(); ++t) {
            for (unsigned k = 0; k < 3; ++k) {
                const std::uint32_t a = first[model.triangles[t].vertex[k]];
                const std::uint32_t b = first[model.triangles[t].vertex[(k + 1) % 3]];
                triangles_at[a].push_back(t);
                if (a < b) ++edges[{a, b}];
                if (b < a) --edges[{b, a}];
            }
        }
        std::uint64_t open = 0;
        for (const auto& [edge, sum] : edges) open += std::uint64_t(std::abs(sum));
        std::vector<std::uint32_t> component(model.triangles.size(), no_index);
        std::uint32_t count = 0;
        for (std::uint32_t t = 0; t < component.size(); ++t) {
            if (component[t] != no_index) continue;
            std::vector<std::uint32_t> reached{t};
            component[t] = count;
            while (!reached.empty()) {
                const std::uint32_t from = reached.back();
                reached.pop_back();
                for (const std::uint32_t v : model.triangles[from].vertex) {
                    for (const std::uint32_t to : triangles_at[first[v]]) {
                        if (component[to] != no_index) continue;
                        component[to] = count;
                        reached.push_back(to);
                    }
                }
            }
            ++count;
        }
        const Components found = find_components(model);
        EXPECT_EQ(found.count, count);
        EXPECT_EQ(found.of_triangle, component);
        EXPECT_EQ(found.open_edges, open);
    }
}

// Large enough to be divided among threads.
TEST(PartFrame, IsTheSameForAnyNumberOfThreads) {
    Model model = soup(7, 150000, 300000);
    for (Vec3f& p : model.positions) p = {p.x + 2 * p.y, p.y - p.z, 0.3F * p.z + p.x};
    const auto frame_with = [&](int threads) {
        tbb::task_arena arena(threads);
        PartFrame frame;
        bool moved = true;
        arena.execute([&] { frame = make_part_frame(model, bounds_center(model, moved), true); });
        EXPECT_FALSE(moved);
        return frame;
    };
    const PartFrame one = frame_with(1);
    for (const int threads : {2, 3, 8}) {
        const PartFrame more = frame_with(threads);
        EXPECT_EQ(more.center, one.center);
        EXPECT_EQ(more.frame, one.frame);
        EXPECT_EQ(more.radius, one.radius);
    }
}

// A slab, turned so that no axis sees how thin it is. The threshold is 1 % of the widest extent.
TEST(PartFrame, MovesTheCentreOfFlatObjectsAlone) {
    const auto moved_off = [](float thickness) {
        Model model;
        std::mt19937 random(3);
        std::uniform_real_distribution<float> unit(-1, 1);
        for (std::uint32_t v = 0; v < 30000; ++v) {
            const Vec3f p{unit(random), unit(random), thickness * unit(random)};
            model.positions.push_back({0.6F * p.x + 0.48F * p.y + 0.64F * p.z,
                                       -0.8F * p.x + 0.36F * p.y + 0.48F * p.z, -0.8F * p.y + 0.6F * p.z});
        }
        for (std::uint32_t v = 0; v + 2 < 30000; v += 3) model.triangles.push_back({{v, v + 1, v + 2}});
        bool moved = false;
        (void)bounds_center(model, moved);
        return moved;
    };
    EXPECT_TRUE(moved_off(0));
    EXPECT_TRUE(moved_off(0.003F));
    EXPECT_FALSE(moved_off(0.03F));
    EXPECT_FALSE(moved_off(0.5F));
}

} // namespace
} // namespace spa
