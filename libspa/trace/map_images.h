// SPDX-License-Identifier: Apache-2.0
// Colours and normals of a part as words of the trace image.
#pragma once

#include "../core/spherical_map.h"

#include <cstdint>
#include <vector>

namespace spa::trace {

struct MapImages {
    std::vector<std::uint32_t>
        table; // SPA_IMAGE_WORDS a surface (shaders/spa_map.h); places from `words`' start
    std::vector<std::uint32_t> words;
};

// surfaces: as MapSamples::surfaces. Normals of any element format become octahedral snorm16; where there is
// no surface, SPA_NO_NORMAL.
MapImages read_images(const Part& part, std::uint32_t surfaces);

} // namespace spa::trace
