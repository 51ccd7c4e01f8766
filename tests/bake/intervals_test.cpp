// SPDX-License-Identifier: Apache-2.0
// Pairing of crossings into intervals, on shapes whose intervals are known.
#include "../../libspa/bake/center.h"
#include "../../libspa/bake/intervals.h"
#include "../../libspa/bake/radial.h"
#include "../support/shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spa::bake {
namespace {

constexpr Grid grid{Mapping::octahedral, 65, 65};

struct Paired {
    SurfaceGrid surfaces;
    IntervalStatistics statistics;
    Orientation orientation;
    double scale = 1; // radius of the part
    [[nodiscard]] double radius(std::size_t surface, TexelIndex t) const {
        return double(surfaces.surfaces[surface][std::size_t(t.y) * grid.width + t.x].radius) * scale;
    }
    [[nodiscard]] Vec3f normal(std::size_t surface, TexelIndex t) const {
        return surfaces.surfaces[surface][std::size_t(t.y) * grid.width + t.x].normal;
    }
};

Paired pair(const Model& model, std::uint32_t layers, Vec3d center = {}) {
    Paired result;
    const PartFrame part = make_part_frame(model, center, false);
    const CrossingGrid crossings = cast_radial(center_model(model, part), grid, {.outermost_only = false});
    const Components components = find_components(model);
    result.scale = part.radius;
    result.orientation = orient_components(crossings, components);
    result.surfaces = pair_intervals(crossings, components, result.orientation, layers, result.statistics);
    return result;
}

template <class Visit>
void each_texel(Visit&& visit) {
    for (std::uint32_t y = 0; y < grid.height; ++y) {
        for (std::uint32_t x = 0; x < grid.width; ++x) {
            visit(TexelIndex{x, y}, normalize(sample_direction(grid, {x, y})));
        }
    }
}

TEST(Intervals, ASolidSphereReachesTheCentre) {
    Model model = test::empty_model();
    test::add_sphere(model, {}, 2, 64);
    const Paired p = pair(model, 2);
    each_texel([&](TexelIndex t, Vec3d u) {
        ASSERT_NEAR(p.radius(0, t), 2, 0.01);
        ASSERT_EQ(p.radius(1, t), 0);
        ASSERT_EQ(p.radius(2, t), 0);
        ASSERT_GT(dot(to_double(p.normal(0, t)), u), 0.99);
    });
    EXPECT_TRUE(p.orientation.solid[0]);
    EXPECT_EQ(p.statistics.thin_samples, 0U);
}

TEST(Intervals, AnInsideOutSphereIsTheSame) {
    Model model = test::empty_model();
    test::add_sphere(model, {}, 2, 64, true);
    const Paired p = pair(model, 2);
    EXPECT_TRUE(p.orientation.flipped[0]);
    each_texel([&](TexelIndex t, Vec3d u) {
        ASSERT_NEAR(p.radius(0, t), 2, 0.01);
        ASSERT_EQ(p.radius(1, t), 0);
        ASSERT_GT(dot(to_double(p.normal(0, t)), u), 0.99);
    });
}

TEST(Intervals, ASeparateSphereBesideTheCentreIsTwoEndsOfOneInterval) {
    Model model = test::empty_model();
    test::add_sphere(model, {0, 0, 0}, 0.5F, 48);
    test::add_sphere(model, {0, 0, 3}, 1, 64);
    const Paired p = pair(model, 2);
    const TexelIndex front{32, 32};
    EXPECT_NEAR(p.radius(0, front), 4, 0.01);
    EXPECT_NEAR(p.radius(1, front), 2, 0.01);
    EXPECT_NEAR(p.radius(2, front), 0.5, 0.01);
    EXPECT_EQ(p.radius(3, front), 0);
    EXPECT_GT(p.normal(0, front).z, 0.99F);
    EXPECT_LT(p.normal(1, front).z, -0.99F);
    const TexelIndex side{64, 32};
    EXPECT_NEAR(p.radius(0, side), 0.5, 0.01);
    EXPECT_EQ(p.radius(1, side), 0);
    EXPECT_EQ(p.statistics.truncated_samples, 0U);
}

TEST(Intervals, OverlappingPiecesAreUnited) {
    Model model = test::empty_model();
    test::add_box(model, {-1, -1, 2}, {1, 1, 4});
    test::add_box(model, {-0.5F, -0.5F, 3}, {0.5F, 0.5F, 5});
    test::add_box(model, {-0.5F, -0.5F, 1}, {0.5F, 0.5F, 2}); // touches the first
    const Paired p = pair(model, 3);
    const TexelIndex front{32, 32};
    EXPECT_NEAR(p.radius(0, front), 5, 1e-5);
    EXPECT_NEAR(p.radius(1, front), 1, 1e-5);
    EXPECT_EQ(p.radius(2, front), 0);
}

// Hard case 27.
TEST(Intervals, ATorusKeepsItsHole) {
    Model model = test::empty_model();
    test::add_torus(model, 2, 0.5F, 96);
    const Paired p = pair(model, 2);
    EXPECT_FALSE(p.orientation.solid[0]);
    EXPECT_FALSE(p.orientation.flipped[0]);
    std::size_t compared = 0;
    each_texel([&](TexelIndex t, Vec3d u) {
        // The line r u meets (sqrt(x^2 + z^2) - 2)^2 + y^2 = 1/4 where r^2 - 4 r s + 15/4 = 0, s = |(u.x,
        // u.z)|.
        const double s = std::hypot(u.x, u.z);
        const double root = 4 * s * s - 3.75;
        if (std::abs(root) < 0.05) return; // grazes the facets
        ++compared;
        ASSERT_NEAR(p.radius(0, t), root > 0 ? 2 * s + std::sqrt(root) : 0, 0.02);
        ASSERT_NEAR(p.radius(1, t), root > 0 ? 2 * s - std::sqrt(root) : 0, 0.02);
        ASSERT_EQ(p.radius(2, t), 0);
    });
    EXPECT_GT(compared, 4000U);
}

TEST(Intervals, AnOpenSheetIsAThinShellFacingBothWays) {
    Model model = test::empty_model();
    test::add_quad(model, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1});
    test::add_quad(model, {-1, 1, -1}, {1, 1, -1}, {1, -1, -1}, {-1, -1, -1});
    const Paired p = pair(model, 2);
    for (const auto& [texel, sign] :
         {std::pair{TexelIndex{32, 32}, 1.0F}, std::pair{TexelIndex{0, 0}, -1.0F}}) {
        EXPECT_NEAR(p.radius(0, texel), 1, 1e-6);
        EXPECT_NEAR(p.radius(1, texel), 1 - double(shell_thickness) * p.scale, 1e-6);
        EXPECT_EQ(p.normal(0, texel).z, sign);
        EXPECT_EQ(p.normal(1, texel).z, -sign);
        EXPECT_EQ(p.radius(2, texel), 0);
    }
    EXPECT_GT(p.statistics.thin_samples, 0U);
}

