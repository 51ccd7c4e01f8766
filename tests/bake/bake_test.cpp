// SPDX-License-Identifier: Apache-2.0
// Whole bakes, judged by the shapes that were put in.
#include "../../libspa/bake/bake.h"
#include "../../libspa/bake/center.h"
#include "../../libspa/core/cell_triangles.h"
#include "../../libspa/core/error.h"
#include "../../libspa/mesh/closest_point.h"
#include "../support/shapes.h"

#include <gtest/gtest.h>

#include <numbers>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace spa::bake {
namespace {

Options small(std::uint32_t layers = 2) {
    Options options;
    options.grid = options.color_grid = {Mapping::octahedral, 65, 65};
    options.layers = layers;
    return options;
}

Options small_latlong() {
    Options options;
    options.grid = options.color_grid = {Mapping::latlong, 80, 60};
    return options;
}

double depth(const Surface& surface, std::uint32_t x, std::uint32_t y) {
    return double(decode_depth(surface.depth.format, surface.depth.at(x, y)));
}

std::vector<std::byte> all_bytes(const SphericalMap& map) {
    std::vector<std::byte> bytes;
    for (const Part& part : map.parts) {
        bytes.insert(bytes.end(), part.mixed.begin(), part.mixed.end());
        for (const Layer& layer : part.layers) {
            for (const Surface* s : {&layer.outer, &layer.inner}) {
                for (const ImageView* v : {&s->color, &s->depth, &s->normal}) {
                    bytes.insert(bytes.end(), v->bytes.begin(), v->bytes.end());
                }
            }
        }
    }
    return bytes;
}

Model box(Vec3f low, Vec3f high) {
    Model model = test::empty_model();
    test::add_box(model, low, high);
    return model;
}

// Hard case 32: a sphere is constant; 23: its vertices at r = R get the top code and are not clipped.
TEST(Bake, ASphereIsConstantWithinItsFacets) {
    Model model = test::empty_model();
    test::add_sphere(model, {5, 6, 7}, 3, 128);
    const Result result = bake_model(model, small());
    const Part& part = result.map.map.parts.at(0);
    EXPECT_NEAR(length(part.center - Vec3d{5, 6, 7}), 0, 1e-6);
    EXPECT_NEAR(part.radius, 3, 1e-5);
    ASSERT_EQ(part.layers.size(), 1U);
    EXPECT_TRUE(part.layers[0].inner.empty());
    double top = 0;
    for (std::uint32_t y = 0; y < 65; ++y) {
        for (std::uint32_t x = 0; x < 65; ++x) {
            const double d = depth(part.layers[0].outer, x, y);
            ASSERT_GT(d, 0.9995);
            top = std::max(top, d);
        }
    }
    EXPECT_EQ(top, 1.0);
    EXPECT_EQ(result.report.layers.at(0).outer_coverage, 1.0);
    EXPECT_TRUE(result.report.center_inside);
    EXPECT_TRUE(part.center_inside);
    EXPECT_EQ(part.mixed.size(), 64U * 64U / 4U);
    EXPECT_EQ(result.report.mixed_triangles, 0.0);
    EXPECT_TRUE(result.report.warnings.empty());
}

// One layer says it as two do, though it does not see what lies below the surface.
TEST(Bake, WhetherTheCentreIsInsideDoesNotDependOnLayers) {
    struct Case {
        const char* name;
        Model model;
        bool inside;
    };
    std::vector<Case> cases;
    const auto add = [&](const char* name, bool inside) -> Model& {
        cases.push_back({name, test::empty_model(), inside});
        return cases.back().model;
    };
    const auto open_above = [](Model& model, float height) {
        std::erase_if(model.triangles, [&](const Triangle& t) {
            float y = 0;
            for (const std::uint32_t v : t.vertex) y += model.positions[v].y;
            return y > 3 * height;
        });
        model.triangle_materials.resize(model.triangles.size());
    };
    test::add_box(add("box", true), {-1, -2, -3}, {1, 2, 3});
    test::add_sphere(add("sphere", true), {}, 1, 64);
    test::add_sphere(add("inside out", true), {}, 1, 64, true);
    test::add_torus(add("torus", false), 1, 0.4F, 48);
    Model& cup = add("cup", true);
    test::add_sphere(cup, {}, 1, 64);
    open_above(cup, 0.7F);
    Model& half = add("half", false);
    test::add_sphere(half, {}, 1, 64);
    open_above(half, 0);
    // Keeps the middle of the bounding box where it is.
    test::add_quad(half, {0, 1, 0}, {1e-3F, 1, 0}, {1e-3F, 1, 1e-3F}, {0, 1, 1e-3F});
    Model& two = add("beside each other", false);
    test::add_box(two, {-2, -1, -1}, {-1, 1, 1});
    test::add_box(two, {1, -1, -1}, {2, 1, 1});
    // The winding number is one third, of each piece a sixth.
    Model& pieces = add("pieces", false);
    test::add_quad(pieces, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1});
    test::add_quad(pieces, {1, -1, -1}, {-1, -1, -1}, {-1, 1, -1}, {1, 1, -1});
    for (const Case& c : cases) {
        for (const std::uint32_t layers : {1U, 2U, 4U}) {
            for (const unsigned threads : {1U, 0U}) {
                Options options = small(layers);
                options.threads = threads;
                const Result result = bake_model(c.model, options);
                EXPECT_EQ(result.report.center_inside, c.inside) << c.name << ", " << layers;
                EXPECT_EQ(result.map.map.parts.at(0).center_inside, c.inside) << c.name << ", " << layers;
            }
        }
    }
}

