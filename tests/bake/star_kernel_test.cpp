// SPDX-License-Identifier: Apache-2.0
// Star kernels against brute force over all planes.
#include "../support/shapes.h"

#include "../../libspa/mesh/components.h"
#include "../../libspa/mesh/star_kernel.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace spa {
namespace {

struct Plane {
    Vec3d normal;
    double limit = 0;
};

std::vector<Plane> planes_of(const Model& model) {
    std::vector<Plane> planes;
    for (const Triangle& triangle : model.triangles) {
        const Vec3d a = to_double(model.positions[triangle.vertex[0]]);
        const Vec3d n = normalize(cross(to_double(model.positions[triangle.vertex[1]]) - a,
                                        to_double(model.positions[triangle.vertex[2]]) - a));
        if (!(n == Vec3d{})) planes.push_back({n, dot(n, a)});
    }
    return planes;
}

double depth_at(const std::vector<Plane>& planes, Vec3d x) {
    double depth = 1e300;
    for (const Plane& plane : planes) depth = std::min(depth, plane.limit - dot(plane.normal, x));
    return depth;
}

// The largest depth of all points that four planes determine, negative where the kernel is empty: an optimum
// of four variables is where four constraints hold with equality.
double deepest_by_brute_force(const std::vector<Plane>& planes) {
    double best = -1;
    const std::size_t n = planes.size();
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = i + 1; j < n; ++j) {
            for (std::size_t k = j + 1; k < n; ++k) {
                for (std::size_t l = k + 1; l < n; ++l) {
                    // The differences to the first do not hold the radius.
                    const Plane& p = planes[i];
                    Mat3 m;
                    m.row[0] = planes[j].normal - p.normal;
                    m.row[1] = planes[k].normal - p.normal;
                    m.row[2] = planes[l].normal - p.normal;
                    if (std::abs(determinant(m)) < 1e-9) continue;
                    const Vec3d x = inverse(m) * Vec3d{planes[j].limit - p.limit, planes[k].limit - p.limit,
                                                       planes[l].limit - p.limit};
                    const double radius = p.limit - dot(p.normal, x);
                    if (radius > best && depth_at(planes, x) > radius - 1e-9) best = radius;
                }
            }
        }
    }
    return best;
}

// A ball whose vertices were moved at random, 48 triangles: by little, and it stays star-shaped.
Model random_ball(std::uint32_t seed, double pull) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> shift(-pull, pull);
    std::normal_distribution<double> any;
    const Vec3d moved{any(random), any(random), any(random)};
    Model model = test::empty_model();
    constexpr std::uint32_t columns = 8, rows = 4;
    std::array<std::array<std::uint32_t, columns>, rows + 1> vertex{};
    for (std::uint32_t y = 0; y <= rows; ++y) {
        for (std::uint32_t x = 0; x < columns; ++x) {
            if ((y == 0 || y == rows) && x > 0) {
                vertex[y][x] = vertex[y][0];
                continue;
            }
            const double theta = std::numbers::pi * y / rows, phi = 2 * std::numbers::pi * x / columns;
            const Vec3d u{std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi)};
            vertex[y][x] = std::uint32_t(model.positions.size());
            model.positions.push_back(
                to_float(u + moved + Vec3d{shift(random), shift(random), shift(random)}));
        }
    }
    for (std::uint32_t y = 0; y < rows; ++y) {
        for (std::uint32_t x = 0; x < columns; ++x) {
            const std::uint32_t a = vertex[y][x], b = vertex[y + 1][x];
            const std::uint32_t c = vertex[y + 1][(x + 1) % columns], d = vertex[y][(x + 1) % columns];
            if (b != c) model.triangles.push_back({{a, b, c}});
            if (a != d) model.triangles.push_back({{a, c, d}});
        }
    }
    return model;
}

Vec3d random_point(std::mt19937& random, double size) {
    std::uniform_real_distribution<double> any(-size, size);
    const double x = any(random), y = any(random);
    return {x, y, any(random)};
}

TEST(StarKernel, IsThatOfBruteForce) {
    int with = 0, without = 0;
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
        const Model model = random_ball(seed, 0.05 + 0.06 * seed);
        const std::vector<Plane> planes = planes_of(model);
        const double deepest = deepest_by_brute_force(planes);
        const auto kernel = star_kernel(model, to_double(model.positions[0]));
        ASSERT_EQ(kernel.has_value(), deepest > 1e-6) << seed;
        ++(kernel ? with : without);
        if (!kernel) continue;
        EXPECT_NEAR(kernel->depth, deepest, 1e-6) << seed;
        EXPECT_GT(depth_at(planes, kernel->point), deepest / 2 - 1e-6) << seed;
    }
    EXPECT_GT(with, 3);
    EXPECT_GT(without, 3);
}

