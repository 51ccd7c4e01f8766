// SPDX-License-Identifier: Apache-2.0
// The radial baker against brute force: every ray against every triangle, by another formula.
#include "../../libspa/bake/candidates.h"
#include "../../libspa/bake/center.h"
#include "../../libspa/bake/radial.h"
#include "../support/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace spa::bake {
namespace {

struct RayHit {
    double radius = 0;
    std::uint32_t triangle = no_index;
};

enum class Verdict { miss, hit, edge };

// Moeller & Trumbore 1997 from the origin, in double. `edge`: within rounding of the triangle's border.
Verdict intersect(const CenteredModel& model, std::uint32_t triangle, Vec3d u, double& radius) {
    const auto corner = [&](unsigned k) {
        return to_double(model.positions[model.model->triangles[triangle].vertex[k]]);
    };
    const Vec3d a = corner(0);
    const Vec3d e1 = corner(1) - a;
    const Vec3d e2 = corner(2) - a;
    const Vec3d p = cross(u, e2);
    const double det = dot(e1, p);
    if (std::abs(det) < 1e-14) return Verdict::edge;
    const Vec3d s = -a;
    const double v = dot(s, p) / det;
    const Vec3d q = cross(s, e1);
    const double w = dot(u, q) / det;
    radius = dot(e2, q) / det;
    const double margin = std::min({v, w, 1 - v - w});
    if (radius <= 0 || margin < -1e-9) return Verdict::miss;
    return margin < 1e-9 || radius < 1e-9 ? Verdict::edge : Verdict::hit;
}

CenteredModel centered(const Model& model, bool affine = false) {
    bool moved = false;
    return center_model(model, make_part_frame(model, bounds_center(model, moved), affine));
}

void compare_with_brute_force(const Model& model, const Grid& grid) {
    const CenteredModel scene = centered(model);
    const CrossingGrid outermost = cast_radial(scene, grid, {.outermost_only = true});
    const CrossingGrid all = cast_radial(scene, grid, {.outermost_only = false});
    std::size_t compared = 0;
    for (std::uint32_t y = 0; y < grid.height; ++y) {
        for (std::uint32_t x = 0; x < grid.width; ++x) {
            const Vec3d u = normalize(sample_direction(grid, {x, y}));
            std::vector<RayHit> hits;
            bool ambiguous = false;
            for (std::uint32_t t = 0; t < model.triangles.size(); ++t) {
                double r = 0;
                const Verdict verdict = intersect(scene, t, u, r);
                if (verdict == Verdict::hit) hits.push_back({r, t});
                ambiguous = ambiguous || verdict == Verdict::edge;
            }
            if (ambiguous) continue;
            ++compared;
            std::sort(hits.begin(), hits.end(), [](auto a, auto b) { return a.radius > b.radius; });
            const std::size_t s = std::size_t(y) * grid.width + x;
            ASSERT_EQ(all.first[s + 1] - all.first[s], hits.size()) << x << "," << y;
            ASSERT_EQ(outermost.first[s + 1] - outermost.first[s], hits.empty() ? 0U : 1U);
            for (std::size_t k = 0; k < hits.size(); ++k) {
                const Crossing& c = all.crossings[all.first[s] + k];
                ASSERT_NEAR(double(c.radius), hits[k].radius, 2e-7);
                if (k > 0 && hits[k - 1].radius - hits[k].radius < 1e-5) continue;
                if (k + 1 < hits.size() && hits[k].radius - hits[k + 1].radius < 1e-5) continue;
                ASSERT_EQ(c.triangle, hits[k].triangle);
            }
            if (!hits.empty()) {
                ASSERT_NEAR(double(outermost.crossings[outermost.first[s]].radius), hits[0].radius, 2e-7);
            }
        }
    }
    EXPECT_GT(compared, std::size_t(grid.width) * grid.height * 9 / 10);
}

const Grid octahedral{Mapping::octahedral, 41, 41};
const Grid latlong{Mapping::latlong, 50, 31};

TEST(Radial, RandomSoupsEqualBruteForce) {
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
        for (const Grid& grid : {octahedral, latlong})
            compare_with_brute_force(test::random_soup(80, seed), grid);
    }
}

// Dense small triangles: each covers a sample or none, so the candidate boxes have no slack to hide in.
TEST(Radial, DenseSpheresEqualBruteForce) {
    Model model = test::empty_model();
    test::add_sphere(model, {0.3F, -0.2F, 0.1F}, 1, 24);
    test::add_sphere(model, {-0.5F, 0.4F, 0.2F}, 0.7F, 16);
    for (const Grid& grid : {octahedral, latlong}) compare_with_brute_force(model, grid);
}

