// SPDX-License-Identifier: Apache-2.0
// From crossings to intervals of solid. Source: ../../docs/baking.md, "Intervals".
#pragma once

#include "crossings.h"

#include "../mesh/components.h"

#include <array>
#include <cstdint>
#include <vector>

namespace spa::bake {

// One end of an interval along one direction; radius 0 = there is none.
struct SurfacePoint {
    float radius = 0;
    std::uint32_t triangle = 0; // that is crossed, index into Model::triangles
    Vec3f normal;               // for shading; points out of the solid
    std::array<std::uint8_t, 4> color{};
    bool placed = false; // the inner end of a thin shell, which lies below the surface by definition
};

// The stored surfaces over a grid: surface 2 k is the outer end of interval k, 2 k + 1 its inner end, each
// with one point a sample. With one layer there is only surface 0, the outermost crossing.
struct SurfaceGrid {
    Grid grid;
    std::vector<std::vector<SurfacePoint>> surfaces;
};

// From where on a piece counts as solid around the centre. A closed piece has winding number 0 or 1 there, an
// open one the share of directions that it covers, which for what people model is often a simple fraction:
// a half seen from its rim, n of 12 or 20 faces of a regular polyhedron. The threshold lies between the two
// of these that are nearest to one half, 10/20 and 11/20, so that the error of the sampled sum (some 1e-3)
// decides for none of them.
constexpr double solid_winding = 0.525;

// How the pieces of a model bound solid, estimated from all crossings over a grid.
struct Orientation {
    std::vector<bool> flipped; // per component: its faces point inwards
    std::vector<bool> solid;   // per component: its winding number at the centre is above solid_winding
    std::vector<bool> seen;    // per component: at least one crossing
};

// A component's signed volume and its generalised winding number at the centre (Jacobson et al. 2013) are
// integrals over directions of +-r^3/3 and +-1/(4 pi), summed over its crossings: the samples give both for
// free.
Orientation orient_components(const CrossingGrid& crossings, const Components& components);

struct IntervalStatistics {
    std::uint64_t thin_samples = 0;
    std::uint64_t truncated_samples = 0;
};

// Thickness of the shell that stands for a surface that bounds no solid, in units of R (measured in the
// layers study: thinner shells leak between samples).
constexpr float shell_thickness = 2e-4F;

// Pairs crossings component by component: coming from outside, a front face enters, a back face leaves its
// own component's last entry. An entry left over reaches the centre if its component is solid there, else it
// is a thin shell, and so is a back face that leaves nothing. The union of the intervals is kept, the
// outermost `layers` of them. Deterministic; parallel over samples in the caller's arena.
SurfaceGrid pair_intervals(const CrossingGrid& crossings, const Components& components,
                           const Orientation& orientation, std::uint32_t layers,
                           IntervalStatistics& statistics);

// One layer: the outermost crossing of each sample, its normal turned to the side seen.
SurfaceGrid outermost_surface(const CrossingGrid& crossings);

} // namespace spa::bake
