// SPDX-License-Identifier: Apache-2.0
// How far two spherical maps differ, sample by sample. Metadata and error figures are not compared.
#pragma once

#include "../core/spherical_map.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace spa::measure {

enum class Side : std::uint8_t { outer, inner };
const char* name(Side side);

// Of a layer that the part does not have: an empty one.
Surface surface_of(const Part& part, std::size_t layer, Side side);

// The element of an image nearest to the direction of a sample of `grid`; the images of a surface may differ
// in size. The image is not empty and has the grid's mapping.
const std::byte* nearest_element(const ImageView& image, const Grid& grid, TexelIndex sample);

// The difference of one surface. Depth and normals are compared where both maps have a surface (normals at
// the samples of depth, unless one map has none), colours where both have coverage. Mean over nothing is 0.
struct SurfaceDifference {
    std::uint32_t part = 0, layer = 0;
    Side side = Side::outer;
    std::uint64_t samples = 0;
    std::uint64_t coverage_differs = 0;                        // samples with a surface in one map alone
    std::uint64_t both = 0;                                    // samples with a surface in both
    std::uint64_t depth_differs = 0;                           // of `both`: by more than depth_tolerance
    double depth_mean = 0, depth_max = 0;                      // |difference|, in units of R
    double normal_median = 0, normal_mean = 0, normal_max = 0; // degrees
    double color_mean = 0; // |difference| over red, green and blue, in codes of 255
    std::uint32_t color_max = 0;
    double alpha_mean = 0; // |difference| over all texels, in codes of 255
};

// How far two parts lie apart in space: what a sample means, before its value.
struct PartDifference {
    std::uint32_t part = 0;
    double center = 0; // distance, in units of the first one's R
    double radius = 0; // relative to the first one's
    double frame = 0;  // the largest |difference| of two elements
};

struct CompareOptions {
    double depth_tolerance = 2.0 / 65535; // two codes of u16, in units of R
};

struct MapDifference {
    // Why the maps cannot be compared sample by sample (part count, mapping, sizes); then `parts` and
    // `surfaces` are empty.
    std::optional<std::string> structure;
    std::vector<PartDifference> parts;
    // Every surface that either map has, by part, layer, side. One that a map lacks counts as without
    // samples.
    std::vector<SurfaceDifference> surfaces;
};

// Element formats may differ: decoded values are compared. O(samples).
MapDifference compare(const SphericalMap& a, const SphericalMap& b, const CompareOptions& options = {});

} // namespace spa::measure
