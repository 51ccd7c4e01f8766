// SPDX-License-Identifier: Apache-2.0
#include "candidate.h"

namespace spa::plan {

Grid grid_of(Mapping mapping, std::uint32_t cells) {
    if (mapping == Mapping::latlong) return {mapping, cells, cells / 2};
    return {mapping, cells + 1, cells + 1};
}

std::uint32_t cells_of(const Grid& grid) {
    return grid.mapping == Mapping::latlong ? grid.width : grid.width - 1;
}

bake::Options options_of(const Candidate& candidate, const bake::Options& base) {
    bake::Options options = base;
    options.grid = grid_of(base.grid.mapping, candidate.cells);
    options.color_grid = grid_of(base.grid.mapping, candidate.color_cells);
    options.depth = candidate.depth;
    options.layers = candidate.layers;
    options.frame = candidate.frame;
    options.center = candidate.center;
    return options;
}

} // namespace spa::plan