// Hard case 31: triangles that hold a pole or an axis, or span more than 90 degrees, leave no hole.
// Positions on the map are approximate; what they cost must be covered on maps of any size.
TEST(Radial, CandidatesHoldTheSamplesUnderTheirCorners) {
    for (const Grid& grid : {Grid{Mapping::latlong, 16384, 8192}, Grid{Mapping::latlong, 640, 480},
                             Grid{Mapping::latlong, 3, 5000}, Grid{Mapping::octahedral, 8193, 8193}}) {
        std::vector<Vec3f> positions;
        std::vector<TexelIndex> samples;
        for (std::uint32_t i = 0; i < 20000; ++i) {
            samples.push_back({(i * 2654435761U >> 8U) % grid.width, (i * 40503U >> 3U) % grid.height});
            const Vec3d u = normalize(sample_direction(grid, samples.back()));
            // Around the sample and much smaller than one.
            const Vec3d side = normalize(cross(u, Vec3d{0.3, 0.5, 0.8})) * 1e-6;
            for (const Vec3d& p :
                 {u + side, u - side * 0.5 + cross(u, side), u - side * 0.5 - cross(u, side)})
                positions.push_back(to_float(p * 0.7));
        }
        const Candidates candidates(grid, positions);
        for (std::uint32_t i = 0; i < samples.size(); ++i) {
            std::array<SampleRect, Candidates::max_rects> rects;
            const std::size_t count = candidates.find({{3 * i, 3 * i + 1, 3 * i + 2}}, rects);
            const TexelIndex at = samples[i];
            ASSERT_TRUE(std::any_of(rects.begin(), rects.begin() + std::ptrdiff_t(count),
                                    [&](const SampleRect& r) {
                                        return at.x >= r.x0 && at.x <= r.x1 && at.y >= r.y0 && at.y <= r.y1;
                                    }))
                << at.x << ' ' << at.y << " of " << grid.width << 'x' << grid.height;
        }
    }
}

TEST(Radial, HugeTrianglesLeaveNoHole) {
    Model model = test::empty_model();
    const Vec3f a{0, 9, 0.01F};
    const Vec3f b{9, -3, -8};
    const Vec3f c{-9, -3, -8};
    const Vec3f d{0.02F, -3, 9};
    for (const auto& [p, q, r] :
         {std::array{a, b, c}, std::array{a, c, d}, std::array{a, d, b}, std::array{b, d, c}}) {
        model.triangles.push_back({});
        for (unsigned k = 0; k < 3; ++k) {
            model.triangles.back().vertex[k] = std::uint32_t(model.positions.size());
            model.positions.push_back(std::array{p, q, r}[k]);
            model.normals.push_back({0, 0, 1});
        }
        model.triangle_materials.push_back(0);
    }
    for (const Grid& grid :
         {octahedral, latlong, Grid{Mapping::octahedral, 3, 3}, Grid{Mapping::latlong, 2, 1}}) {
        const CrossingGrid cast = cast_radial(centered(model), grid, {.outermost_only = false});
        for (std::size_t s = 0; s + 1 < cast.first.size(); ++s)
            ASSERT_EQ(cast.first[s + 1] - cast.first[s], 1U) << s;
        if (grid.width > 3) compare_with_brute_force(model, grid);
    }
}

// Quads that end exactly in the planes x = 0 and y = 0 behind the centre: only one octant holds them, but two
// samples of the border share each direction along their edges.
Model sheets_at_the_fold() {
    Model model = test::empty_model();
    test::add_quad(model, {0, 0, -2}, {0, 1, -2}, {1, 1, -2}, {1, 0, -2});
    test::add_quad(model, {-0.0F, -1, -3}, {-0.0F, -0.0F, -3}, {-1, -0.0F, -3}, {-1, -1, -3});
    return model;
}

class RadialBorder : public testing::TestWithParam<bool> {};

