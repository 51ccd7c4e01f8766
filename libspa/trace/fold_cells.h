// SPDX-License-Identifier: Apache-2.0
// What stands in mixed triangles of a part with fold records. The definition is ../../docs/tracing.md, "Mixed
// triangles with folds".
#pragma once

#include "map_surface.h"

#include "../../shaders/spa_map.h"

#include "../core/cell_triangles.h"
#include "../core/folds.h"

#include <array>
#include <cstdint>
#include <vector>

namespace spa::trace {

// A function over a cell's places (u, v) in [0,1], from the corner nearest to the map's middle.
struct CellPlane {
    double c = 0, u = 0, v = 0;
    [[nodiscard]] double at(double at_u, double at_v) const { return c + u * at_u + v * at_v; }
};

struct CellPoint {
    double u = 0, v = 0;
};

// One interval over a convex piece of a triangle.
struct FoldPrism {
    CellPlane outer, inner; // W
    bool to_center = false; // it has no inner end
    std::uint32_t outer_layer = 0, inner_layer = 0;
    std::vector<CellPlane> half_planes; // >= 0 in the piece, of unit gradient
    std::uint32_t open = 0;             // bit n: the wall at half-plane n is open
    std::vector<CellPoint> corners;     // of regions that make up the piece: it is their hull
};

// The crossings of one sample, from outside in: W of each; the odd ones are inner ends.
using SampleCrossings = std::vector<double>;

class FoldCells {
public:
    // part: octahedral, with folds. Records that belong to no edge are passed over.
    explicit FoldCells(const Part& part);

    // Triangle `triangle` of cell (x, y), as in triangle_corners(). crossings: of its corners. False: its
    // records do not make sense there, and it is to be treated as if it had none. Fills prisms, and `core`
    // with the W beyond which all is solid (SPA_FAR: nowhere). O(crossings * log + records of the edges +
    // lines^2).
    bool triangle(std::uint32_t x, std::uint32_t y, unsigned triangle,
                  const std::array<SampleCrossings, 3>& crossings, std::vector<FoldPrism>& prisms,
                  double& core) const;

private:
    [[nodiscard]] std::pair<std::size_t, std::size_t> records_of(std::uint32_t edge) const;

    std::uint32_t cells_;
    bool center_inside_;
    std::vector<FoldRecord> records_; // edges ascending
};

} // namespace spa::trace
