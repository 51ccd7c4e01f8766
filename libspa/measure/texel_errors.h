// SPDX-License-Identifier: Apache-2.0
// A stored surface against the reference, texel by texel.
#pragma once

#include "compare.h"
#include "reference.h"

#include <array>
#include <cstdint>
#include <vector>

namespace spa::measure {

enum class TexelState : std::uint8_t {
    empty,   // no surface, rightly
    exact,   // the reference's surface, within quantization
    tie,     // as exact, but of a direction within tie_distance: the texel's own meets an edge
    missing, // the reference has a surface here and the map has none
    extra,   // the map has a surface here and the reference has none
    off,     // both have a surface, and it is not the same
};

// One entry a texel, row-major; NaN where there is nothing to measure.
struct TexelErrors {
    std::uint32_t part = 0; // of the map
    std::uint32_t layer = 0;
    Side side = Side::outer;
    Grid grid; // of depth and normals
    std::vector<TexelState> state;
    std::vector<float> distance; // to the mesh in space, in R; NaN too at the inner end of a thin shell,
                                 // which is where it is by definition and not on the mesh
    std::vector<float> depth;    // |stored - exact| along the direction, in R
    std::vector<float> normal;   // angle in object space, degrees; NaN if the image has another size
    Grid color_grid;
    // |difference| of red, green, blue and alpha in codes of 255; the first three are NaN where map or
    // reference has no coverage, all four where both have none. As long as color_grid, or empty without an
    // image.
    using ColorError = std::array<float, 4>;
    std::vector<ColorError> color;
};

// What rounding to float may add to the error of a stored depth, in R: positions are float in meshes, bakers
// and reference alike.
constexpr double float_rounding = 1e-6;

// The largest error of a stored normal, in degrees (algorithms: numbers), and what interpolation in another
// precision may add.
double normal_tolerance(ElementFormat format);

// All surfaces of the part, outer before inner, layer by layer. color_samples: as the colours were baked
// (bake/bake_options.h). Throws bake::Cancelled.
//
// A texel that disagrees with the reference is looked at again along 32 directions around its own, at
// tie_distance: if one of them agrees, the direction meets an edge, where either surface is right. That is
// not done where more than 1/8 of all texels disagree: no mesh has so many edges.
// O(texels * log triangles).
std::vector<TexelErrors> texel_errors(const Part& part, const Reference& reference,
                                      std::uint32_t color_samples, unsigned threads,
                                      const bake::Progress& progress);

} // namespace spa::measure