// Hard case 28: an open cup is solid to the centre if the surface surrounds the centre, and a shell if not.
TEST(Intervals, AnOpenBoxIsSolidOnlyIfItSurroundsTheCentre) {
    Model model = test::empty_model();
    test::add_box(model, {-1, -1, -1}, {1, 1, 1});
    model.triangles.resize(10); // without its last face, -Y
    model.triangle_materials.resize(10);
    const TexelIndex front{32, 32};
    EXPECT_EQ(pair(model, 2).radius(1, front), 0);
    EXPECT_GT(pair(model, 2, {0, -3, 0}).radius(1, {32, 8}), 0);
}

TEST(Intervals, MoreIntervalsThanLayersAreCounted) {
    Model model = test::empty_model();
    for (const float z : {1.0F, 2.0F, 3.0F}) test::add_box(model, {-1, -1, z}, {1, 1, z + 0.5F});
    const Paired p = pair(model, 2);
    EXPECT_GT(p.statistics.truncated_samples, 0U);
    EXPECT_NEAR(p.radius(0, {32, 32}), 3.5, 1e-5);
    EXPECT_NEAR(p.radius(3, {32, 32}), 2, 1e-5);
    EXPECT_EQ(pair(model, 3).statistics.truncated_samples, 0U);
}

TEST(Intervals, OneLayerTurnsBackFacesOut) {
    Model model = test::empty_model();
    test::add_sphere(model, {}, 1, 32, true);
    const PartFrame part = make_part_frame(model, {}, false);
    const SurfaceGrid surface = outermost_surface(cast_radial(center_model(model, part), grid, {}));
    ASSERT_EQ(surface.surfaces.size(), 1U);
    each_texel([&](TexelIndex t, Vec3d u) {
        ASSERT_GT(dot(to_double(surface.surfaces[0][std::size_t(t.y) * grid.width + t.x].normal), u), 0.98);
    });
}

} // namespace
} // namespace spa::bake
