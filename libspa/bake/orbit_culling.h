// SPDX-License-Identifier: Apache-2.0
// Which views a triangle must be drawn in: those whose axis comes near the directions that it covers.
// Directions are points of the unit sphere and every bound is a ball or a slab in space, so poles, seams and
// folds of a map need no thought.
#pragma once

#include "../core/vector.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace spa::bake {

// Holds every direction (as a point of the unit sphere) in which a triangle can be seen from the origin.
struct DirectionBound {
    Vec3f center;
    float radius = 0;
    Vec3f slab_normal; // unit, or zero: no slab
    float slab_min = 0, slab_max = 0;
    float nearest = 0; // no point of the triangle is closer to the origin
};

// The bound is wider than the triangle by what single precision can move its edges.
// corners: finite.
DirectionBound bound_directions(const std::array<Vec3d, 3>& corners);

// A rectangle of views, searched by bound. Which of them are wanted can change; a view is wanted for any of
// eight purposes, one bit each.
class ViewTree {
public:
    // directions: unit, row-major. Nothing is wanted at first.
    ViewTree(std::vector<Vec3f> directions, std::uint32_t width, std::uint32_t height);

    // wanted: one mask a view.
    void set_wanted(std::span<const std::uint8_t> wanted);

    // Calls found(view index) for every view in the bound whose mask has a bit of `mask`, in an order that
    // depends on the bound alone.
    template <class Found>
    void visit(const DirectionBound& bound, std::uint8_t mask, const Found& found) const;

private:
    static constexpr std::uint32_t leaf = 4; // a leaf is leaf x leaf views

    struct Node {
        Vec3f center;
        float radius = 0;
    };
    struct Level {
        std::uint32_t width = 0, height = 0;
        std::vector<Node> nodes;
        std::vector<std::uint8_t> wanted;
    };

    static bool meets(const DirectionBound& bound, Vec3f center, float radius) {
        const Vec3f d = center - bound.center;
        const float reach = bound.radius + radius;
        if (dot(d, d) > reach * reach) return false;
        const float h = dot(bound.slab_normal, center);
        return h >= bound.slab_min - radius && h <= bound.slab_max + radius;
    }

    template <class Found>
    void visit_node(std::size_t level, std::uint32_t x, std::uint32_t y, const DirectionBound& bound,
                    std::uint8_t mask, const Found& found) const;

    std::vector<Vec3f> directions_;
    std::uint32_t width_ = 0, height_ = 0;
    std::vector<std::uint8_t> wanted_;
    std::vector<Level> levels_; // leaves first, the last has one node
};

template <class Found>
void ViewTree::visit(const DirectionBound& bound, std::uint8_t mask, const Found& found) const {
    visit_node(levels_.size() - 1, 0, 0, bound, mask, found);
}

template <class Found>
void ViewTree::visit_node(std::size_t level, std::uint32_t x, std::uint32_t y, const DirectionBound& bound,
                          std::uint8_t mask, const Found& found) const {
    const Level& here = levels_[level];
    const std::size_t index = std::size_t(y) * here.width + x;
    if ((here.wanted[index] & mask) == 0) return;
    if (!meets(bound, here.nodes[index].center, here.nodes[index].radius)) return;
    const bool is_leaf = level == 0;
    const std::uint32_t fan = is_leaf ? leaf : 2;
    const std::uint32_t width = is_leaf ? width_ : levels_[level - 1].width;
    const std::uint32_t height = is_leaf ? height_ : levels_[level - 1].height;
    const std::uint32_t x1 = x * fan + fan < width ? x * fan + fan : width;
    const std::uint32_t y1 = y * fan + fan < height ? y * fan + fan : height;
    for (std::uint32_t j = y * fan; j < y1; ++j) {
        for (std::uint32_t i = x * fan; i < x1; ++i) {
            if (!is_leaf) {
                visit_node(level - 1, i, j, bound, mask, found);
                continue;
            }
            const std::size_t view = std::size_t(j) * width_ + i;
            if ((wanted_[view] & mask) != 0 && meets(bound, directions_[view], 0)) found(std::uint32_t(view));
        }
    }
}

} // namespace spa::bake