// No other point of half the depth is nearer to the one that was asked for, and a point that is deep enough
// itself is its own answer.
TEST(StarKernel, TakesTheNearestPointThatIsDeepEnough) {
    std::mt19937 random(3);
    for (std::uint32_t seed = 20; seed < 26; ++seed) {
        const Model model = random_ball(seed, 0.15);
        const std::vector<Plane> planes = planes_of(model);
        const Vec3d near = to_double(model.positions[seed % 7]);
        const auto kernel = star_kernel(model, near);
        ASSERT_TRUE(kernel);
        const double distance = length(kernel->point - near);
        for (int i = 0; i < 2000; ++i) {
            const Vec3d x = kernel->point + random_point(random, 0.3 * distance);
            if (depth_at(planes, x) < kernel->depth / 2) continue;
            EXPECT_GT(length(x - near), distance - 1e-6);
        }
        const auto again = star_kernel(model, kernel->point);
        EXPECT_LT(length(again->point - kernel->point), 1e-6);
    }
}

// Regular, so the deepest point is the middle and the depth the radius of the inscribed ball.
TEST(StarKernel, OfADodecahedron) {
    const double g = (1 + std::sqrt(5.0)) / 2;
    Model model = test::empty_model();
    std::vector<Vec3d> corners;
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            for (const double z : {-1.0, 1.0}) corners.push_back({x, y, z});
            corners.push_back({0, x / g, y * g});
            corners.push_back({x / g, y * g, 0});
            corners.push_back({x * g, 0, y / g});
        }
    }
    std::vector<Vec3d> faces; // their normals: corners of an icosahedron
    for (const double x : {-1.0, 1.0})
        for (const double y : {-g, g}) faces.insert(faces.end(), {{0, y, x}, {y, x, 0}, {x, 0, y}});
    for (const Vec3d& p : corners) model.positions.push_back(to_float(p));
    for (const Vec3d& face : faces) {
        double farthest = 0;
        for (const Vec3d& p : corners) farthest = std::max(farthest, dot(p, face));
        std::vector<std::uint32_t> around;
        for (std::uint32_t i = 0; i < corners.size(); ++i)
            if (dot(corners[i], face) > farthest - 1e-9) around.push_back(i);
        ASSERT_EQ(around.size(), 5U);
        const Vec3d right = normalize(cross(face, corners[around[0]])), up = cross(normalize(face), right);
        std::sort(around.begin(), around.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::atan2(dot(corners[a], up), dot(corners[a], right)) <
                   std::atan2(dot(corners[b], up), dot(corners[b], right));
        });
        for (unsigned k = 1; k < 4; ++k) model.triangles.push_back({{around[0], around[k], around[k + 1]}});
    }
    ASSERT_EQ(model.triangles.size(), 36U);
    const auto kernel = star_kernel(model, {0.1, 0.2, 0.3});
    ASSERT_TRUE(kernel);
    EXPECT_NEAR(kernel->depth, g * g / std::sqrt(g * g + 1), 1e-6);
    EXPECT_EQ(kernel->point, (Vec3d{0.1, 0.2, 0.3}));
}

TEST(StarKernel, IsEmptyForATorusAndForSoup) {
    Model torus = test::empty_model();
    test::add_torus(torus, 1, 0.3F, 40);
    EXPECT_FALSE(star_kernel(torus, {}));
    EXPECT_FALSE(star_kernel(test::random_soup(100, 1), {}));
    EXPECT_FALSE(star_kernel(test::empty_model(), {}));
}

// Two balls that overlap are seen whole from where they do; two that do not, from nowhere.
TEST(StarKernel, OfTwoBalls) {
    for (const float apart : {0.5F, 1.2F}) {
        Model model = test::empty_model();
        test::add_sphere(model, {-apart, 0, 0}, 1, 24);
        test::add_sphere(model, {apart, 0, 0}, 1, 24);
        const auto kernel = star_kernel(model, {0, 5, 0});
        ASSERT_EQ(kernel.has_value(), apart < 1);
        if (!kernel) continue;
        EXPECT_NEAR(kernel->depth, 0.5, 0.02); // the planes of a ball of facets
    }
}