// Hard case 33 without the rotation: every sample of a box is exact to its code.
TEST(Bake, BoxFacesAreExact) {
    const Model model = box({-1, -2, -3}, {1, 2, 3});
    const Vec3d half{1, 2, 3};
    for (const Options& options : {small(), small_latlong()}) {
        const Result result = bake_model(model, options);
        const Part& part = result.map.map.parts.at(0);
        const Surface& outer = part.layers.at(0).outer;
        // No cliffs, so only the edges of walls seen at a flat angle are mixed. A lat-long map does not say.
        const bool octahedral = options.grid.mapping == Mapping::octahedral;
        EXPECT_EQ(result.report.mixed_triangles.has_value(), octahedral);
        EXPECT_EQ(part.mixed.empty(), !octahedral);
        EXPECT_LT(mixed_share(part.mixed), 0.005);
        for (std::uint32_t y = 0; y < options.grid.height; ++y) {
            for (std::uint32_t x = 0; x < options.grid.width; ++x) {
                const Vec3d u = normalize(sample_direction(options.grid, {x, y}));
                const double r =
                    std::min({half.x / std::abs(u.x), half.y / std::abs(u.y), half.z / std::abs(u.z)});
                ASSERT_NEAR(depth(outer, x, y), r / part.radius,
                            depth_quantum_error(ElementFormat::u16) + 2e-7);
            }
        }
    }
}

// Hard case 21: a change of scale by a power of two changes nothing but the radius.
TEST(Bake, ScaleDoesNotMatter) {
    Model model = test::random_soup(200, 3);
    const auto bytes = all_bytes(bake_model(model, small()).map.map);
    for (const float scale : {0x1p-20F, 0x1p20F}) {
        Model scaled = model;
        for (Vec3f& p : scaled.positions) p = p * scale;
        EXPECT_EQ(all_bytes(bake_model(scaled, small()).map.map), bytes) << scale;
    }
}

TEST(Bake, EveryThreadCountGivesTheSameBytes) {
    Model model = test::random_soup(2000, 4);
    test::add_random_texture(model, 64, 5);
    Options options = small();
    options.samples = 2;
    options.threads = 1;
    const auto one = all_bytes(bake_model(model, options).map.map);
    options.threads = 2;
    EXPECT_EQ(all_bytes(bake_model(model, options).map.map), one);
}

