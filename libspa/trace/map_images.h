// SPDX-License-Identifier: Apache-2.0
// Colours and normals of a part as words of the trace image.
#pragma once

#include "../core/spherical_map.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace spa::trace {

// surfaces: as MapSamples::surfaces.
std::size_t image_words(const Part& part, std::uint32_t surfaces);

// Normals of any element format become octahedral snorm16; where there is no surface, SPA_NO_NORMAL. words:
// image_words() of them, written from first to last and never read. Returns the table of shaders/spa_map.h,
// SPA_IMAGE_WORDS a surface, with places counted from `first`, which is that of words[0].
std::vector<std::uint32_t> write_images(const Part& part, std::uint32_t surfaces, std::uint32_t first,
                                        std::span<std::uint32_t> words);

} // namespace spa::trace
