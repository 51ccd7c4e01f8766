// SPDX-License-Identifier: Apache-2.0
#include "star_map.h"

#include "../bake/center.h"
#include "../bake/mixed.h"
#include "../bake/pack.h"
#include "../bake/radial.h"
#include "../mesh/components.h"

#include <algorithm>
#include <utility>

namespace spa::measure {

bake::OwnedMap star_map(const Model& model, const Part& part, double radius, std::uint32_t layers,
                        std::uint32_t cells, unsigned threads, const bake::Progress& progress) {
    bake::Options options;
    options.grid = options.color_grid = {Mapping::octahedral, cells + 1, cells + 1};
    options.layers = std::max(layers, std::uint32_t(part.layers.size()));
    options.depth = ElementFormat::f32;
    const bool outermost_only = options.layers == 1 && part.layers.front().inner.empty();
    const bake::CenteredModel centered = bake::center_model(model, {part.center, part.frame, radius});
    const bake::CrossingGrid crossings =
        bake::cast_radial(centered, options.grid, {outermost_only, threads, progress});

    Part star;
    star.center = part.center;
    star.frame = part.frame;
    star.radius = radius;
    star.center_inside = part.center_inside;
    bake::SurfaceGrid surfaces;
    if (outermost_only) {
        surfaces = bake::outermost_surface(crossings);
    } else {
        const Components components = find_components(model);
        const bake::Orientation orientation = bake::orient_components(crossings, components);
        bake::IntervalStatistics statistics;
        surfaces = bake::pair_intervals(crossings, components, orientation, options.layers, statistics);
    }
    bake::OwnedMap map;
    bake::pack_layers(surfaces, surfaces, options, star, map);
    bake::pack_mixed(bake::mixed_triangles(surfaces, bake::face_normals(centered)), star, map);
    map.map.parts.push_back(std::move(star));
    return map;
}

} // namespace spa::measure
