// SPDX-License-Identifier: Apache-2.0
// What is near a point: for answers that rounding decides.
#include "judge.h"

#include "judge_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spa::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// A direction this near to a plane may go to either side of it.
constexpr double grazing = 1e-5;
// Solids that are closer to each other touch.
constexpr double touching = 1e-9;

} // namespace

double Judge::depth_in(const Piece& piece, Vec3d point) {
    double depth = infinity;
    for (unsigned k = 0; k < piece.count; ++k) {
        const HalfSpace& half = piece.halves[k];
        depth = std::min(depth, (dot(half.plane, point) - half.offset) / length(half.plane));
    }
    return depth;
}

// Just inside all planes of the piece, if it is wide enough, but beyond plane `but` by as much as `out`.
Vec3d Judge::moved_into(const Piece& piece, Vec3d point, unsigned but, double out) {
    constexpr double deep = 1e-8;
    for (int i = 0; i < 20; ++i) {
        for (unsigned k = 0; k < piece.count; ++k) {
            const HalfSpace& half = piece.halves[k];
            const double size = length(half.plane);
            const double depth = (dot(half.plane, point) - half.offset) / size;
            const double missing = k == but ? std::min(-out - depth, 0.0) : std::max(deep - depth, 0.0);
            point = point + half.plane * (missing / size);
        }
    }
    return point;
}

template <class Visit>
bool Judge::any_near(Vec3d point, double reach, const Visit& visit) const {
    for (unsigned octant = 0; octant < 8; ++octant) {
        const Vec3d s = octant_signs(octant);
        const Vec3d p{point.x * s.x, point.y * s.y, point.z * s.z};
        if (std::min({p.x, p.y, p.z}) < -reach) continue;
        const double l = p.x + p.y + p.z;
        CellRange rows{0, n_ - 1};
        CellRange columns = rows;
        if (l > 100 * reach) {
            const double wide = 4 * reach / l;
            rows = cells_between(p.x / l - wide, p.x / l + wide, n_);
            columns = cells_between(p.y / l - wide, p.y / l + wide, n_);
        }
        for (std::uint32_t i = rows.first; i <= rows.last; ++i)
            for (std::uint32_t j = columns.first; j <= columns.last; ++j)
                for (std::uint32_t k = first_[bin(octant, i, j)]; k < first_[bin(octant, i, j) + 1]; ++k)
                    if (visit(pieces_[k])) return true;
    }
    return false;
}

bool Judge::solid(Vec3d point) const {
    return any_near(point, touching, [&](const Piece& piece) { return depth_in(piece, point) >= 0; });
}

template <class Visit>
bool Judge::any_face(Vec3d point, double reach, const Visit& visit) const {
    return any_near(point, reach, [&](const Piece& piece) {
        if (!(std::abs(depth_in(piece, point)) <= reach)) return false;
        for (unsigned k = 0; k < piece.count; ++k) {
            const HalfSpace& half = piece.halves[k];
            const double size = length(half.plane);
            if (std::abs(dot(half.plane, point) - half.offset) > reach * size || !visit(half, size)) continue;
            if (!solid(point - half.plane * (2 * reach / size))) return true;
            // What is beyond another side of the piece may hide that there is nothing beyond this one.
            const Vec3d beyond = moved_into(piece, point, k, 2 * reach);
            if (length(beyond - point) <= 8 * reach && !solid(beyond)) return true;
        }
        return false;
    });
}

bool Judge::near_boundary(Vec3d point, double reach) const {
    return any_face(point, reach, [](const HalfSpace& half, double) { return !half.open; });
}

bool Judge::near_face(Vec3d point, double reach, const Event& face, bool any_layer) const {
    return any_near(point, reach, [&](const Piece& piece) {
        if (!(std::abs(depth_in(piece, point)) <= reach)) return false;
        return std::any_of(
            piece.halves.begin(), piece.halves.begin() + piece.count, [&](const HalfSpace& half) {
                const double size = length(half.plane);
                return half.side == face.side && !half.open && (half.layer == face.layer || any_layer) &&
                       dot(half.plane, face.normal) < -(1 - 1e-4) * size &&
                       std::abs(dot(half.plane, point) - half.offset) <= reach * size;
            });
    });
}

bool Judge::near_passage(Vec3d point, double reach, Vec3d direction, bool enters) const {
    return any_face(point, reach, [&](const HalfSpace& half, double size) {
        const double towards = dot(half.plane, direction);
        return !half.open &&
               ((towards > 0) == enters || std::abs(towards) < grazing * size * length(direction));
    });
}

bool Judge::near_sample_line(Vec3d point, double reach) const {
    const double l = std::abs(point.x) + std::abs(point.y) + std::abs(point.z);
    const Vec3d cells = point * (n_ / l);
    const auto round = [](double v) { return std::round(v); };
    const Vec3d sample = Vec3d{round(cells.x), round(cells.y), round(cells.z)} * (l / n_);
    return length(cross(point, sample)) <= reach * length(sample);
}

std::vector<Vec3d> Judge::points_inside(Vec3d point, double reach) const {
    std::vector<Vec3d> points;
    any_near(point, reach, [&](const Piece& piece) {
        if (!(std::abs(depth_in(piece, point)) <= reach)) return false;
        const Vec3d inside = moved_into(piece, point);
        if (length(inside - point) <= reach) points.push_back(inside);
        return false;
    });
    return points;
}

} // namespace spa::test
