// SPDX-License-Identifier: Apache-2.0
#include "orbit_batches.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>

namespace spa::bake {
namespace {

// Bounds what is in flight: 40 MB of corners and 8 MB of pairs.
constexpr std::size_t most_corners = std::size_t(1) << 18;
constexpr std::size_t most_pairs = std::size_t(1) << 20;

// Binding points of shaders/orbit_common.glsl and orbit.vert.
constexpr GLuint corners_binding = 0, pairs_binding = 2;

// Reuses the buffer where the content fits.
void refill(const GlFunctions& gl, GlObject& buffer, std::size_t& capacity,
            std::span<const std::byte> content) {
    if (content.size() > capacity) {
        capacity = std::bit_ceil(content.size());
        buffer = make_dynamic_buffer(gl, capacity);
    }
    gl.NamedBufferSubData(buffer.name(), 0, GLsizeiptr(content.size()), content.data());
}

} // namespace

Batches::Batches(const GlFunctions& gl, const CenteredModel& model, const MaterialTable& materials,
                 unsigned threads)
    : gl_(gl), model_(model), materials_(materials),
      arena_(threads == 0 ? tbb::task_arena::automatic : int(threads)) {}

template <class Found>
void Batches::visit(std::uint32_t triangle, bool back_facing, const Found& found) const {
    const DirectionBound bound = bound_directions(corner_positions(model_, triangle));
    tree_->visit(bound, back_facing ? want_back : want_front, [&](std::uint32_t view) {
        if (bound.nearest < (back_facing ? reached_[view].back : reached_[view].front)) found(view);
    });
}

Batches::Active Batches::count(std::uint32_t triangle) const {
    const Facing facing = facing_of(model_, triangle);
    Active active{triangle, 0, facing == Facing::back};
    if (facing != Facing::edge_on)
        visit(triangle, active.back_facing, [&](std::uint32_t) { ++active.pairs; });
    return active;
}

void Batches::begin(const ViewTree& tree, std::span<const Reached> reached) {
    tree_ = &tree;
    reached_ = reached;
    active_.resize(model_.model->triangles.size());
    for (std::size_t i = 0; i < active_.size(); ++i) active_[i].triangle = std::uint32_t(i);
    plan();
}

void Batches::plan() {
    const auto count_part = [&](const tbb::blocked_range<std::size_t>& part) {
        for (std::size_t i = part.begin(); i < part.end(); ++i) active_[i] = count(active_[i].triangle);
    };
    arena_.execute(
        [&] { tbb::parallel_for(tbb::blocked_range<std::size_t>(0, active_.size(), 256), count_part); });
    std::erase_if(active_, [](const Active& a) { return a.pairs == 0; });
    ranges_.clear();
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < active_.size(); ++i) {
        pairs += active_[i].pairs;
        if (ranges_.empty() || pairs > most_pairs || i - ranges_.back().begin == most_corners) {
            ranges_.push_back({i, i});
            pairs = active_[i].pairs;
        }
        ranges_.back().end = i + 1;
    }
    uploaded_ = ranges_.size();
}

void Batches::upload(Range range) {
    const std::size_t triangles = range.end - range.begin;
    std::vector<std::uint32_t> first_pair(triangles + 1, 0);
    runs_.clear();
    for (std::size_t i = 0; i < triangles; ++i) {
        const Active& active = active_[range.begin + i];
        first_pair[i + 1] = first_pair[i] + active.pairs;
        const std::uint32_t binding = materials_.binding_of(active.triangle);
        if (runs_.empty() ||
            (binding != no_index && runs_.back().binding != no_index && binding != runs_.back().binding)) {
            runs_.push_back({binding, first_pair[i], 0});
        }
        if (runs_.back().binding == no_index) runs_.back().binding = binding;
        runs_.back().pairs += active.pairs;
    }
    corners_.resize(triangles);
    pairs_.resize(first_pair.back());
    const auto fill_part = [&](const tbb::blocked_range<std::size_t>& part) {
        for (std::size_t i = part.begin(); i < part.end(); ++i) {
            const Active& active = active_[range.begin + i];
            corners_[i] = make_corners(model_, active.triangle, active.back_facing);
            GpuPair* pair = pairs_.data() + first_pair[i];
            visit(active.triangle, active.back_facing, [&](std::uint32_t view) {
                *pair++ = {std::uint32_t(i), view};
            });
        }
    };
    arena_.execute([&] { tbb::parallel_for(tbb::blocked_range<std::size_t>(0, triangles, 256), fill_part); });
    refill(gl_, corners_buffer_, corners_capacity_, std::as_bytes(std::span(corners_)));
    refill(gl_, pairs_buffer_, pairs_capacity_, std::as_bytes(std::span(pairs_)));
}

void Batches::draw(const std::function<void(double)>& after) {
    for (std::size_t i = 0; i < ranges_.size(); ++i) {
        if (uploaded_ != i) upload(ranges_[i]);
        uploaded_ = i;
        gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, corners_binding, corners_buffer_.name());
        gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, pairs_binding, pairs_buffer_.name());
        for (const Run& run : runs_) {
            if (run.binding != no_index) materials_.bind(run.binding);
            gl_.DrawArrays(GL_TRIANGLES, GLint(3 * run.first_pair), GLsizei(3 * run.pairs));
        }
        // llvmpipe (Mesa 22.3) lets a buffer be overwritten while fragments that read it still wait in its
        // bins.
        gl_.Finish();
        after(double(i + 1) / double(ranges_.size()));
    }
}

} // namespace spa::bake
