// SPDX-License-Identifier: Apache-2.0
#include "orbit_naive.h"

#include <span>

namespace spa::bake {
namespace {

// OpenGL guarantees buffers of 128 MiB; of ours that is 883,000 triangles.
constexpr std::size_t most_corners = std::size_t(1) << 19;
constexpr GLuint corners_binding = 0;

} // namespace

WholeModel::WholeModel(const GlFunctions& gl, const CenteredModel& model, const MaterialTable& materials)
    : gl_(gl), materials_(materials) {
    std::vector<GpuCorners> corners;
    std::vector<Run> runs;
    const auto flush = [&] {
        if (corners.empty()) return;
        chunks_.push_back({make_buffer(gl, std::as_bytes(std::span(corners))), std::move(runs)});
        corners.clear();
        runs.clear();
    };
    for (std::uint32_t t = 0; t < std::uint32_t(model.model->triangles.size()); ++t) {
        const Facing facing = facing_of(model, t);
        if (facing == Facing::edge_on) continue;
        const std::uint32_t binding = materials.binding_of(t);
        if (runs.empty() || runs.back().binding != binding) {
            runs.push_back({binding, std::uint32_t(corners.size()), 0});
        }
        ++runs.back().triangles;
        corners.push_back(make_corners(model, t, facing == Facing::back));
        if (corners.size() == most_corners) flush();
    }
    flush();
}

void WholeModel::draw() const {
    for (const Chunk& chunk : chunks_) {
        gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, corners_binding, chunk.corners.name());
        for (const Run& run : chunk.runs) {
            if (run.binding != no_index) materials_.bind(run.binding);
            gl_.DrawArrays(GL_TRIANGLES, GLint(3 * run.first), GLsizei(3 * run.triangles));
        }
    }
}

} // namespace spa::bake
