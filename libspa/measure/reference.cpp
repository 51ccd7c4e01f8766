// SPDX-License-Identifier: Apache-2.0
#include "reference.h"

#include "source_radius.h"

#include "../bake/center.h"
#include "../core/error.h"

#include <algorithm>

namespace spa::measure {
Reference::Reference(const Model& model, const Part& part, std::uint32_t layers, unsigned threads,
                     const bake::Progress& progress)
    : source_radius_(radius_about(model, part.center, part.frame)),
      layers_(std::max(layers, std::uint32_t(part.layers.size()))),
      outermost_only_(layers_ == 1 && part.layers.front().inner.empty()), threads_(threads) {
    const double ratio = part.radius / source_radius_;
    if (!(ratio < 1000 && ratio > 1e-3)) {
        throw Error(ExitCode::limits,
                    "the map's radius is " + std::to_string(ratio) +
                        " times that of the source about the same centre: it is of another object");
    }
    model_ = std::make_unique<bake::CenteredModel>(
        bake::center_model(model, {part.center, part.frame, source_radius_}));
    scene_ = std::make_unique<trace::TriangleScene>(model_->positions, model.triangles);
    if (!(part.frame == Mat3{})) {
        object_positions_.reserve(model_->positions.size());
        for (const Vec3f& q : model_->positions)
            object_positions_.push_back(to_float(part.frame * to_double(q)));
        object_scene_ = std::make_unique<trace::TriangleScene>(object_positions_, model.triangles);
    }
    const ImageView& depth = part.layers.front().outer.depth;
    const Grid grid{part.mapping, depth.width, depth.height};
    const bake::CrossingGrid crossings =
        cast_embree(*model_, *scene_, grid, {outermost_only_, threads_, progress});
    if (!outermost_only_) {
        components_ = find_components(model);
        orientation_ = bake::orient_components(crossings, components_);
    }
    shape_ = pair(crossings);
}

std::span<const Vec3f> Reference::object_positions() const {
    return object_positions_.empty() ? model_->positions : object_positions_;
}

bake::SurfaceGrid Reference::pair(const bake::CrossingGrid& crossings) const {
    if (outermost_only_) return bake::outermost_surface(crossings);
    bake::IntervalStatistics statistics;
    return bake::pair_intervals(crossings, components_, orientation_, layers_, statistics);
}

bake::SurfaceGrid Reference::cast(const Grid& grid, const bake::Progress& progress) const {
    return pair(cast_embree(*model_, *scene_, grid, {outermost_only_, threads_, progress}));
}

bake::SurfaceGrid Reference::cast(const Grid& grid, std::span<const CenterRay> rays,
                                  const bake::Progress& progress) const {
    return pair(cast_embree(*model_, *scene_, grid, rays, {outermost_only_, threads_, progress}));
}

} // namespace spa::measure
