// SPDX-License-Identifier: Apache-2.0
#include "orbit_culling.h"

#include <algorithm>

namespace spa::bake {
namespace {

constexpr DirectionBound everything{{}, 4, {}, -4, 4, 0};

// By how much single precision, here and in a view's axis, can misplace an edge, in units of the sphere's
// radius, several times over.
constexpr double edge_noise = 2e-6;
// What that can do to the distance of a triangle seen at a slant.
constexpr double distance_noise = 1e-4;

} // namespace

DirectionBound bound_directions(const std::array<Vec3d, 3>& corners) {
    std::array<Vec3d, 3> unit;
    Vec3d sum;
    for (std::size_t k = 0; k < 3; ++k) {
        unit[k] = normalize(corners[k]);
        sum = sum + unit[k];
    }
    const Vec3d center = normalize(sum);
    double radius = 0;
    for (const Vec3d& u : unit) radius = std::max(radius, length(u - center));
    // Within 80 degrees of an axis directions are a convex cone: it holds the triangle if it holds the
    // corners.
    if (center == Vec3d{} || !(radius < 1.28)) return everything;

    // A point at distance r that is misplaced by e changes its direction by e/r. No point of the triangle is
    // nearer than its plane, nor than its middle less its extent.
    const Vec3d plane = normalize(cross(corners[1] - corners[0], corners[2] - corners[0]));
    const Vec3d middle = (corners[0] + corners[1] + corners[2]) * (1.0 / 3);
    double extent = 0;
    for (const Vec3d& p : corners) extent = std::max(extent, length(p - middle));
    const double nearest = std::max(std::abs(dot(plane, corners[0])), length(middle) - extent);
    const double noise = edge_noise * (1 + 1 / std::max(nearest, 1e-6));

    DirectionBound bound{to_float(center), float(radius + noise), {}, -4, 4, float(nearest - distance_noise)};

    // A needle fills little of its ball, so bound it across its longest side too.
    std::size_t longest = 0;
    const auto side2 = [&](std::size_t k) {
        const Vec3d e = unit[(k + 1) % 3] - unit[k];
        return dot(e, e);
    };
    for (std::size_t k = 1; k < 3; ++k) {
        if (side2(k) > side2(longest)) longest = k;
    }
    const Vec3d across = normalize(cross(unit[longest], unit[(longest + 1) % 3]));
    if (across == Vec3d{}) return bound;
    const double height = dot(across, unit[(longest + 2) % 3]);
    // The flat triangle of the three unit vectors lies between 0 and `height`, and no point of it is nearer
    // to the origin than the base of the cone: pushed out to the sphere it rises by at most that factor.
    const double rise = 1 / (1 - radius * radius / 2);
    bound.slab_normal = to_float(across);
    bound.slab_min = float(std::min(0.0, height * rise) - noise);
    bound.slab_max = float(std::max(0.0, height * rise) + noise);
    return bound;
}

ViewTree::ViewTree(std::vector<Vec3f> directions, std::uint32_t width, std::uint32_t height)
    : directions_(std::move(directions)), width_(width), height_(height), wanted_(directions_.size(), 0) {
    Level level;
    for (std::uint32_t size = leaf; level.nodes.size() != 1; size *= 2) {
        level.width = (width + size - 1) / size;
        level.height = (height + size - 1) / size;
        level.nodes.assign(std::size_t(level.width) * level.height, {});
        level.wanted.assign(level.nodes.size(), 0);
        for (std::uint32_t y = 0; y < level.height; ++y) {
            for (std::uint32_t x = 0; x < level.width; ++x) {
                const auto each = [&](const auto& use) {
                    for (std::uint32_t j = y * size; j < std::min((y + 1) * size, height); ++j) {
                        for (std::uint32_t i = x * size; i < std::min((x + 1) * size, width); ++i) {
                            use(directions_[std::size_t(j) * width + i]);
                        }
                    }
                };
                Vec3f sum;
                each([&](Vec3f d) { sum = sum + d; });
                Node& node = level.nodes[std::size_t(y) * level.width + x];
                node.center = normalize(sum);
                each([&](Vec3f d) { node.radius = std::max(node.radius, length(d - node.center)); });
                node.radius += 1e-6F; // of rounding
            }
        }
        levels_.push_back(level);
    }
}

void ViewTree::set_wanted(std::span<const std::uint8_t> wanted) {
    wanted_.assign(wanted.begin(), wanted.end());
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        Level& level = levels_[l];
        const std::uint32_t fan = l == 0 ? leaf : 2;
        const std::uint32_t width = l == 0 ? width_ : levels_[l - 1].width;
        const std::uint32_t height = l == 0 ? height_ : levels_[l - 1].height;
        const std::vector<std::uint8_t>& below = l == 0 ? wanted_ : levels_[l - 1].wanted;
        std::fill(level.wanted.begin(), level.wanted.end(), std::uint8_t(0));
        for (std::uint32_t y = 0; y < height; ++y) {
            for (std::uint32_t x = 0; x < width; ++x) {
                level.wanted[std::size_t(y / fan) * level.width + x / fan] |=
                    below[std::size_t(y) * width + x];
            }
        }
    }
}

} // namespace spa::bake
