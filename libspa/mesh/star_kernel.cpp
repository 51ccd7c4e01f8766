// SPDX-License-Identifier: Apache-2.0
#include "star_kernel.h"

#include "linear_program.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace spa {
namespace {

// All lengths here in units of the model's radius.
constexpr double thinnest_triangle = 1e-5;
constexpr double thinnest_kernel = 1e-6;
constexpr double kept_within = 1e-7;
constexpr double share_of_depth = 0.5;
constexpr std::size_t most_sampled = 4096;
constexpr int most_rounds = 100; // what is seen is below 20

struct Box {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    Vec3d low{infinity, infinity, infinity};
    Vec3d high{-infinity, -infinity, -infinity};

    void extend(const Box& other) {
        low = {std::min(low.x, other.low.x), std::min(low.y, other.low.y), std::min(low.z, other.low.z)};
        high = {std::max(high.x, other.high.x), std::max(high.y, other.high.y),
                std::max(high.z, other.high.z)};
    }
};

struct Plane {
    Vec3d normal; // unit, out of the solid; zero: there is none
    double limit = 0;
};

// The planes that a point breaks most, one for each octant of normals: they lie on different sides of it.
class Broken {
public:
    void add(const Plane& plane, std::uint32_t triangle, double by) {
        const unsigned octant =
            (plane.normal.x < 0 ? 1U : 0U) + (plane.normal.y < 0 ? 2U : 0U) + (plane.normal.z < 0 ? 4U : 0U);
        keep(octant, {by, triangle, plane});
    }
    void join(const Broken& other) {
        for (unsigned octant = 0; octant < 8; ++octant) keep(octant, other.worst_[octant]);
    }
    template <class Visit>
    bool each(Visit&& visit) const {
        bool any = false;
        for (const Worst& worst : worst_) {
            if (worst.by <= kept_within) continue;
            any = true;
            visit(worst.plane);
        }
        return any;
    }

private:
    struct Worst {
        double by = kept_within;
        std::uint32_t triangle = no_index;
        Plane plane;
    };
    void keep(unsigned octant, const Worst& worst) {
        Worst& so_far = worst_[octant];
        if (worst.by > so_far.by || (worst.by == so_far.by && worst.triangle < so_far.triangle))
            so_far = worst;
    }
    std::array<Worst, 8> worst_;
};

class Planes {
public:
    Planes(const Model& model, std::span<const std::uint8_t> turned) : model_(model), turned_(turned) {
        const Box box = tbb::parallel_reduce(
            tbb::blocked_range<std::size_t>(0, model.triangles.size(), 16384), Box{},
            [&](const auto& range, Box found) {
                for (std::size_t t = range.begin(); t < range.end(); ++t) {
                    for (const std::uint32_t v : model.triangles[t].vertex) {
                        const Vec3d p = to_double(model.positions[v]);
                        found.extend({p, p});
                    }
                }
                return found;
            },
            [](Box p, const Box& q) {
                p.extend(q);
                return p;
            });
        const Vec3d low = box.low, high = box.high;
        middle_ = (low + high) * 0.5;
        radius_ = length(high - low) / 2;
    }

    void turn_all() { sign_ = -sign_; }
    [[nodiscard]] bool has_extent() const { return radius_ > 0 && std::isfinite(radius_); }
    [[nodiscard]] double radius() const { return radius_; }
    [[nodiscard]] Vec3d to_unit(Vec3d p) const { return (p - middle_) * (1 / radius_); }
    [[nodiscard]] Vec3d from_unit(Vec3d p) const { return middle_ + p * radius_; }
    [[nodiscard]] std::size_t sampling_step() const { return model_.triangles.size() / most_sampled + 1; }

    // Of every step-th triangle, those that x lies less than `depth` behind.
    [[nodiscard]] Broken broken_by(Vec3d x, double depth, std::size_t step) const {
        const std::size_t count = (model_.triangles.size() + step - 1) / step;
        return tbb::parallel_reduce(
            tbb::blocked_range<std::size_t>(0, count, 16384), Broken{},
            [&](const auto& range, Broken broken) {
                for (std::size_t i = range.begin(); i < range.end(); ++i) {
                    const Plane plane = plane_of(i * step);
                    const double by = dot(plane.normal, x) - plane.limit + depth;
                    if (by > kept_within && !(plane.normal == Vec3d{}))
                        broken.add(plane, std::uint32_t(i * step), by);
                }
                return broken;
            },
            [](Broken a, const Broken& b) {
                a.join(b);
                return a;
            });
    }

private:
    [[nodiscard]] Plane plane_of(std::size_t t) const {
        const auto corner = [&](unsigned k) {
            return to_unit(to_double(model_.positions[model_.triangles[t].vertex[k]]));
        };
        const Vec3d a = corner(0), b = corner(1), c = corner(2);
        const Vec3d n = cross(b - a, c - a);
        const double longest2 = std::max({dot(b - a, b - a), dot(c - a, c - a), dot(c - b, c - b)});
        const double size2 = dot(n, n);
        if (!(size2 > thinnest_triangle * thinnest_triangle * longest2)) return {};
        const bool is_turned = !turned_.empty() && turned_[t] != 0;
        const Vec3d normal = n * ((is_turned ? -sign_ : sign_) / std::sqrt(size2));
        return {normal, dot(normal, a)};
    }

