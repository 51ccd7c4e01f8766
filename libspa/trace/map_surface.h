// SPDX-License-Identifier: Apache-2.0
// From the samples of a part to what stands in the cells of its map. The definition is ../../docs/tracing.md,
// "The stored surface"; the words are those of ../../shaders/spa_cell.h.
#pragma once

#include "map_ranges.h"
#include "map_samples.h"

#include "../core/spherical_map.h"

#include <cstdint>
#include <vector>

namespace spa::trace {

// The cells of an octahedral map. A quadrant has 2^levels x 2^levels of them, padding included; x counts from
// the middle to the right, and those to the left of the middle, counted to the left, come after them; so does
// y, upwards.
struct MapCells {
    std::uint32_t levels = 0;
    std::vector<Ranges> ranges; // of w in each cell
    std::vector<float> cores;   // the w beyond which everything in the cell is solid; SPA_FAR: there is none
    std::vector<std::uint32_t> lists;  // what mixed triangles hold; empty: none is mixed
    std::vector<std::uint32_t> cells;  // SPA_CELL_PURE, SPA_CELL_LAYERS, or where a cell's two lists are in
                                       // `lists`; empty: all are pure
    std::vector<std::uint32_t> places; // which words of `lists` are themselves places in `lists`
    std::size_t fold_triangles = 0, tangent_triangles = 0; // mixed ones, by what divides them
    float radius = 0;                                      // of the farthest point, in units of R, rounded up
    Vec3f box_low, box_high;                               // around all points, rounded outward
    float w_min = 0, w_max = 0;                            // of all finite ends; 1 if there are none
    bool uniform_core = false; // around the centre, within 1/w_max, everything is solid, or nothing
};

// O(samples). At most 2^14 cells a side.
MapCells find_cells(const Part& part, const MapSamples& samples);

} // namespace spa::trace
