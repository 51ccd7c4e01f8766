// SPDX-License-Identifier: Apache-2.0
#include "shape_baker.h"

#include "candidate.h"
#include "file_bytes.h"

#include "../bake/center.h"
#include "../bake/find_folds.h"
#include "../bake/mixed.h"
#include "../bake/pack.h"
#include "../bake/radial.h"

#include <algorithm>
#include <utility>

namespace spa::plan {
namespace {

// Below this the triangles take longer than the samples.
constexpr std::uint32_t cells_at_once = 128;
// Colours are estimated from maps of so many cells.
constexpr std::uint32_t color_probe_cells = 32;

// Where and how large; the map itself is thrown away.
Part place_of(const Model& model, const bake::Options& options) {
    bake::Options smallest = options;
    smallest.grid = smallest.color_grid = grid_of(Mapping::octahedral, 2);
    smallest.layers = 1;
    smallest.samples = 1;
    smallest.baker = bake::Baker::radial;
    Part part = bake::bake_model(model, smallest).map.map.parts.front();
    part.layers.clear();
    part.mixed = part.folds = {};
    return part;
}

bool alpha_decides(const Model& model) {
    return std::any_of(model.materials.begin(), model.materials.end(),
                       [](const Material& m) { return m.alpha_mode != AlphaMode::opaque; });
}

bake::CrossingGrid every_sample_of(const bake::CrossingGrid& fine, std::uint32_t cells) {
    bake::CrossingGrid coarse;
    coarse.grid = grid_of(Mapping::octahedral, cells);
    const std::uint32_t step = (fine.grid.width - 1) / cells;
    coarse.first.push_back(0);
    for (std::uint32_t y = 0; y <= cells; ++y) {
        for (std::uint32_t x = 0; x <= cells; ++x) {
            const std::size_t s = std::size_t(y * step) * fine.grid.width + std::size_t(x) * step;
            coarse.crossings.insert(coarse.crossings.end(),
                                    fine.crossings.begin() + std::ptrdiff_t(fine.first[s]),
                                    fine.crossings.begin() + std::ptrdiff_t(fine.first[s + 1]));
            coarse.first.push_back(coarse.crossings.size());
        }
    }
    return coarse;
}

// As many empty surfaces as a map has, on the smallest grid.
bake::SurfaceGrid no_surfaces(Mapping mapping, std::size_t count) {
    bake::SurfaceGrid none;
    none.grid = grid_of(mapping, 2);
    none.surfaces.resize(count,
                         std::vector<bake::SurfacePoint>(std::size_t(none.grid.width) * none.grid.height));
    return none;
}

} // namespace

ShapeBaker::ShapeBaker(const Model& model, const Components& components, const bake::Options& options,
                       const bake::Progress& progress)
    : model_(model), components_(components), threads_(options.threads), progress_(progress),
      place_(place_of(model, options)), solid_of_one_depth_(place_.center_inside),
      common_samples_(options.grid.mapping == Mapping::octahedral && !alpha_decides(model)),
      centered_(bake::center_model(model, {place_.center, place_.frame, place_.radius})) {
    place_.mapping = options.grid.mapping;
}

std::uint32_t ShapeBaker::cells_to_cast(std::uint32_t cells) const {
    if (!common_samples_) return cells;
    while (cells * 2 <= cells_at_once) cells *= 2;
    return cells;
}

const bake::CrossingGrid& ShapeBaker::crossings(const Grid& grid, bool outermost_only) {
    Casts& casts = outermost_only ? outermost_ : all_;
    if (casts.latest.grid == grid) return casts.latest;
    const bake::CastOptions options{outermost_only, threads_, progress_};
    if (!common_samples_) {
        casts.latest = bake::cast_radial(centered_, grid, options);
        return casts.latest;
    }
    const std::uint32_t cells = cells_of(grid);
    std::uint32_t family = cells;
    while (family % 2 == 0) family /= 2;
    bake::CrossingGrid& cast = casts.largest[family];
    if (cast.grid.width < grid.width)
        cast = bake::cast_radial(centered_, grid_of(grid.mapping, cells_to_cast(cells)), options);
    if (cast.grid == grid) return cast;
    casts.latest = every_sample_of(cast, cells);
    return casts.latest;
}

bake::SurfaceGrid ShapeBaker::surfaces(const bake::CrossingGrid& crossings, const bake::Options& options,
                                       bake::Orientation& orientation, bool& truncated) const {
    if (options.one_depth()) {
        truncated = true; // solid to the centre is not what intervals say
        return bake::outermost_surface(crossings);
    }
    orientation = bake::orient_components(crossings, components_);
    bake::IntervalStatistics statistics;
    bake::SurfaceGrid result =
        bake::pair_intervals(crossings, components_, orientation, options.layers, statistics);
    truncated = statistics.truncated_samples > 0;
    return result;
}

Shape ShapeBaker::bake(const bake::Options& options) {
    const bake::CrossingGrid& seen = crossings(options.grid, options.one_depth());
    Shape result;
    bake::Orientation orientation;
    const bake::SurfaceGrid shape = surfaces(seen, options, orientation, result.truncated);
    const bake::SurfaceGrid no_color = no_surfaces(options.grid.mapping, shape.surfaces.size());
    bake::Options packed = options;
    packed.samples = 1;
    packed.color_grid = no_color.grid;
    Part part = place_;
    part.center_inside = options.one_depth() ? solid_of_one_depth_
                                             : std::find(orientation.solid.begin(), orientation.solid.end(),
                                                         true) != orientation.solid.end();
    bake::pack_layers(shape, no_color, packed, part, result.map);
    if (part.mapping == Mapping::octahedral) {
        const std::uint32_t cells = cells_of(options.grid);
        std::vector<std::uint8_t> edges = bake::match_edges(shape, bake::face_normals(centered_));
        if (options.folds && !options.one_depth() && cells <= bake::most_fold_cells &&
            options.layers <= bake::most_fold_layers)
            bake::pack_folds(bake::find_folds(centered_, components_, orientation, shape, edges).records,
                             part, result.map);
        bake::pack_mixed(bake::mixed_triangles(cells, edges), part, result.map);
    }
    result.map.map.parts.push_back(std::move(part));
    return result;
}

std::uint64_t ShapeBaker::estimate_color_bytes(const bake::Options& options, bool compress) {
    bake::Options probe = options;
    probe.grid = grid_of(options.grid.mapping, color_probe_cells);
    probe.samples = 1;
    bake::Orientation orientation;
    bool truncated = false;
    const bake::SurfaceGrid shape =
        surfaces(crossings(probe.grid, probe.one_depth()), probe, orientation, truncated);
    const auto bytes_with = [&](const bake::SurfaceGrid& color) {
        probe.color_grid = color.grid;
        bake::OwnedMap map;
        Part part = place_;
        bake::pack_layers(shape, color, probe, part, map);
        map.map.parts.push_back(std::move(part));
        return double(file_bytes(map.map, compress));
    };
    const double colors =
        bytes_with(shape) - bytes_with(no_surfaces(options.grid.mapping, shape.surfaces.size()));
    const double ratio = double(cells_of(options.color_grid)) / color_probe_cells;
    return std::uint64_t(std::max(colors, 0.0) * ratio * ratio);
}

} // namespace spa::plan
