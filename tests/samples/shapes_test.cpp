// SPDX-License-Identifier: Apache-2.0
#include "topology.h"

#include "../../libspa/core/error.h"
#include "../../samples/samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

namespace {

using spa::Model;
using spa::Triangle;
using spa::Vec3d;
using spa::Vec3f;
using spa::samples::list;
using spa::samples::make_sample;
using spa::samples::Sample;
using spa::test::crossings;
using spa::test::Topology;
using spa::test::topology_of;

TEST(SampleList, NamesEverySampleOnce) {
    std::set<std::string_view> names;
    for (const Sample& sample : list()) {
        EXPECT_TRUE(names.insert(sample.name).second);
        EXPECT_TRUE(sample.description.ends_with('.'));
        EXPECT_GE(sample.default_level, 0);
        EXPECT_LE(sample.default_level, spa::samples::max_level);
        EXPECT_EQ(spa::samples::find_sample(sample.name)->name, sample.name);
    }
    EXPECT_EQ(names, (std::set<std::string_view>{"boot", "cliff", "concave", "cube", "smooth", "sphere",
                                                 "spiky", "torus"}));
    EXPECT_EQ(spa::samples::find_sample("shoe"), nullptr);
}

TEST(SampleList, RefusesUnknownNamesAndLevels) {
    for (const auto& [name, level] : {std::pair{"shoe", 0}, {"boot", -1}, {"boot", 7}}) {
        try {
            make_sample(name, level);
            ADD_FAILURE() << name << ' ' << level;
        } catch (const spa::Error& error) {
            EXPECT_EQ(error.code(), spa::ExitCode::usage);
        }
    }
}

// Runs with each sample's name.
class Shape : public testing::TestWithParam<std::string> {};

constexpr int levels[] = {0, 1, 2, 3};

std::vector<std::string> names() {
    std::vector<std::string> result;
    for (const Sample& sample : list()) result.emplace_back(sample.name);
    return result;
}

INSTANTIATE_TEST_SUITE_P(Samples, Shape, testing::ValuesIn(names()),
                         [](const auto& instance) { return instance.param; });

TEST_P(Shape, IsClosedManifoldAndFacesOutwardsUnlessItIsTheBoot) {
    for (const int level : levels) {
        SCOPED_TRACE(level);
        const Topology topology = topology_of(make_sample(GetParam(), level));
        EXPECT_EQ(topology.repeated_edges, 0U);
        EXPECT_EQ(topology.components, 1U);
        EXPECT_GT(topology.volume, 0);
        if (GetParam() == "boot") continue;
        EXPECT_EQ(topology.border_edges, 0U);
        EXPECT_EQ(2 * topology.edges, 3 * topology.faces);
        EXPECT_EQ(topology.euler(), GetParam() == "torus" ? 0 : 2);
    }
}

void expect_whole(const Model& model) {
    ASSERT_EQ(model.normals.size(), model.positions.size());
    EXPECT_TRUE(model.uvs.empty() || model.uvs.size() == model.positions.size());
    EXPECT_TRUE(model.colors.empty() || model.colors.size() == model.positions.size());
    EXPECT_TRUE(model.uvs.empty() != model.colors.empty()) << "coloured by a texture or by vertices";
    EXPECT_EQ(model.uvs.empty(), model.textures.empty());
    EXPECT_EQ(model.triangle_materials.size(), model.triangles.size());
    EXPECT_EQ(model.materials.size(), 1U);
    for (const spa::Texture& texture : model.textures) {
        EXPECT_EQ(texture.mips.back().width, 1U);
        EXPECT_EQ(texture.mips.back().height, 1U);
    }
}

void expect_normals_agree_with_faces(const Model& model) {
    std::vector<bool> used(model.positions.size());
    for (const Triangle& triangle : model.triangles) {
        const auto [a, b, c] = triangle.vertex;
        const Vec3d origin = to_double(model.positions.at(a));
        const Vec3d area =
            cross(to_double(model.positions.at(b)) - origin, to_double(model.positions.at(c)) - origin);
        EXPECT_GT(length(area), 0);
        for (const std::uint32_t corner : triangle.vertex) {
            used[corner] = true;
            EXPECT_NEAR(length(to_double(model.normals[corner])), 1, 1e-5);
            EXPECT_GT(dot(area, to_double(model.normals[corner])), 0);
        }
    }
    EXPECT_TRUE(std::all_of(used.begin(), used.end(), [](bool is_used) { return is_used; }));
}

TEST_P(Shape, HoldsWhatAModelPromises) {
    for (const int level : levels) {
        SCOPED_TRACE(level);
        const Model model = make_sample(GetParam(), level);
        expect_whole(model);
        expect_normals_agree_with_faces(model);
    }
}

TEST_P(Shape, IsTheSameEveryTime) {
    for (const int level : levels) {
        EXPECT_EQ(spa::samples::to_glb(make_sample(GetParam(), level)),
                  spa::samples::to_glb(make_sample(GetParam(), level)));
    }
}

TEST_P(Shape, GrowsAboutFourfoldALevel) {
    const double now = double(make_sample(GetParam(), 3).triangles.size());
    const double next = double(make_sample(GetParam(), 4).triangles.size());
    EXPECT_GT(next, 3 * now);
    EXPECT_LT(next, 5 * now);
}

TEST(Sphere, HasRadiusOne) {
    for (const Vec3f& p : make_sample("sphere", 4).positions) EXPECT_NEAR(length(to_double(p)), 1, 1e-6);
    EXPECT_NEAR(topology_of(make_sample("sphere", 5)).volume, 4 * std::numbers::pi / 3, 0.01);
}

TEST(Torus, HasItsRadiiAndItsHole) {
    const Model model = make_sample("torus", 4);
    for (const Vec3f& p : model.positions) {
        const double tube = std::hypot(std::hypot(p.x, p.z) - 1.0, double(p.y));
        EXPECT_NEAR(tube, 0.4, 1e-6);
    }
    EXPECT_EQ(crossings(model, {}, {0.011, 1, 0.007}), 0);
    EXPECT_EQ(crossings(model, {}, {1, 0.03, 0.21}), 2);
}

TEST(Cube, HasSixFlatFaces) {
    const Model model = make_sample("cube", 3);
    EXPECT_NEAR(topology_of(model).volume, 1.2 * 1.2 * 1.2, 1e-5);
    std::set<float> colors;
    for (std::size_t i = 0; i < model.positions.size(); ++i) {
        EXPECT_FLOAT_EQ(dot(model.positions[i], model.normals[i]), 0.6F);
        colors.insert(model.colors[i].x);
    }
    EXPECT_EQ(colors.size(), 6U);
}

TEST(Spiky, Has42NeedlesOfWhichManyAreThinnerThanATexel) {
    const Model model = make_sample("spiky", 0);
    int tips = 0, hairs = 0;
    for (std::uint32_t v = 0; v < model.positions.size(); ++v) {
        const Vec3d tip = to_double(model.positions[v]);
        if (length(tip) < 0.8) continue;
        ++tips;
        double widest = 0; // the angle at which the centre sees the needle's foot
        for (const Triangle& triangle : model.triangles) {
            if (std::find(triangle.vertex.begin(), triangle.vertex.end(), v) == triangle.vertex.end())
                continue;
            for (const std::uint32_t corner : triangle.vertex) {
                const Vec3d foot = to_double(model.positions[corner]);
                widest = std::max(widest, 2 * std::atan2(length(cross(tip, foot)), dot(tip, foot)));
            }
        }
        if (widest < 2.0 / 256) ++hairs;
    }
    EXPECT_EQ(tips, 42);
    EXPECT_GE(hairs, 10);
}

TEST(Cliff, IsStarShapedAndFallsWithinATexel) {
    const Model model = make_sample("cliff", 3);
    double steepest = 0; // fall in radius over an angle of at most 0.015 rad
    for (const Triangle& triangle : model.triangles) {
        Vec3d corner[3];
        for (std::size_t i = 0; i < 3; ++i) corner[i] = to_double(model.positions[triangle.vertex.at(i)]);
        EXPECT_GT(dot(corner[0], cross(corner[1], corner[2])), 0) << "seen from the centre";
        for (int i = 0; i < 3; ++i) {
            const Vec3d a = corner[i], b = corner[(i + 1) % 3];
            if (std::atan2(length(cross(a, b)), dot(a, b)) < 0.015)
                steepest = std::max(steepest, std::abs(length(a) - length(b)));
        }
    }
    EXPECT_NEAR(steepest, 0.4, 1e-6);
}

TEST(Smooth, IsStarShapedAndItsNormalsAreThoseOfItsSurface) {
    const Model model = make_sample("smooth", 4);
    EXPECT_EQ(model.positions.size(), 4U * 144 * 144 + 2);
    double least = 2, most = 0;
    for (const Triangle& triangle : model.triangles) {
        Vec3d corner[3];
        for (std::size_t i = 0; i < 3; ++i) corner[i] = to_double(model.positions[triangle.vertex.at(i)]);
        EXPECT_GT(dot(corner[0], cross(corner[1], corner[2])), 0) << "seen from the centre";
        const Vec3d face = cross(corner[1] - corner[0], corner[2] - corner[0]);
        for (std::size_t i = 0; i < 3; ++i) {
            least = std::min(least, length(corner[i]));
            most = std::max(most, length(corner[i]));
            const Vec3d normal = to_double(model.normals[triangle.vertex.at(i)]);
            EXPECT_GT(dot(face, normal), 0.999 * length(face));
        }
    }
    EXPECT_GT(least, 0.85);
    EXPECT_LT(most, 1.15);
    EXPECT_GT(most - least, 0.15);
}

TEST(Concave, HasUpToFiveCrossingsAndAnOpening) {
    const Model model = make_sample("concave", 3);
    Vec3d low = to_double(model.positions[0]), high = low;
    for (const Vec3f& p : model.positions) {
        low = {std::min(low.x, double(p.x)), std::min(low.y, double(p.y)), std::min(low.z, double(p.z))};
        high = {std::max(high.x, double(p.x)), std::max(high.y, double(p.y)), std::max(high.z, double(p.z))};
    }
    const Vec3d center = (low + high) * 0.5;
    EXPECT_EQ(crossings(model, center, {1, 0.01, 0.13}), 5);
    EXPECT_EQ(crossings(model, center, {0.01, 1, 0.02}), 1);
    EXPECT_EQ(crossings(model, center, {0.7, 0.63, 0.1}), 1) << "over the rim";
}

} // namespace
