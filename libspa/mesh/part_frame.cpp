// SPDX-License-Identifier: Apache-2.0
#include "part_frame.h"

#include "../core/error.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace spa {
namespace {

constexpr double flat_ratio = 0.01;
constexpr double largest_coordinate = 0x1p60; // formats/SPA.md, section 5

struct Interval {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
    void extend(double v) {
        low = std::min(low, v);
        high = std::max(high, v);
    }
};

// The vertices that triangles use.
class UsedVertices {
public:
    explicit UsedVertices(const Model& model)
        : positions_(model.positions), used_(model.positions.size(), 0) {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, model.triangles.size(), grain),
                          [&](const auto& range) {
                              for (std::size_t t = range.begin(); t < range.end(); ++t) {
                                  for (const std::uint32_t v : model.triangles[t].vertex)
                                      std::atomic_ref(used_[v]).store(1, std::memory_order_relaxed);
                              }
                          });
    }
    // visit(value, p) for every one, on copies of `start` that join(a, b) brings together. The result must
    // not depend on the order of visits.
    template <class T, class Visit, class Join>
    [[nodiscard]] T reduce(T start, Visit&& visit, Join&& join) const {
        return tbb::parallel_reduce(
            tbb::blocked_range<std::size_t>(0, positions_.size(), grain), start,
            [&](const auto& range, T value) {
                for (std::size_t v = range.begin(); v < range.end(); ++v) {
                    if (used_[v] != 0) visit(value, to_double(positions_[v]));
                }
                return value;
            },
            join);
    }

private:
    static constexpr std::size_t grain = 16384;
    const std::vector<Vec3f>& positions_;
    std::vector<std::uint8_t> used_;
};

constexpr std::array<Vec3d, 3> coordinate_axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

Axes box_along(const UsedVertices& vertices, const std::array<Vec3d, 3>& axis) {
    using Ranges = std::array<Interval, 3>;
    const Ranges range = vertices.reduce(
        Ranges{},
        [&](Ranges& r, Vec3d p) {
            for (unsigned k = 0; k < 3; ++k) r[k].extend(dot(axis[k], p));
        },
        [](Ranges a, const Ranges& b) {
            for (unsigned k = 0; k < 3; ++k) {
                a[k].low = std::min(a[k].low, b[k].low);
                a[k].high = std::max(a[k].high, b[k].high);
            }
            return a;
        });
    std::array<unsigned, 3> order{0, 1, 2};
    const auto half = [&](unsigned k) { return (range[k].high - range[k].low) / 2; };
    std::stable_sort(order.begin(), order.end(), [&](unsigned a, unsigned b) { return half(a) > half(b); });
    Axes box;
    for (unsigned k = 0; k < 3; ++k) {
        box.axis[k] = axis[order[k]];
        box.extent[k] = half(order[k]);
        box.center = box.center + axis[k] * ((range[k].low + range[k].high) / 2);
    }
    box.axis[2] = cross(box.axis[0], box.axis[1]);
    return box;
}

