// SPDX-License-Identifier: Apache-2.0
// What the orbit baker must deliver, computed another way: every triangle projected into every view in double
// precision, textures filtered by hand.
#pragma once

#include "../../libspa/bake/crossings.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace spa::test {

// The model scaled into the unit sphere around the origin, which stays where it is.
bake::CenteredModel normalized(const Model& model);

// `count` random triangles with vertex colours, and materials of all alpha modes, wrap modes and filters,
// with textures of several sizes and without.
Model random_textured_soup(std::uint32_t count, std::uint32_t seed);

// The crossings of one sample, outermost first. Nothing where rounding may decide: an edge, an alpha at its
// threshold, or another crossing is closer than the baker's arithmetic can tell.
std::optional<std::vector<bake::Crossing>> cast_reference(const bake::CenteredModel& model, const Grid& grid,
                                                          TexelIndex texel);

struct Comparison {
    std::size_t compared = 0;  // samples
    std::size_t undecided = 0; // samples left out because rounding may decide
    std::size_t wrong = 0;     // samples with other triangles or another number of crossings
    double radius = 0;         // largest differences
    double normal = 0;
    int color = 0;
};

// layers: all crossings; otherwise the outermost. step: every how manyth sample is compared.
Comparison compare_with_reference(const bake::CrossingGrid& crossings, const bake::CenteredModel& model,
                                  bool layers, std::size_t step = 1);

} // namespace spa::test