// More triangles than are sampled, of which all decide together.
Model fine_box(Vec3f low, Vec3f high, std::uint32_t cells) {
    Model model = test::empty_model();
    const auto at = [&](unsigned axis, float side, float u, float v) {
        std::array<float, 3> p{};
        p[axis] = side;
        p[(axis + 1) % 3] = u;
        p[(axis + 2) % 3] = v;
        return Vec3f{low.x + p[0] * (high.x - low.x), low.y + p[1] * (high.y - low.y),
                     low.z + p[2] * (high.z - low.z)};
    };
    for (unsigned axis = 0; axis < 3; ++axis) {
        for (std::uint32_t i = 0; i < cells; ++i) {
            for (std::uint32_t j = 0; j < cells; ++j) {
                const float u = float(i) / float(cells), v = float(j) / float(cells);
                const float w = float(i + 1) / float(cells), z = float(j + 1) / float(cells);
                test::add_quad(model, at(axis, 1, u, v), at(axis, 1, w, v), at(axis, 1, w, z),
                               at(axis, 1, u, z));
                test::add_quad(model, at(axis, 0, u, v), at(axis, 0, u, z), at(axis, 0, w, z),
                               at(axis, 0, w, v));
            }
        }
    }
    return model;
}

TEST(StarKernel, OfALongBoxIsWhereItWasAsked) {
    const Model model = fine_box({-8, -1, -1}, {8, 1, 1}, 30);
    ASSERT_GT(model.triangles.size(), 8192U);
    const auto inside = star_kernel(model, {3, 0.2, 0});
    ASSERT_TRUE(inside);
    EXPECT_NEAR(inside->depth, 1, 1e-6);
    EXPECT_LT(length(inside->point - Vec3d{3, 0.2, 0}), 1e-6);
    // Half as deep as the deepest, so half a unit from each face.
    const auto outside = star_kernel(model, {20, 3, 3});
    ASSERT_TRUE(outside);
    EXPECT_LT(length(outside->point - Vec3d{7.5, 0.5, 0.5}), 1e-5);
}

// Faces without area, needles, doubles and a model inside out.
TEST(StarKernel, IgnoresWhatSaysNothing) {
    Model model = random_ball(1, 0.1);
    const auto clean = star_kernel(model, {});
    ASSERT_TRUE(clean);
    const auto expect_the_same = [&](const Model& other, std::span<const std::uint8_t> turned) {
        const auto kernel = star_kernel(other, {}, turned);
        ASSERT_TRUE(kernel);
        EXPECT_NEAR(kernel->depth, clean->depth, 1e-9);
        EXPECT_LT(length(kernel->point - clean->point), 1e-7);
    };
    Model dirty = model;
    dirty.triangles.insert(dirty.triangles.end(), model.triangles.begin(), model.triangles.end());
    dirty.triangles.push_back({{0, 0, 5}});
    dirty.triangles.push_back({{4, 4, 4}});
    const auto last = std::uint32_t(dirty.positions.size());
    const Vec3f a = model.positions[0], b = model.positions[9];
    dirty.positions.push_back({a.x + (b.x - a.x) / 2 + 1e-6F, (a.y + b.y) / 2, (a.z + b.z) / 2});
    dirty.triangles.push_back({{0, 9, last}});
    expect_the_same(dirty, {});

    Model turned = model;
    for (const std::size_t t : {3U, 17U, 30U})
        std::swap(turned.triangles[t].vertex[0], turned.triangles[t].vertex[1]);
    EXPECT_FALSE(star_kernel(turned, {}));
    expect_the_same(turned, find_components(turned).turned);

    Model inside_out = model;
    for (Triangle& triangle : inside_out.triangles) std::swap(triangle.vertex[0], triangle.vertex[1]);
    expect_the_same(inside_out, {});
}

TEST(StarKernel, DoesNotDependOnOrderOrThreads) {
    Model model = test::empty_model();
    test::add_sphere(model, {0.3F, 0, 0}, 1, 60);
    test::add_sphere(model, {-0.3F, 0.1F, 0}, 1.1F, 60);
    ASSERT_GT(model.triangles.size(), 8192U);
    const auto kernel = star_kernel(model, {0, 4, 1});
    ASSERT_TRUE(kernel);
    for (const int threads : {1, 3}) {
        tbb::task_arena arena(threads);
        arena.execute([&] {
            const auto again = star_kernel(model, {0, 4, 1});
            EXPECT_EQ(again->depth, kernel->depth);
            EXPECT_EQ(again->point, kernel->point);
        });
    }
    std::mt19937 random(7);
    std::shuffle(model.triangles.begin(), model.triangles.end(), random);
    const auto shuffled = star_kernel(model, {0, 4, 1});
    EXPECT_NEAR(shuffled->depth, kernel->depth, 1e-7);
    EXPECT_LT(length(shuffled->point - kernel->point), 1e-5);
}

} // namespace
} // namespace spa