TEST(Bake, IdentifiedBorderSamplesAreEqualInEveryImage) {
    Model model = test::random_soup(300, 14);
    test::add_random_texture(model, 64, 5);
    Options options = small();
    options.samples = 2;
    const Result result = bake_model(model, options);
    for (const Layer& layer : result.map.map.parts.at(0).layers) {
        for (const Surface* s : {&layer.outer, &layer.inner}) {
            for (const ImageView* v : {&s->color, &s->depth, &s->normal}) {
                if (v->empty()) continue;
                for (std::uint32_t y = 0; y < v->height; ++y) {
                    for (std::uint32_t x = 0; x < v->width; ++x) {
                        const TexelIndex twin = canonical(options.grid, {x, y});
                        ASSERT_EQ(std::memcmp(v->at(x, y), v->at(twin.x, twin.y), element_size(v->format)), 0)
                            << x << "," << y << " " << name(v->format);
                    }
                }
            }
        }
    }
}

TEST(Bake, AFlatObjectIsSeen) {
    Model model = test::empty_model();
    test::add_quad(model, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}); // faces +Y
    for (const std::uint32_t layers : {1U, 2U}) {
        const Result result = bake_model(model, small(layers));
        EXPECT_LT(result.map.map.parts.at(0).center.y, 0);
        EXPECT_GT(result.report.layers.at(0).outer_coverage, 0.2);
        EXPECT_EQ(result.report.back_facing_samples, 0U);
        EXPECT_FALSE(result.report.warnings.empty());
    }
}

// Hard case 24.
TEST(Bake, ACentreOnTheSurfaceIsMovedOffIt) {
    Model model = box({-1, -1, -1}, {1, 1, 1});
    test::add_quad(model, {-1, -1, 1e-6F}, {1, -1, 1e-6F}, {1, 1, 1e-6F}, {-1, 1, 1e-6F}); // faces +Z
    const Result result = bake_model(model, small());
    const Vec3d center = result.map.map.parts.at(0).center;
    EXPECT_NEAR(center.z, -std::sqrt(3.0) / 16, 1e-6); // against the normal
    EXPECT_NEAR(center.x, 0, 1e-12);
    EXPECT_NEAR(result.report.center_moved, 1.0 / 16, 1e-6);
    EXPECT_FALSE(result.report.center_on_surface);
    EXPECT_EQ(result.report.edge_on_triangles, 0U);
    EXPECT_EQ(result.report.warnings.size(), 1U);
    EXPECT_EQ(bake_model(box({-1, -1, -1}, {1, 1, 1}), small()).report.center_moved, 0);
}

// On an edge of the surface the two faces' normals count alike; the way out is taken where the way in is
// shut.
TEST(Bake, TheMoveOffTheSurfaceIsClearOfAllOfIt) {
    const auto distance = [](const Model& model, Vec3d p) {
        double least = 1e9;
        for (const Triangle& t : model.triangles) {
            const auto corner = [&](unsigned k) { return to_double(model.positions[t.vertex[k]]); };
            least =
                std::min(least, length(closest_point_on_triangle(p, corner(0), corner(1), corner(2)) - p));
        }
        return least;
    };
    const Model cube = box({-1, -1, -1}, {1, 1, 1});
    const Vec3d from_edge = center_off_surface(cube, {1, 1, 0});
    EXPECT_NEAR(from_edge.x, from_edge.y, 1e-12);
    EXPECT_LT(from_edge.x, 1);
    EXPECT_GE(distance(cube, from_edge), std::sqrt(5.0 + 4.0) / 32 * (1 - 1e-9));
    const Vec3d from_plate = center_off_surface(box({-1, -1, -0.04F}, {1, 1, 0.04F}), {0, 0, 0.04});
    EXPECT_NEAR(from_plate.z - 0.04, std::sqrt(2.0 + 0.08 * 0.08) / 16, 1e-6);
}

// A sheet whose plane holds the centre has no direction from which it can be seen.
TEST(Bake, EdgeOnTrianglesAreCounted) {
    Model model = box({-1, -1, -1}, {1, 1, 1});
    test::add_quad(model, {0.5F, -1, 0}, {1, -1, 0}, {1, 1, 0}, {0.5F, 1, 0});
    EXPECT_EQ(bake_model(model, small()).report.edge_on_triangles, 2U);
}

