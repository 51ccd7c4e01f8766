// SPDX-License-Identifier: Apache-2.0
#include "shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace spa::samples {
namespace {

// The radius along a unit direction u is 1 + the sum of amplitude * sin(wave . u + phase).
struct Wave {
    Vec3d wave;
    double phase, amplitude;
};
constexpr std::array waves{
    Wave{{1.9, 1.1, -0.7}, 0.4, 0.06},
    Wave{{-1.3, 2.6, 1.9}, 1.7, 0.045},
    Wave{{3.1, -0.8, 3.6}, 2.9, 0.03},
    Wave{{-2.2, -4.9, 4.1}, 0.9, 0.015},
};

// Position and normal are exact but for rounding: the normal of the surface r(u) u is r u minus the gradient
// of r along the sphere.
void add_point(Model& model, Vec3d u) {
    double radius = 1;
    Vec3d gradient{};
    for (const Wave& w : waves) {
        const double angle = dot(w.wave, u) + w.phase;
        radius += w.amplitude * std::sin(angle);
        gradient = gradient + w.wave * (w.amplitude * std::cos(angle));
    }
    const Vec3d along = gradient - u * dot(gradient, u);
    const Vec3f half = to_float(u * 0.5);
    const float light = float(0.5 + 0.5 * std::cos(9 * (radius - 1) / 0.15));
    add_vertex(model, u * radius,
               {(0.5F + half.x) * light, 0.5F + half.y, (0.5F + half.z) * (1 - 0.5F * light), 1});
    model.normals.push_back(to_float(normalize(u * radius - along)));
}

// Turned by an angle that no symmetry of the base shape or of a direction map shares.
Vec3d turned(Vec3d p) {
    constexpr double w = 0.83, x = 0.31, y = -0.24, z = 0.40;
    constexpr double s = 2 / (w * w + x * x + y * y + z * z);
    return {(1 - s * (y * y + z * z)) * p.x + s * (x * y - w * z) * p.y + s * (x * z + w * y) * p.z,
            s * (x * y + w * z) * p.x + (1 - s * (x * x + z * z)) * p.y + s * (y * z - w * x) * p.z,
            s * (x * z - w * y) * p.x + s * (y * z + w * x) * p.y + (1 - s * (x * x + y * y)) * p.z};
}

// An octahedron whose edges are cut into n: rings of 4 m points, m = 0 at the poles, n at the equator.
class Rings {
public:
    Rings(Model& model, std::uint32_t n) : model_(model), n_(n) {
        for (std::uint32_t ring = 0; ring <= 2 * n; ++ring) {
            first_.push_back(std::uint32_t(model.positions.size()));
            const std::uint32_t m = points_a_side(ring);
            const double height = double(n) - double(ring);
            if (m == 0) add_point(model, normalize(turned({0, height, 0})));
            for (std::uint32_t i = 0; i < 4 * m; ++i) {
                const double along = i % m, rest = m - i % m;
                const Vec3d at = i / m == 0   ? Vec3d{along, height, rest}
                                 : i / m == 1 ? Vec3d{rest, height, -along}
                                 : i / m == 2 ? Vec3d{-along, height, -rest}
                                              : Vec3d{-rest, height, along};
                add_point(model, normalize(turned(at)));
            }
        }
    }

    void join(std::uint32_t ring) {
        const std::uint32_t upper = points_a_side(ring), lower = points_a_side(ring + 1);
        for (std::uint32_t side = 0; side < 4; ++side) {
            for (std::uint32_t i = 0; i < std::max(upper, lower); ++i) {
                if (lower > upper) // one more triangle that stands than triangles that hang
                    add_triangle(model_, at(ring, side, i), at(ring + 1, side, i), at(ring + 1, side, i + 1));
                else
                    add_triangle(model_, at(ring, side, i), at(ring + 1, side, i), at(ring, side, i + 1));
                if (i + 1 == std::max(upper, lower)) continue;
                if (lower > upper)
                    add_triangle(model_, at(ring, side, i), at(ring + 1, side, i + 1), at(ring, side, i + 1));
                else
                    add_triangle(model_, at(ring + 1, side, i), at(ring + 1, side, i + 1),
                                 at(ring, side, i + 1));
            }
        }
    }

private:
    [[nodiscard]] std::uint32_t points_a_side(std::uint32_t ring) const {
        return ring <= n_ ? ring : 2 * n_ - ring;
    }
    [[nodiscard]] std::uint32_t at(std::uint32_t ring, std::uint32_t side, std::uint32_t i) const {
        const std::uint32_t m = points_a_side(ring);
        return first_[ring] + (m == 0 ? 0 : (side * m + i) % (4 * m));
    }

    Model& model_;
    std::uint32_t n_;
    std::vector<std::uint32_t> first_;
};

} // namespace

Model make_smooth(int level) {
    const std::uint32_t cuts = 9U << unsigned(level);
    Model model = empty_model("bumps");
    Rings rings(model, cuts);
    for (std::uint32_t ring = 0; ring < 2 * cuts; ++ring) rings.join(ring);
    return model;
}

} // namespace spa::samples
