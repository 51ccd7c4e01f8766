// SPDX-License-Identifier: Apache-2.0
// The samples of a part as tracers have them.
#pragma once

#include "../core/spherical_map.h"

#include <cstdint>
#include <vector>

namespace spa::trace {

struct MapSamples {
    Grid grid;
    std::uint32_t surfaces = 1; // 1, or 2 a layer: outer, inner
    std::vector<float> depth;   // r/R of the outermost surface, 0 = none
    std::vector<float> w;       // octahedral: 1/|q|_1, plane by plane; SPA_FAR = none, or to the centre

    [[nodiscard]] std::size_t count() const { return std::size_t(grid.width) * grid.height; }
    [[nodiscard]] std::uint32_t layers() const { return (surfaces + 1) / 2; }
};

// layers: as many at most; 0: all.
MapSamples read_samples(const Part& part, std::uint32_t layers);

// Surface 2 k is the outer end of layer k, 2 k + 1 its inner end; null if it is not stored.
const Surface* stored_surface(const Part& part, std::uint32_t surface);

} // namespace spa::trace
