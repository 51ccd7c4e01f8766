// SPDX-License-Identifier: Apache-2.0
// Mixed triangles of shapes for which they are known.
#include "../../libspa/bake/mixed.h"
#include "../../libspa/core/cell_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>

namespace spa::bake {
namespace {

constexpr Grid grid_of(std::uint32_t cells) { return {Mapping::octahedral, cells + 1, cells + 1}; }

SurfacePoint point(double radius, Vec3d normal) {
    SurfacePoint p;
    p.radius = float(radius);
    p.normal = to_float(normal);
    return p;
}

// Surfaces whose points each lie on a triangle of their own, with `normal` as its plane's normal.
struct Surfaces : SurfaceGrid {
    std::vector<Vec3d> face_normal;
};

std::vector<std::byte> mixed_bits(const Surfaces& shape) {
    return mixed_triangles(shape, [&](std::uint32_t triangle) { return shape.face_normal.at(triangle); });
}

// The surfaces that `at` gives for each unit direction, from outside in.
using Shape = std::function<std::vector<SurfacePoint>(Vec3d)>;
Surfaces surfaces(std::uint32_t cells, std::size_t count, const Shape& at) {
    Surfaces result;
    result.grid = grid_of(cells);
    const std::size_t samples = std::size_t(cells + 1) * (cells + 1);
    result.surfaces.resize(count, std::vector<SurfacePoint>(samples));
    for (std::uint32_t y = 0; y <= cells; ++y) {
        for (std::uint32_t x = 0; x <= cells; ++x) {
            const auto points = at(normalize(sample_direction(result.grid, {x, y})));
            for (std::size_t k = 0; k < points.size(); ++k) {
                SurfacePoint& point = result.surfaces.at(k)[std::size_t(y) * (cells + 1) + x];
                point = points[k];
                point.triangle = std::uint32_t(result.face_normal.size());
                // Neither its length nor its sign may matter, nor what the surface is shaded with.
                result.face_normal.push_back(to_double(points[k].normal) *
                                             (point.triangle % 2 == 0 ? -3.0 : 1.0));
                point.normal = {};
            }
        }
    }
    return result;
}

// Calls visit(mixed, the unit directions of the corners) for every triangle.
template <class Visit>
void each_triangle(const Surfaces& shape, Visit visit) {
    const std::uint32_t cells = shape.grid.width - 1;
    const std::vector<std::byte> mixed = mixed_bits(shape);
    ASSERT_EQ(mixed.size(), mixed_bytes(cells));
    for (std::uint32_t y = 0; y < cells; ++y) {
        for (std::uint32_t x = 0; x < cells; ++x) {
            for (const unsigned triangle : {0U, 1U}) {
                std::array<Vec3d, 3> u;
                const auto corners = triangle_corners(cells, x, y, triangle);
                std::transform(corners.begin(), corners.end(), u.begin(),
                               [&](TexelIndex t) { return normalize(sample_direction(shape.grid, t)); });
                visit(is_mixed(mixed, triangle_bit(cells, x, y, triangle)), u);
            }
        }
    }
}

TEST(Mixed, NoneOfASphere) {
    const Shape sphere = [](Vec3d u) { return std::vector{point(0.7, u)}; };
    for (const std::uint32_t cells : {8U, 34U, 128U}) {
        EXPECT_EQ(mixed_share(mixed_bits(surfaces(cells, 1, sphere))), 0) << cells;
        EXPECT_EQ(mixed_share(mixed_bits(surfaces(cells, 4, sphere))), 0) << cells;
    }
}

TEST(Mixed, NoneOfACube) {
    const Shape cube = [](Vec3d u) {
        const double x = std::abs(u.x), y = std::abs(u.y), z = std::abs(u.z);
        const double largest = std::max({x, y, z});
        const Vec3d normal = x == largest   ? Vec3d{std::copysign(1.0, u.x), 0, 0}
                             : y == largest ? Vec3d{0, std::copysign(1.0, u.y), 0}
                                            : Vec3d{0, 0, std::copysign(1.0, u.z)};
        return std::vector{point(0.5 / largest, normal)};
    };
    for (const std::uint32_t cells : {34U, 128U})
        EXPECT_EQ(mixed_share(mixed_bits(surfaces(cells, 2, cube))), 0) << cells;
}

// A flat wall is one surface however steep: the sides of a slab are seen at down to 2 degrees. Its edges are
// another matter.
TEST(Mixed, NoneWithinASideOfASlab) {
    const Vec3d half{0.02, 0.4, 0.6};
    const auto side_of = [&](Vec3d u) {
        const double x = half.x / std::abs(u.x), y = half.y / std::abs(u.y), z = half.z / std::abs(u.z);
        const double r = std::min({x, y, z});
        return x == r ? 0U : y == r ? 1U : 2U;
    };
    const Shape slab = [&](Vec3d u) {
        const Vec3d normals[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        const Vec3d normal = normals[side_of(u)];
        return std::vector{point(dot(normal, half) / std::abs(dot(normal, u)), normal)};
    };
    for (const std::uint32_t cells : {34U, 128U}) {
        std::size_t steep = 0;
        each_triangle(surfaces(cells, 2, slab), [&](bool mixed, const std::array<Vec3d, 3>& u) {
            const unsigned side = side_of(u[0]);
            const bool crease = side_of(u[1]) != side || side_of(u[2]) != side;
            const bool opposite = u[0].x * u[1].x < 0 || u[0].x * u[2].x < 0; // no edge, but the rim's end
            ASSERT_TRUE(crease || opposite || !mixed) << u[0].x << ", " << u[0].y << ", " << u[0].z;
            steep += !crease && side == 0 && std::abs(u[0].x) < 0.2 ? 1 : 0;
        });
        EXPECT_GT(steep, 10U);
    }
}

// Of a steep wall that is not flat the planes may be off by a share of the change: a needle of a cone, seen
// from the middle of its base.
TEST(Mixed, NoneOfASteepCone) {
    const Shape cone = [](Vec3d u) {
        // |(x, y)| = s (1 - z) above, a sphere below.
        constexpr double s = 0.08;
        const double across = std::hypot(u.x, u.y);
        const double r = s / (across + s * u.z);
        if (!(u.z > 0) || r < 0.09) return std::vector{point(0.08, u)};
        return std::vector{point(r, normalize(Vec3d{u.x, u.y, s * across}))};
    };
    std::size_t steep = 0, mixed_ones = 0;
    each_triangle(surfaces(128, 1, cone), [&](bool mixed, const std::array<Vec3d, 3>& u) {
        const bool all = std::all_of(u.begin(), u.end(), [](Vec3d v) {
            const double across = std::hypot(v.x, v.y);
            return across > 0.07 && across < 0.5 && v.z > 0;
        });
        steep += all ? 1 : 0;
        mixed_ones += all && mixed ? 1 : 0;
    });
    EXPECT_GT(steep, 1000U);
    EXPECT_EQ(mixed_ones, 0U);
}

// Two concentric spheres, the larger one over a cap: the triangles over its rim, and no other.
TEST(Mixed, ACliffIsARing) {
    for (const double height : {0.5, -0.3}) {
        const auto is_high = [height](Vec3d u) { return u.z + 0.3 * u.x > height; };
        const Shape cliff = [&](Vec3d u) { return std::vector{point(is_high(u) ? 1 : 0.6, u)}; };
        // 6: rows of cells that do not fill whole bytes.
        for (const std::uint32_t cells : {6U, 64U}) {
            std::size_t count = 0;
            each_triangle(surfaces(cells, 1, cliff), [&](bool mixed, const std::array<Vec3d, 3>& u) {
                const bool across = is_high(u[0]) != is_high(u[1]) || is_high(u[0]) != is_high(u[2]);
                ASSERT_EQ(mixed, across) << cells << " at " << u[0].x << ", " << u[0].y << ", " << u[0].z;
                count += mixed ? 1 : 0;
            });
            EXPECT_GT(count, std::size_t(2) * cells);
        }
    }
}

// Where there is nothing there is nothing to mix; where one corner has something and another has not, there
// is.
TEST(Mixed, CoverageCounts) {
    const Shape half = [](Vec3d u) {
        return u.x > 0.2 ? std::vector{point(0.7, u)} : std::vector<SurfacePoint>{};
    };
    each_triangle(surfaces(32, 2, half), [](bool mixed, const std::array<Vec3d, 3>& u) {
        const auto covered = std::count_if(u.begin(), u.end(), [](Vec3d v) { return v.x > 0.2; });
        ASSERT_EQ(mixed, covered == 1 || covered == 2);
    });
    EXPECT_EQ(mixed_share(mixed_bits(surfaces(32, 2, [](Vec3d) { return std::vector<SurfacePoint>{}; }))), 0);
}

// The outer surface is smooth, but the interval reaches the centre on one side only.
TEST(Mixed, ReachingTheCentreCounts) {
    const Shape bowl = [](Vec3d u) {
        std::vector<SurfacePoint> points{point(0.9, u)};
        if (u.y > 0) points.push_back(point(0.4, -u));
        return points;
    };
    each_triangle(surfaces(32, 2, bowl), [](bool mixed, const std::array<Vec3d, 3>& u) {
        const auto open = std::count_if(u.begin(), u.end(), [](Vec3d v) { return v.y > 0; });
        ASSERT_EQ(mixed, open == 1 || open == 2);
    });
}

// The tangent planes find a jump that is not steep enough to be refused by itself: two spheres as near as
// that.
TEST(Mixed, AJumpThatTheNormalsDenyIsMixed) {
    const auto is_high = [](Vec3d u) { return u.z > 0.1; };
    const Shape step = [&](Vec3d u) { return std::vector{point(is_high(u) ? 0.62 : 0.6, u)}; };
    std::size_t count = 0;
    each_triangle(surfaces(64, 1, step), [&](bool mixed, const std::array<Vec3d, 3>& u) {
        const bool across = is_high(u[0]) != is_high(u[1]) || is_high(u[0]) != is_high(u[2]);
        ASSERT_TRUE(across || !mixed);
        count += mixed ? 1 : 0;
    });
    EXPECT_GT(count, 100U);
    // Without normals, and with normals across the line of sight, the slope alone decides.
    for (const bool grazing : {false, true}) {
        const Shape bare = [&](Vec3d u) {
            const Vec3d across = normalize(cross(u, Vec3d{0.3, 0.5, 0.8}));
            SurfacePoint p = point(is_high(u) ? 0.62 : 0.6, grazing ? across : Vec3d{});
            return std::vector{p};
        };
        EXPECT_EQ(mixed_share(mixed_bits(surfaces(64, 1, bare))), 0) << grazing;
    }
}

// Radii 2/3 and 1/4 about Y, two surfaces: as in the tests of intervals, r^2 - 2 r s R + R^2 - q^2 = 0.
TEST(Mixed, ATorusIsMixedNearItsSilhouetteOnly) {
    constexpr double big = 2.0 / 3, small = 0.25;
    const auto root = [](Vec3d u) {
        const double s = std::hypot(u.x, u.z);
        return big * big * s * s - (big * big - small * small);
    };
    const Shape torus = [&](Vec3d u) {
        std::vector<SurfacePoint> points;
        if (!(root(u) > 0)) return points;
        const double s = std::hypot(u.x, u.z);
        for (const double sign : {1.0, -1.0}) {
            const double r = big * s + sign * std::sqrt(root(u));
            const Vec3d ring = normalize(Vec3d{u.x, 0, u.z}) * big;
            points.push_back(point(r, normalize(u * r - ring)));
        }
        return points;
    };
    std::size_t across = 0, beside = 0, total = 0;
    each_triangle(surfaces(128, 2, torus), [&](bool mixed, const std::array<Vec3d, 3>& u) {
        const auto covered = std::count_if(u.begin(), u.end(), [&](Vec3d v) { return root(v) > 0; });
        ++total;
        if (covered == 1 || covered == 2) {
            ++across;
            ASSERT_TRUE(mixed);
        } else if (mixed) {
            ++beside;
            // Within a few samples of the silhouette: root falls by about 0.4 a radian there.
            for (const Vec3d& v : u) ASSERT_LT(root(v), 0.4 * 3 * (2.0 / 128) * 2);
            ASSERT_EQ(covered, 3);
        }
    });
    EXPECT_GT(across, 0U);
    EXPECT_GT(beside, 0U);
    EXPECT_LT(double(across + beside) / double(total), 0.06);
}

// The definition once more, triangle by triangle and as plainly as possible.
bool is_mixed_by_definition(const Surfaces& shape, const std::array<TexelIndex, 3>& corners) {
    const double cells = shape.grid.width - 1;
    const auto at = [&](std::size_t k, TexelIndex t) {
        return shape.surfaces[k][std::size_t(t.y) * shape.grid.width + t.x];
    };
    for (std::size_t k = 0; k < shape.surfaces.size(); ++k) {
        for (const auto& [i, j] : {std::pair(0U, 1U), std::pair(1U, 2U), std::pair(2U, 0U)}) {
            const TexelIndex a = corners[i], b = corners[j];
            const SurfacePoint p = at(k, a), q = at(k, b);
            if ((p.radius > 0) != (q.radius > 0)) return true;
            if (!(p.radius > 0)) continue;
            const Vec3d ga = sample_direction(shape.grid, a), gb = sample_direction(shape.grid, b);
            const double wa = length(ga) / double(p.radius), wb = length(gb) / double(q.radius);
            const double unit = (a.x != b.x && a.y != b.y ? std::sqrt(2) : 1) * 2 / cells * (wa + wb) / 2;
            const Vec3d na = shape.face_normal[p.triangle], nb = shape.face_normal[q.triangle];
            const double by_a = dot(na, gb) / dot(na, normalize(ga) * double(p.radius)) - wa;
            const double by_b = wb - dot(nb, ga) / dot(nb, normalize(gb) * double(q.radius));
            const double change = wb - wa;
            const double off = std::max(std::abs(by_a - change), std::abs(by_b - change));
            if (off <= std::max(0.5 * unit, 0.25 * std::abs(change))) continue;
            if (std::abs(change) > 4 * unit || change < std::min(by_a, by_b) - 0.5 * unit ||
                change > std::max(by_a, by_b) + 0.5 * unit)
                return true;
        }
    }
    return false;
}

TEST(Mixed, IsTheDefinition) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> value(-1, 1);
    // 70: more than one run of rows, and rows that do not fill whole bytes.
    for (const std::uint32_t cells : {2U, 6U, 70U}) {
        const Shape noise = [&](Vec3d u) {
            std::vector<SurfacePoint> points;
            for (std::size_t k = 0; k < 3 && value(random) > -0.95; ++k) {
                const Vec3d tilt{value(random), value(random), value(random)};
                points.push_back(point((0.9 - 0.3 * double(k)) * (1 + 0.4 / cells * value(random)),
                                       normalize(u + tilt * 0.7)));
            }
            return points;
        };
        const Surfaces shape = surfaces(cells, 4, noise);
        const std::vector<std::byte> mixed = mixed_bits(shape);
        for (std::uint32_t y = 0; y < cells; ++y)
            for (std::uint32_t x = 0; x < cells; ++x)
                for (const unsigned f : {0U, 1U})
                    ASSERT_EQ(is_mixed(mixed, triangle_bit(cells, x, y, f)),
                              is_mixed_by_definition(shape, triangle_corners(cells, x, y, f)))
                        << cells << ": " << x << " " << y << " " << f;
        if (cells == 70) {
            EXPECT_GT(mixed_share(mixed), 0.2);
            EXPECT_LT(mixed_share(mixed), 0.9);
        }
    }
}

} // namespace
} // namespace spa::bake