// Eigenvectors of a symmetric matrix by cyclic Jacobi rotations (Golub & Van Loan, 8.5).
std::array<Vec3d, 3> eigenvectors(std::array<std::array<double, 3>, 3> a) {
    std::array<std::array<double, 3>, 3> v{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (int sweep = 0; sweep < 32; ++sweep) {
        for (const auto& [p, q] : {std::pair{0U, 1U}, std::pair{0U, 2U}, std::pair{1U, 2U}}) {
            if (a[p][q] == 0) continue;
            const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
            const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
            const double c = 1 / std::hypot(t, 1.0);
            const double s = t * c;
            for (unsigned k = 0; k < 3; ++k) {
                const double kp = a[k][p];
                const double kq = a[k][q];
                a[k][p] = c * kp - s * kq;
                a[k][q] = s * kp + c * kq;
            }
            for (unsigned k = 0; k < 3; ++k) {
                const double pk = a[p][k];
                const double qk = a[q][k];
                a[p][k] = c * pk - s * qk;
                a[q][k] = s * pk + c * qk;
            }
            for (unsigned k = 0; k < 3; ++k) {
                const double kp = v[k][p];
                const double kq = v[k][q];
                v[k][p] = c * kp - s * kq;
                v[k][q] = s * kp + c * kq;
            }
        }
    }
    std::array<Vec3d, 3> axes;
    for (unsigned k = 0; k < 3; ++k) axes[k] = normalize(Vec3d{v[0][k], v[1][k], v[2][k]});
    return axes;
}

struct Moments {
    std::array<std::array<double, 3>, 3> second{};
    Vec3d first;
    double area = 0;

    void add(const Model& model, const Triangle& triangle, Vec3d origin) {
        const Vec3d a = to_double(model.positions[triangle.vertex[0]]) - origin;
        const Vec3d b = to_double(model.positions[triangle.vertex[1]]) - origin;
        const Vec3d c = to_double(model.positions[triangle.vertex[2]]) - origin;
        const double weight = length(cross(b - a, c - a));
        const Vec3d centroid = (a + b + c) * (1.0 / 3);
        const std::array<double, 3> p{centroid.x, centroid.y, centroid.z};
        for (unsigned i = 0; i < 3; ++i) {
            for (unsigned j = 0; j < 3; ++j) second[i][j] += weight * p[i] * p[j];
        }
        first = first + centroid * weight;
        area += weight;
    }
    [[nodiscard]] Moments joined(const Moments& other) const {
        Moments sum = *this;
        for (unsigned i = 0; i < 3; ++i) {
            for (unsigned j = 0; j < 3; ++j) sum.second[i][j] += other.second[i][j];
        }
        sum.first = sum.first + other.first;
        sum.area += other.area;
        return sum;
    }
};

// Area-weighted covariance of the triangles' centroids about `origin`: enough to find the axes.
std::array<Vec3d, 3> principal_axes(const Model& model, Vec3d origin) {
    // Deterministic: the sums are split alike for any number of threads.
    const Moments sum = tbb::parallel_deterministic_reduce(
        tbb::blocked_range<std::size_t>(0, model.triangles.size(), 65536), Moments{},
        [&](const auto& range, Moments moments) {
            for (std::size_t t = range.begin(); t < range.end(); ++t)
                moments.add(model, model.triangles[t], origin);
            return moments;
        },
        [](const Moments& a, const Moments& b) { return a.joined(b); });
    if (!(sum.area > 0)) return coordinate_axes;
    std::array<std::array<double, 3>, 3> m{};
    const std::array<double, 3> c{sum.first.x, sum.first.y, sum.first.z};
    for (unsigned i = 0; i < 3; ++i) {
        for (unsigned j = 0; j < 3; ++j)
            m[i][j] = sum.second[i][j] / sum.area - c[i] * c[j] / (sum.area * sum.area);
    }
    return eigenvectors(m);
}

// The smaller box, given the one along the coordinate axes.
Axes oriented_bounds(const Model& model, const UsedVertices& vertices, const Axes& aligned) {
    const Axes principal = box_along(vertices, principal_axes(model, aligned.center));
    // The thinnest extent gets a floor, or every flat box would have volume 0.
    const auto volume = [&](const Axes& box) {
        return box.extent[0] * box.extent[1] * (box.extent[2] + 1e-6 * aligned.extent[0]);
    };
    return volume(principal) < 0.95 * volume(aligned) ? principal : aligned;
}

bool is_flat(const Axes& box) { return box.extent[2] < flat_ratio * box.extent[0]; }

// Looks at a few triangles, which is enough for most models. The corners of all triangles lie within +-e of
// the middle of the box, along its thinnest axis, so the variance of any set of corners along it is at most
// e^2; and no extent is larger than half the diagonal of any box.
bool surely_not_flat(const Model& model, const Axes& aligned) {
    constexpr std::size_t most = 4096;
    const std::size_t step = model.triangles.size() / most + 1;
    std::array<std::array<double, 3>, 3> m{};
    Vec3d sum;
    double count = 0;
    for (std::size_t t = 0; t < model.triangles.size(); t += step) {
        const Vec3d q = to_double(model.positions[model.triangles[t].vertex[0]]) - aligned.center;
        const std::array<double, 3> p{q.x, q.y, q.z};
        for (unsigned i = 0; i < 3; ++i) {
            for (unsigned j = 0; j < 3; ++j) m[i][j] += p[i] * p[j];
        }
        sum = sum + q;
        count += 1;
    }
    const std::array<double, 3> mean{sum.x / count, sum.y / count, sum.z / count};
    for (unsigned i = 0; i < 3; ++i) {
        for (unsigned j = 0; j < 3; ++j) m[i][j] = m[i][j] / count - mean[i] * mean[j];
    }
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3d& v : eigenvectors(m)) {
        const std::array<double, 3> p{v.x, v.y, v.z};
        double variance = 0;
        for (unsigned i = 0; i < 3; ++i) {
            for (unsigned j = 0; j < 3; ++j) variance += p[i] * m[i][j] * p[j];
        }
        least = std::min(least, variance);
    }
    const double half_diagonal = length(Vec3d{aligned.extent[0], aligned.extent[1], aligned.extent[2]});
    const double clearly = 2 * flat_ratio * half_diagonal; // whatever rounding did
    return least > clearly * clearly;
}

