// SPDX-License-Identifier: Apache-2.0
// The drawing of one rectangle of views: every triangle in every view whose axis it may touch, in batches of
// bounded size, in the order of the triangles' indices.
#pragma once

#include "orbit_culling.h"
#include "orbit_scene.h"

#include <tbb/task_arena.h>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace spa::bake {

// What one view still wants: a bit for each facing, and only what lies below the radius reached.
constexpr std::uint8_t want_front = 1, want_back = 2;
constexpr float nothing_reached = 2;
struct Reached {
    float front = nothing_reached, back = nothing_reached;
};

class Batches {
public:
    // Everything passed outlives it. threads: as CastOptions::threads. A tree has at most 2^19 views.
    Batches(const GlFunctions& gl, const CenteredModel& model, const MaterialTable& materials,
            unsigned threads);

    // Starts on a rectangle of views. Both must stay; what they want may only shrink until the next begin.
    void begin(const ViewTree& tree, std::span<const Reached> reached);
    // Follows a change of what is wanted.
    void plan();
    // Draws all batches with the program in use. after(share) is called after each with the share drawn.
    void draw(const std::function<void(double)>& after);

private:
    struct Active {
        std::uint32_t triangle = 0;
        std::uint32_t pairs = 0;
        bool back_facing = false;
    };
    struct Range {
        std::size_t begin = 0, end = 0; // in active_
    };
    struct Run {
        std::uint32_t binding = 0, first_pair = 0, pairs = 0;
    };

    // Calls found(view) for every view that wants the triangle.
    template <class Found>
    void visit(std::uint32_t triangle, bool back_facing, const Found& found) const;
    [[nodiscard]] Active count(std::uint32_t triangle) const;
    void upload(Range range);

    const GlFunctions& gl_;
    const CenteredModel& model_;
    const MaterialTable& materials_;
    tbb::task_arena arena_; // for the search alone: OpenGL stays on the caller's thread
    const ViewTree* tree_ = nullptr;
    std::span<const Reached> reached_;
    std::vector<Active> active_; // triangles that some view wants, in the order of their indices
    std::vector<Range> ranges_;
    std::size_t uploaded_ = 0; // index into ranges_; ranges_.size() = none
    std::vector<GpuCorners> corners_;
    std::vector<GpuPair> pairs_;
    std::vector<Run> runs_;
    GlObject corners_buffer_, pairs_buffer_;
    std::size_t corners_capacity_ = 0, pairs_capacity_ = 0;
};

} // namespace spa::bake