    const Model& model_;
    std::span<const std::uint8_t> turned_;
    Vec3d middle_;
    double radius_ = 0;
    double sign_ = 1;
};

struct Ball {
    Vec3d center;
    double radius = 0;
};

using Program = std::vector<HalfSpace<4>>;

// The largest ball behind every step-th plane and those of `program`, which grows; a radius that is not
// positive where there is none.
Ball largest_ball(const Planes& planes, std::size_t step, Program& program) {
    for (int round = 0; round < most_rounds; ++round) {
        // The model is in the unit ball, so a point of the box is at most 1 + sqrt(3) before a plane: a
        // radius of -4 keeps everything.
        const auto x = maximize<4>({0, 0, 0, 1}, {-1, -1, -1, -4}, {1, 1, 1, 1}, program);
        if (!x) return {};
        const Ball ball{{(*x)[0], (*x)[1], (*x)[2]}, (*x)[3]};
        if (ball.radius <= thinnest_kernel) return {};
        const bool any = planes.broken_by(ball.center, ball.radius, step).each([&](const Plane& plane) {
            program.push_back({{plane.normal.x, plane.normal.y, plane.normal.z, 1}, plane.limit});
        });
        if (!any) return ball;
    }
    return {};
}

// Solves the symmetric system of the given rank, at most 3, by Cramer's rule; false if it is singular.
bool solve(std::size_t rank, const Mat3& m, Vec3d right, Vec3d& x) {
    Mat3 full = m; // the rest as the identity
    if (rank < 3) {
        full.row[2] = {0, 0, 1};
        full.row[0].z = full.row[1].z = 0;
        right.z = 0;
    }
    if (rank < 2) {
        full.row[1] = {0, 1, 0};
        full.row[0].y = full.row[2].y = 0;
        right.y = 0;
    }
    if (!(std::abs(determinant(full)) > 1e-12)) return false;
    x = inverse(full) * right;
    return true;
}

// The point that keeps all planes nearest to `from`: it is where one, two or three of them meet nearest to it
// (the conditions of Karush, Kuhn and Tucker), and there are few to try.
std::optional<Vec3d> nearest_kept(const std::vector<Plane>& planes, Vec3d from, std::vector<Plane>& active) {
    const std::size_t n = planes.size();
    const auto try_some = [&](std::span<const std::size_t> some) -> std::optional<Vec3d> {
        std::array<Vec3d, 3> normal{};
        std::array<double, 3> excess{};
        for (std::size_t i = 0; i < some.size(); ++i) {
            normal[i] = planes[some[i]].normal;
            excess[i] = dot(normal[i], from) - planes[some[i]].limit;
        }
        Mat3 products;
        for (std::size_t i = 0; i < 3; ++i)
            products.row[i] = {dot(normal[i], normal[0]), dot(normal[i], normal[1]),
                               dot(normal[i], normal[2])};
        Vec3d pull;
        if (!solve(some.size(), products, {excess[0], excess[1], excess[2]}, pull)) return std::nullopt;
        if (pull.x < 0 || pull.y < 0 || pull.z < 0) return std::nullopt;
        const Vec3d x = from - normal[0] * pull.x - normal[1] * pull.y - normal[2] * pull.z;
        for (const Plane& plane : planes) {
            if (dot(plane.normal, x) > plane.limit + kept_within / 100) return std::nullopt;
        }
        active.clear();
        for (const std::size_t i : some) active.push_back(planes[i]);
        return x;
    };
    for (std::size_t i = 0; i < n; ++i)
        if (const auto x = try_some(std::array{i})) return x;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j)
            if (const auto x = try_some(std::array{i, j})) return x;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j)
            for (std::size_t k = j + 1; k < n; ++k)
                if (const auto x = try_some(std::array{i, j, k})) return x;
    return std::nullopt;
}

// Planes that do not decide are dropped: the distance grows with every round, so none comes back for ever.
Vec3d nearest_at_depth(const Planes& planes, const Ball& ball, double depth, Vec3d from) {
    std::vector<Plane> active;
    Vec3d x = from;
    for (int round = 0; round < most_rounds; ++round) {
        std::vector<Plane> tried = active;
        const bool any = planes.broken_by(x, depth, 1).each([&](const Plane& plane) {
            tried.push_back({plane.normal, plane.limit - depth});
        });
        if (!any) return x;
        const auto moved = nearest_kept(tried, from, active);
        if (!moved) break; // planes too nearly parallel to tell apart
        x = *moved;
    }
    return ball.center;
}

} // namespace

std::optional<StarKernel> star_kernel(const Model& model, Vec3d near, std::span<const std::uint8_t> turned) {
    Planes planes(model, turned);
    if (!planes.has_extent()) return std::nullopt;
    for (int side = 0; side < 2; ++side, planes.turn_all()) {
        Program program;
        Ball ball = largest_ball(planes, planes.sampling_step(), program);
        if (ball.radius > 0 && planes.sampling_step() > 1) ball = largest_ball(planes, 1, program);
        if (!(ball.radius > thinnest_kernel)) continue;
        const Vec3d x = nearest_at_depth(planes, ball, ball.radius * share_of_depth, planes.to_unit(near));
        return StarKernel{ball.radius * planes.radius(), planes.from_unit(x)};
    }
    return std::nullopt;
}

} // namespace spa
