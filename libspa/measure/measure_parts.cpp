// SPDX-License-Identifier: Apache-2.0
#include "measure_parts.h"

#include "source_radius.h"

#include "../mesh/part_frame.h"
#include "../mesh/piece_model.h"

#include <algorithm>
#include <cmath>

namespace spa::measure {
namespace {

double area_of(const Model& model, std::span<const std::uint32_t> triangles) {
    double area = 0;
    for (const std::uint32_t t : triangles) {
        const auto corner = [&](unsigned k) {
            return to_double(model.positions[model.triangles[t].vertex[k]]);
        };
        area += length(cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
    }
    return area;
}

} // namespace

PartsMeasurement measure_parts(const Model& model, const Partition& partition, std::span<const Part> parts,
                               const MeasureOptions& options, const bake::Progress& progress) {
    PartsMeasurement result;
    if (parts.size() == 1) {
        result.whole = measure_map(model, parts.front(), options, progress);
        return result;
    }
    std::vector<double> areas;
    double all = 0;
    for (const Piece& piece : partition) all += areas.emplace_back(area_of(model, piece.triangles));
    const double rays_share = options.rays > 0 ? 0.3 : 0.0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        MeasureOptions of_part = options;
        of_part.rays = 0;
        of_part.surface_samples =
            std::uint32_t(std::max(1.0, std::round(double(options.surface_samples) * areas[i] / all)));
        const double count = double(parts.size());
        const auto within = [&, i](double share) {
            return !progress || progress((1 - rays_share) * (double(i) + share) / count);
        };
        result.parts.push_back(
            measure_map(piece_model(model, partition[i].triangles), parts[i], of_part, within));
    }
    bool moved = false;
    result.whole = combine(result.parts, parts, radius_about(model, bounds_center(model, moved), Mat3{}));
    if (options.rays > 0) {
        const RayOptions rays{.rays = options.rays, .layers = options.layers, .threads = options.threads};
        result.whole.rays = measure_rays(model, partition, parts, rays, [&](double share) {
            return !progress || progress(1 - rays_share + rays_share * share);
        });
    }
    return result;
}

} // namespace spa::measure