Vec3d mean_normal(const Model& model) {
    Vec3d sum;
    for (const Triangle& triangle : model.triangles) {
        const Vec3d a = to_double(model.positions[triangle.vertex[0]]);
        const Vec3d b = to_double(model.positions[triangle.vertex[1]]);
        const Vec3d c = to_double(model.positions[triangle.vertex[2]]);
        sum = sum + cross(b - a, c - a);
    }
    return sum;
}

} // namespace

Axes oriented_bounds(const Model& model) {
    const UsedVertices vertices(model);
    return oriented_bounds(model, vertices, box_along(vertices, coordinate_axes));
}

Vec3d bounds_center(const Model& model, bool& moved_off_surface) {
    const UsedVertices vertices(model);
    const Axes aligned = box_along(vertices, coordinate_axes);
    const Vec3d center = aligned.center;
    moved_off_surface = false;
    if (surely_not_flat(model, aligned)) return center;
    const Axes box = oriented_bounds(model, vertices, aligned);
    moved_off_surface = is_flat(box);
    if (!moved_off_surface) return center;
    const double side = dot(mean_normal(model), box.axis[2]) < 0 ? 1.0 : -1.0;
    return center + box.axis[2] * (side * box.extent[0] / 2);
}

Mat3 affine_frame(const Axes& box) {
    if (!(box.extent[0] > 0)) return {};
    const double floor = is_flat(box) ? 0.5 : 1e-6;
    Mat3 columns; // rows of its transpose: axis k times its relative size
    for (unsigned k = 0; k < 3; ++k) {
        columns.row[k] = box.axis[k] * std::max(box.extent[k] / box.extent[0], floor);
    }
    return transpose(columns);
}

PartFrame make_part_frame(const Model& model, Vec3d center, bool affine) {
    return make_part_frame(model, center, affine ? affine_frame(oriented_bounds(model)) : Mat3{});
}

PartFrame make_part_frame(const Model& model, Vec3d center, const Mat3& frame) {
    PartFrame part;
    part.center = center;
    part.frame = frame;
    const Mat3 to_frame = inverse(part.frame);
    const double radius2 = UsedVertices(model).reduce(
        0.0,
        [&](double& farthest, Vec3d p) {
            const Vec3d q = to_frame * (p - center);
            farthest = std::max(farthest, dot(q, q));
        },
        [](double a, double b) { return std::max(a, b); });
    // The farthest vertex stays inside after rounding to float.
    part.radius = std::sqrt(radius2) * (1 + 1e-7);
    if (!(part.radius > 0) || !std::isfinite(part.radius)) {
        throw Error(
            ExitCode::invalid_data,
            "the model has no extent: all its triangles lie in one point, so there is nothing to bake");
    }
    const double farthest =
        std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z), part.radius});
    if (farthest > largest_coordinate || part.radius < 1 / largest_coordinate) {
        throw Error(ExitCode::invalid_data,
                    "the model is too large or too small to be stored: coordinates may be up to 2^60 and its "
                    "radius down to 2^-60; scale it");
    }
    return part;
}

} // namespace spa