// Hard case 25.
TEST(Bake, ANeedleThinnerThanTheSamplingIsCounted) {
    Model model = box({-1, -1, -1}, {1, 1, 1});
    test::add_box(model, {0.61F, 1.2F, 0.3F}, {0.611F, 2, 0.301F});
    const Report report = bake_model(model, small()).report;
    EXPECT_EQ(report.components, 2U);
    EXPECT_EQ(report.unseen_components, 1U);
    EXPECT_FALSE(report.warnings.empty());
}

TEST(Bake, OpenEdgesAreCounted) {
    Model model = box({-1, -1, -1}, {1, 1, 1});
    EXPECT_EQ(bake_model(model, small()).report.open_edges, 0U);
    model.triangles.pop_back();
    model.triangle_materials.pop_back();
    EXPECT_EQ(bake_model(model, small()).report.open_edges, 3U);
}

TEST(Bake, OneLayerHasNoInnerSurfaceAndTwoKeepATorusOpen) {
    Model model = test::empty_model();
    test::add_torus(model, 2, 0.5F, 64);
    const Result one = bake_model(model, small(1));
    EXPECT_TRUE(one.map.map.parts.at(0).layers.at(0).inner.empty());
    const Result two = bake_model(model, small(2));
    const auto& layers = two.map.map.parts.at(0).layers;
    ASSERT_EQ(layers.size(), 1U); // one interval along every direction
    EXPECT_FALSE(layers[0].inner.empty());
    EXPECT_NEAR(two.report.layers.at(0).inner_coverage, two.report.layers.at(0).outer_coverage, 1e-12);
}

// Coverage with sub-texel samples estimates the covered solid angle far better than one sample a texel.
TEST(Bake, SubTexelSamplesGiveFractionalCoverage) {
    Model model = test::empty_model();
    test::add_quad(model, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1});
    Options options = small();
    options.grid = options.color_grid = {Mapping::octahedral, 17, 17};
    const auto covered = [&](std::uint32_t samples) {
        options.samples = samples;
        const Result result = bake_model(model, options);
        const ImageView color = result.map.map.parts.at(0).layers.at(0).outer.color;
        double sum = 0;
        for (std::uint32_t y = 0; y < 17; ++y) {
            for (std::uint32_t x = 0; x < 17; ++x) {
                sum +=
                    std::to_integer<int>(color.at(x, y)[3]) / 255.0 * solid_angle(options.color_grid, {x, y});
            }
        }
        return sum;
    };
    // The centre is moved 1/2 behind the quad: 4 asin(a^2 / (1 + a^2)), a = 2.
    const double exact = 4 * std::asin(0.8);
    EXPECT_NEAR(covered(5), exact, 0.1);
    EXPECT_GT(std::abs(covered(1) - exact), std::abs(covered(5) - exact));
    EXPECT_NEAR(covered(4), exact, 0.15);
}

TEST(Bake, ColourIsDilatedPastSilhouettes) {
    Model model = test::empty_model();
    test::add_quad(model, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1});
    model.materials[0].base_color = {1, 0, 0, 1};
    const Result result = bake_model(model, small());
    const ImageView color = result.map.map.parts.at(0).layers.at(0).outer.color;
    std::size_t outside = 0;
    for (std::uint32_t y = 1; y < 64; ++y) {
        for (std::uint32_t x = 1; x < 64; ++x) {
            if (color.at(x, y)[3] != std::byte{0}) continue;
            for (const auto& [nx, ny] :
                 {std::pair{x - 1, y}, std::pair{x + 1, y}, std::pair{x, y - 1}, std::pair{x, y + 1}}) {
                if (color.at(nx, ny)[3] == std::byte{0}) continue;
                ASSERT_EQ(color.at(x, y)[0], std::byte{255});
                ++outside;
            }
        }
    }
    EXPECT_GT(outside, 50U);
}

TEST(Bake, ColourMayBeFinerThanDepth) {
    Options options = small();
    options.color_grid = {Mapping::octahedral, 129, 129};
    const Result result = bake_model(box({-1, -1, -1}, {1, 1, 1}), options);
    const Surface& outer = result.map.map.parts.at(0).layers.at(0).outer;
    EXPECT_EQ(outer.color.width, 129U);
    EXPECT_EQ(outer.depth.width, 65U);
    EXPECT_EQ(outer.normal.width, 65U);
}

