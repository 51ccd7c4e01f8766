// SPDX-License-Identifier: Apache-2.0
// Direct light on triangles, on the CPU and in double precision but for Embree's hits: what frames are judged
// against. Shares no code with the renderer.
#pragma once

#include "../../libspa/mesh/scene.h"

#include <cstdint>
#include <vector>

namespace spa::test {

struct CpuPixel {
    bool hit = false;
    double depth = 0;
    Vec3d normal, albedo, direct;
};

// One ray through the centre of each pixel, row by row from the top.
std::vector<CpuPixel> render_on_cpu(const Scene& scene, const Camera& camera, std::uint32_t width,
                                    std::uint32_t height);

} // namespace spa::test