// Hard case 7 and the rule of the format: identified border samples are equal bit by bit.
TEST_P(RadialBorder, IdentifiedSamplesAreEqual) {
    const Model model = GetParam() ? test::random_soup(60, 99) : sheets_at_the_fold();
    const CrossingGrid cast = cast_radial(center_model(model, make_part_frame(model, {}, false)), octahedral,
                                          {.outermost_only = false});
    EXPECT_GT(cast.crossings.size(), 50U);
    const auto list = [&](TexelIndex t) {
        const std::size_t s = std::size_t(t.y) * octahedral.width + t.x;
        return std::vector<Crossing>(cast.crossings.begin() + std::ptrdiff_t(cast.first[s]),
                                     cast.crossings.begin() + std::ptrdiff_t(cast.first[s + 1]));
    };
    for (std::uint32_t y = 0; y < octahedral.height; ++y) {
        for (std::uint32_t x = 0; x < octahedral.width; ++x) {
            const auto here = list({x, y});
            const auto there = list(canonical(octahedral, {x, y}));
            ASSERT_EQ(here.size(), there.size());
            for (std::size_t k = 0; k < here.size(); ++k) {
                ASSERT_EQ(here[k].radius, there[k].radius);
                ASSERT_EQ(here[k].triangle, there[k].triangle);
                ASSERT_EQ(here[k].normal, there[k].normal);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Models, RadialBorder, testing::Bool());

// A closed mesh has no pinhole, not even along shared edges and through vertices that lie exactly on samples.
TEST(Radial, ClosedMeshesAreWatertight) {
    Model sphere = test::empty_model();
    test::add_sphere(sphere, {}, 1, 32);
    Model box = test::empty_model();
    test::add_box(box, {-1, -1, -1}, {1, 1, 1});
    for (const Model* model : {&sphere, &box}) {
        for (const Grid& grid : {Grid{Mapping::octahedral, 129, 129}, Grid{Mapping::latlong, 128, 64}}) {
            const CrossingGrid cast = cast_radial(centered(*model), grid, {.outermost_only = false});
            for (std::size_t s = 0; s + 1 < cast.first.size(); ++s) {
                ASSERT_EQ(cast.first[s + 1] - cast.first[s], 1U) << s;
            }
        }
    }
}

// Hard case 29: duplicate faces give one crossing, of the first of them; double faces give two, front first.
TEST(Radial, DuplicateAndDoubleFaces) {
    Model model = test::empty_model();
    const Vec3f a{-1, -1, 1};
    const Vec3f b{1, -1, 1};
    const Vec3f c{1, 1, 1};
    const Vec3f d{-1, 1, 1};
    test::add_quad(model, a, b, c, d);
    test::add_quad(model, a, b, c, d);
    test::add_quad(model, d, c, b, a);
    const CrossingGrid cast = cast_radial(center_model(model, make_part_frame(model, {}, false)), octahedral,
                                          {.outermost_only = false});
    std::size_t covered = 0;
    for (std::size_t s = 0; s + 1 < cast.first.size(); ++s) {
        const std::size_t count = cast.first[s + 1] - cast.first[s];
        if (count == 0) continue;
        ++covered;
        ASSERT_EQ(count, 2U);
        const Crossing* crossing = &cast.crossings[cast.first[s]];
        EXPECT_TRUE(crossing[0].front_facing);
        EXPECT_LT(crossing[0].triangle, 2U);
        EXPECT_FALSE(crossing[1].front_facing);
        EXPECT_GE(crossing[1].triangle, 4U);
    }
    EXPECT_GT(covered, 100U);
}

TEST(Radial, EveryThreadCountGivesTheSameBits) {
    Model model = test::random_soup(3000, 5);
    test::add_random_texture(model, 32, 6);
    for (const bool outermost_only : {true, false}) {
        const CenteredModel scene = centered(model);
        const CrossingGrid one =
            cast_radial(scene, latlong, {.outermost_only = outermost_only, .threads = 1});
        const CrossingGrid four =
            cast_radial(scene, latlong, {.outermost_only = outermost_only, .threads = 4});
        ASSERT_EQ(one.first, four.first);
        for (std::size_t k = 0; k < one.crossings.size(); ++k) {
            ASSERT_EQ(one.crossings[k].radius, four.crossings[k].radius);
            ASSERT_EQ(one.crossings[k].triangle, four.crossings[k].triangle);
            ASSERT_EQ(one.crossings[k].normal, four.crossings[k].normal);
            ASSERT_EQ(one.crossings[k].color, four.crossings[k].color);
        }
    }
}

TEST(Radial, CancellingThrows) {
    const Model model = test::random_soup(5000, 5);
    EXPECT_THROW(cast_radial(centered(model), latlong, {.progress = [](double) { return false; }}),
                 Cancelled);
}

TEST(Radial, MaskedTexelsAreNoSurface) {
    Model model = test::empty_model();
    test::add_quad(model, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1});
    model.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    Texture texture;
    Image& image = texture.mips.emplace_back();
    image.width = 2;
    image.height = 1;
    image.pixels = {{255, 0, 0, 255}, {0, 255, 0, 0}};
    build_mips(texture);
    model.textures.push_back(texture);
    model.materials[0].texture = 0;
    model.materials[0].alpha_mode = AlphaMode::mask;
    model.materials[0].nearest = true;
    model.materials[0].wrap_u = Wrap::clamp_to_edge; // u = 1 is on samples
    const Grid grid{Mapping::octahedral, 257, 257};
    const CrossingGrid cast = cast_radial(center_model(model, make_part_frame(model, {}, false)), grid, {});
    for (std::size_t s = 0; s + 1 < cast.first.size(); ++s) {
        if (cast.first[s] == cast.first[s + 1]) continue;
        const Vec3d g = sample_direction(grid, {std::uint32_t(s % 257), std::uint32_t(s / 257)});
        ASSERT_LE(g.x, 1e-12);
        ASSERT_EQ(cast.crossings[cast.first[s]].color, (std::array<std::uint8_t, 4>{255, 0, 0, 255}));
    }
    EXPECT_GT(cast.crossings.size(), 1000U);
}

} // namespace
} // namespace spa::bake
