// SPDX-License-Identifier: Apache-2.0
// One setting of a bake, as a search tries it.
#pragma once

#include "../bake/bake_options.h"

#include <cstdint>

namespace spa::plan {

// What a search decides. All else - mapping, normals, folds, samples - is the same for all candidates.
struct Candidate {
    std::uint32_t cells = 0; // of depth and normals: a side of an octahedral map, the width of a latlong
    std::uint32_t color_cells = 0; // of colour, likewise
    ElementFormat depth = ElementFormat::u16;
    std::uint32_t layers = 1;
    bake::Frame frame = bake::Frame::sphere;
    bake::Center center = bake::Center::bounds;
    friend bool operator==(const Candidate&, const Candidate&) = default;
};

// An octahedral grid of `cells` cells a side; a latlong one of cells x cells / 2 texels.
Grid grid_of(Mapping mapping, std::uint32_t cells);
// The inverse.
std::uint32_t cells_of(const Grid& grid);

// What bake_model is asked for to bake it. base: all else.
bake::Options options_of(const Candidate& candidate, const bake::Options& base);

} // namespace spa::plan
