// SPDX-License-Identifier: Apache-2.0
// What a bake can be asked for. The defaults are those of the `spa bake` command but for frame and centre,
// which that chooses (automatic): here they are where a caller would expect them without looking.
#pragma once

#include "../core/direction_map.h"
#include "../core/element_format.h"

#include <cstdint>

namespace spa::bake {

enum class Frame : std::uint8_t {
    sphere,    // the identity: the map lives in a sphere in object space
    affine,    // the frame in which the oriented bounding box is a cube
    automatic, // affine where that helps: placement.h
};
enum class Center : std::uint8_t {
    bounds,    // the centre of the axis-aligned bounding box
    captured,  // the point from which the surface is held best: placement.h
    automatic, // captured where that helps
};
enum class Baker : std::uint8_t { radial, orbit };
enum class GlApi : std::uint8_t { automatic, egl, osmesa };

struct Options {
    Grid grid{Mapping::octahedral, 257, 257};       // samples of depth and normals
    Grid color_grid{Mapping::octahedral, 257, 257}; // samples of colour; same mapping as grid
    ElementFormat depth = ElementFormat::u16;
    ElementFormat normals = ElementFormat::oct16;
    // 1: the outermost surface alone, taken as solid to the centre (the paper's data).
    // K > 1: the outermost K intervals of solid, each with its outer and inner surface.
    std::uint32_t layers = 2;
    bool inner_of_one = false; // layers = 1: the outermost interval with its inner surface, as of K > 1
    bool folds = true; // intervals on octahedral maps: store how surfaces end between samples (folds.h)
    Frame frame = Frame::sphere;
    Center center = Center::bounds;
    Baker baker = Baker::radial;
    GlApi gl = GlApi::automatic;
    bool gl_naive = false;     // orbit: one draw and one read-back a view
    std::uint32_t samples = 1; // samples^2 sub-texel samples of colour and coverage a texel, 1..8
    unsigned threads = 0;      // 0 = all cores; the result does not depend on it

    // Only the outermost surface, without intervals.
    [[nodiscard]] bool one_depth() const { return layers == 1 && !inner_of_one; }
};

} // namespace spa::bake
