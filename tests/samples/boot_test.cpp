// SPDX-License-Identifier: Apache-2.0
#include "topology.h"

#include "../../samples/samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <ostream>
#include <set>

namespace {

using spa::Model;
using spa::Triangle;
using spa::Vec3f;
using spa::samples::make_sample;

#if defined(__SANITIZE_ADDRESS__)
constexpr bool is_sanitized = true;
#elif defined(__has_feature)
constexpr bool is_sanitized = __has_feature(address_sanitizer);
#else
constexpr bool is_sanitized = false;
#endif

struct Counts {
    int level;
    std::uint64_t vertices, edges, faces;
};

// What test listings show.
void PrintTo(const Counts& counts, std::ostream* out) { *out << counts.vertices << " vertices"; }

class Boot : public testing::TestWithParam<Counts> {};

TEST_P(Boot, IsADiscOfTheStatedSize) {
    const Counts& expected = GetParam();
    if (is_sanitized && expected.level > 4)
        GTEST_SKIP() << "takes minutes under a sanitizer and runs the code of the lower levels";
    const Model model = make_sample("boot", expected.level);
    EXPECT_EQ(model.positions.size(), expected.vertices) << "no vertex may be repeated";
    const spa::test::Topology topology = spa::test::topology_of(model);
    EXPECT_EQ(topology.vertices, expected.vertices);
    EXPECT_EQ(topology.edges, expected.edges);
    EXPECT_EQ(topology.faces, expected.faces);
    EXPECT_EQ(topology.border_edges, 16U << expected.level);
    EXPECT_EQ(topology.repeated_edges, 0U);
    EXPECT_EQ(topology.components, 1U);
    EXPECT_EQ(topology.euler(), 1);
}

// V' = V + E, E' = 2 E + 3 F, F' = 4 F from V = 334, E = 983, F = 650.
INSTANTIATE_TEST_SUITE_P(Levels, Boot,
                         testing::Values(Counts{0, 334, 983, 650}, Counts{1, 1317, 3916, 2600},
                                         Counts{2, 5233, 15632, 10400}, Counts{3, 20865, 62464, 41600},
                                         Counts{4, 83329, 249728, 166400}, Counts{5, 333057, 998656, 665600},
                                         Counts{6, 1331713, 3994112, 2662400}),
                         [](const auto& instance) { return "Level" + std::to_string(instance.param.level); });

TEST(BootShape, OpensAtTheTopOnly) {
    const Model model = make_sample("boot", 2);
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> directed;
    for (const Triangle& triangle : model.triangles)
        for (std::size_t i = 0; i < 3; ++i)
            directed.insert({triangle.vertex.at(i), triangle.vertex.at((i + 1) % 3)});
    float top = 0;
    for (const Vec3f& p : model.positions) top = std::max(top, p.y);
    for (const auto& [from, to] : directed) {
        if (!directed.contains({to, from})) {
            EXPECT_FLOAT_EQ(model.positions[from].y, top);
            EXPECT_FLOAT_EQ(model.positions[to].y, top);
        }
    }
    // From inside the leg one sees the sky, and a single wall everywhere else.
    const spa::Vec3d ankle{0.001, 0.2, -0.03};
    EXPECT_EQ(spa::test::crossings(model, ankle, {0.01, 1, 0.02}), 0);
    EXPECT_EQ(spa::test::crossings(model, ankle, {0.01, -1, 0.02}), 1);
    EXPECT_EQ(spa::test::crossings(model, ankle, {0.3, 0, 1}), 1);
    EXPECT_EQ(spa::test::crossings(model, ankle, {0.3, 0, -1}), 1);
}

float lowest_between(const Model& model, float z_low, float z_high) {
    float lowest = std::numeric_limits<float>::infinity();
    for (const Vec3f& p : model.positions)
        if (p.z >= z_low && p.z <= z_high) lowest = std::min(lowest, p.y);
    return lowest;
}

float highest_between(const Model& model, float z_low, float z_high) {
    float highest = 0;
    for (const Vec3f& p : model.positions)
        if (p.z >= z_low && p.z <= z_high) highest = std::max(highest, p.y);
    return highest;
}

TEST(BootShape, HasLegHeelWaistAndToe) {
    const Model model = make_sample("boot", 3);
    EXPECT_LT(lowest_between(model, -0.09F, -0.03F), 0.003F) << "the heel stands on the ground";
    EXPECT_GT(lowest_between(model, -0.011F, 0.002F), 0.015F) << "the waist does not";
    EXPECT_LT(lowest_between(model, 0.08F, 0.15F), 0.003F) << "the ball does";
    EXPECT_GT(highest_between(model, -0.1F, 0.03F), 0.25F) << "the leg";
    EXPECT_LT(highest_between(model, 0.15F, 0.25F), 0.1F) << "the foot";
    EXPECT_GT(lowest_between(model, 0.2F, 0.25F), 0.005F) << "the toe curves up";
    const auto [back, front] = std::minmax_element(model.positions.begin(), model.positions.end(),
                                                   [](Vec3f a, Vec3f b) { return a.z < b.z; });
    EXPECT_GT(front->z - back->z, 0.29F);
}

// The default centre of a bake. From outside the boot it would see most of the surface from behind.
TEST(BootShape, HoldsTheCentreOfItsBounds) {
    const Model model = make_sample("boot", 3);
    Vec3f low = model.positions[0], high = low;
    for (const Vec3f& p : model.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const spa::Vec3d center = to_double(low + high) * 0.5;
    EXPECT_EQ(spa::test::crossings(model, center, {0.01, 0.02, 1}), 1) << "to the toe";
    EXPECT_EQ(spa::test::crossings(model, center, {1, 0.02, 0.01}), 1) << "to the side";
    EXPECT_EQ(spa::test::crossings(model, center, {0.01, 0.02, -1}), 1) << "to the back";
    EXPECT_EQ(spa::test::crossings(model, center, {0.01, -1, 0.01}), 1) << "to the ground";
}

TEST(BootShape, IsItsOwnMirrorImage) {
    const Model model = make_sample("boot", 1);
    for (const Vec3f& p : model.positions) {
        const bool found = std::any_of(model.positions.begin(), model.positions.end(), [&](const Vec3f& q) {
            return spa::length(Vec3f{p.x + q.x, p.y - q.y, p.z - q.z}) < 1e-6F;
        });
        EXPECT_TRUE(found) << p.x << ' ' << p.y << ' ' << p.z;
    }
}

TEST(BootTexture, IsOrangeOnOneSideAndBlueOnTheOther) {
    const Model model = make_sample("boot", 2);
    ASSERT_EQ(model.uvs.size(), model.positions.size());
    ASSERT_EQ(model.textures.size(), 1U);
    EXPECT_TRUE(model.materials.at(0).double_sided);
    const spa::Image& image = model.textures[0].mips.at(0);
    // The split runs along edges: no triangle has corners on both sides.
    for (const Triangle& triangle : model.triangles) {
        float x = 0, u = 0.5F, v = 0;
        for (const std::uint32_t corner : triangle.vertex) {
            ASSERT_GE(std::min(model.uvs[corner].x, model.uvs[corner].y), 0.0F);
            ASSERT_LE(std::max(model.uvs[corner].x, model.uvs[corner].y), 1.0F);
            EXPECT_GT(model.positions[corner].x * x, -1e-12F);
            x += model.positions[corner].x;
            u += (model.uvs[corner].x - 0.5F) / 3;
            v += model.uvs[corner].y / 3;
        }
        const auto& pixel = image.pixels.at(std::size_t(v * float(image.height)) * image.width +
                                            std::size_t(u * float(image.width)));
        if (x < 0)
            EXPECT_GT(pixel[0], pixel[2] + 100) << "orange on -X";
        else
            EXPECT_GT(pixel[2], pixel[0] + 100) << "blue on +X";
    }
}

// Twice the signed area of a triangle on the texture.
float texture_area(const Model& model, const Triangle& triangle) {
    const auto [a, b, c] = triangle.vertex;
    const spa::Vec2f ab = model.uvs[b] - model.uvs[a], ac = model.uvs[c] - model.uvs[a];
    return ab.x * ac.y - ab.y * ac.x;
}

// The disc unrolls onto the texture without folding over.
TEST(BootTexture, CoordinatesDoNotOverlap) {
    const Model model = make_sample("boot", 3);
    const bool is_positive = texture_area(model, model.triangles[0]) > 0;
    for (const Triangle& triangle : model.triangles)
        EXPECT_GT(texture_area(model, triangle) * (is_positive ? 1.0F : -1.0F), 0);
}

} // namespace
