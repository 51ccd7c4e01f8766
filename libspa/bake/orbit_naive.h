// SPDX-License-Identifier: Apache-2.0
// The drawing of one view with every triangle of the model: the paper's way, for measuring and checking.
#pragma once

#include "orbit_scene.h"

#include <cstdint>
#include <vector>

namespace spa::bake {

class WholeModel {
public:
    // Copies the model to the GPU, 152 bytes a triangle. `materials` outlives it.
    WholeModel(const GlFunctions& gl, const CenteredModel& model, const MaterialTable& materials);

    // One draw call with the program in use, or several where buffers are limited or textures change.
    void draw() const;

private:
    struct Run {
        std::uint32_t binding = 0, first = 0, triangles = 0;
    };
    struct Chunk {
        GlObject corners;
        std::vector<Run> runs;
    };

    const GlFunctions& gl_;
    const MaterialTable& materials_;
    std::vector<Chunk> chunks_;
};

} // namespace spa::bake