// In its affine frame an elongated box is a cube, whatever its orientation.
TEST(Bake, TheAffineFrameMakesABoxACube) {
    Model model = box({-8, -1, -0.5F}, {8, 1, 0.5F});
    for (Vec3f& p : model.positions) p = {p.x * 0.6F - p.y * 0.8F, p.x * 0.8F + p.y * 0.6F, p.z};
    for (Vec3f& n : model.normals) n = {n.x * 0.6F - n.y * 0.8F, n.x * 0.8F + n.y * 0.6F, n.z};
    Options options = small();
    options.frame = Frame::affine;
    const Result result = bake_model(model, options);
    const Part& part = result.map.map.parts.at(0);
    EXPECT_NEAR(part.radius, 8 * std::sqrt(3.0), 1e-4);
    EXPECT_GT(determinant(part.frame), 0);
    const Surface& outer = part.layers.at(0).outer;
    const Mat3 to_object = part.frame;
    for (std::uint32_t y = 0; y < 65; ++y) {
        for (std::uint32_t x = 0; x < 65; ++x) {
            const Vec3d u = normalize(sample_direction(options.grid, {x, y}));
            const Vec3d p = part.center + to_object * (u * (depth(outer, x, y) * part.radius));
            const Vec3d local{p.x * 0.6 + p.y * 0.8, p.y * 0.6 - p.x * 0.8, p.z};
            const double face = std::max({std::abs(local.x) / 8, std::abs(local.y), std::abs(local.z) * 2});
            ASSERT_NEAR(face, 1, 1e-4);
        }
    }
}

TEST(Bake, NothingToBakeIsAnError) {
    Model none = test::empty_model();
    EXPECT_THROW(bake_model(none, small()), Error);
    Model point = test::empty_model();
    test::add_quad(point, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1});
    EXPECT_THROW(bake_model(point, small()), Error);
}

TEST(Bake, CancellingThrows) {
    EXPECT_THROW(bake_model(test::random_soup(3000, 1), small(), [](double) { return false; }), Cancelled);
}

// A sphere as modelling programs write it: a column of vertices at either end of the seam and a ring of them
// at each pole, from sines of multiples of pi that are not quite 0.
TEST(Bake, SeamsWithRoundingNoiseAreClosed) {
    constexpr std::uint32_t columns = 32;
    constexpr std::uint32_t rows = 16;
    Model model = test::empty_model();
    for (std::uint32_t y = 0; y <= rows; ++y) {
        for (std::uint32_t x = 0; x <= columns; ++x) {
            const double phi = 2 * std::numbers::pi * x / columns;
            const double theta = std::numbers::pi * y / rows;
            const Vec3d p{-std::cos(phi) * std::sin(theta), std::cos(theta), std::sin(phi) * std::sin(theta)};
            model.positions.push_back(to_float(p));
            model.normals.push_back(to_float(normalize(p)));
        }
    }
    for (std::uint32_t y = 0; y < rows; ++y) {
        for (std::uint32_t x = 0; x < columns; ++x) {
            const std::uint32_t a = y * (columns + 1) + x;
            const std::uint32_t b = a + columns + 1;
            model.triangles.push_back({{a, b, b + 1}});
            model.triangles.push_back({{a, b + 1, a + 1}});
        }
    }
    model.triangle_materials.resize(model.triangles.size(), 0);
    ASSERT_NE(model.positions[columns * 1 + rows / 2 * (columns + 1)],
              model.positions[rows / 2 * (columns + 1)]);
    for (const std::uint32_t size : {65U, 129U, 257U}) {
        Options options;
        options.grid = options.color_grid = {Mapping::octahedral, size, size};
        const Result baked = bake_model(model, options);
        EXPECT_EQ(baked.report.layers.at(0).outer_coverage, 1);
        EXPECT_EQ(baked.report.thin_samples, 0U);
        const ImageView& depth = baked.map.map.parts[0].layers[0].outer.depth;
        for (std::uint32_t y = 0; y < size; ++y)
            for (std::uint32_t x = 0; x < size; ++x)
                ASSERT_GT(decode_depth(depth.format, depth.at(x, y)), 0.98) << x << " " << y;
    }
}

} // namespace
} // namespace spa::bake
