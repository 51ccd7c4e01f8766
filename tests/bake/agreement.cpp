// SPDX-License-Identifier: Apache-2.0
#include "agreement.h"

#include "../../libspa/bake/orbit.h"
#include "../../libspa/bake/radial.h"
#include "../../libspa/bake/sample_rays.h"
#include "../../libspa/core/element_format.h"
#include "../../libspa/core/error.h"
#include "../../libspa/measure/cast_embree.h"
#include "../../libspa/measure/compare.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <span>

namespace spa::test {
namespace {

using bake::Crossing;
using bake::CrossingGrid;

std::span<const Crossing> crossings_of(const CrossingGrid& grid, std::size_t sample) {
    return {grid.crossings.data() + grid.first[sample],
            std::size_t(grid.first[sample + 1] - grid.first[sample])};
}

// Samples whose coverage or depth differs in some surface.
std::vector<bool> differing_samples(const SphericalMap& a, const SphericalMap& b, const Grid& grid) {
    std::vector<bool> differs(std::size_t(grid.width) * grid.height, false);
    const Part& pa = a.parts.front();
    const Part& pb = b.parts.front();
    const double tolerance = measure::CompareOptions{}.depth_tolerance * (1 + 1e-6);
    for (std::size_t l = 0; l < std::max(pa.layers.size(), pb.layers.size()); ++l) {
        for (const measure::Side side : {measure::Side::outer, measure::Side::inner}) {
            const Surface sa = measure::surface_of(pa, l, side);
            const Surface sb = measure::surface_of(pb, l, side);
            const auto depth = [](const Surface& s, std::uint32_t x, std::uint32_t y) {
                return s.depth.empty() ? 0.0 : double(decode_depth(s.depth.format, s.depth.at(x, y)));
            };
            for (std::size_t i = 0; i < differs.size(); ++i) {
                const auto x = std::uint32_t(i % grid.width);
                const auto y = std::uint32_t(i / grid.width);
                const double da = depth(sa, x, y);
                const double db = depth(sb, x, y);
                if ((da > 0) != (db > 0) || std::abs(da - db) > tolerance) differs[i] = true;
            }
        }
    }
    return differs;
}

} // namespace

bool agrees(const Agreement& a) { return a.coverage <= 0.001 && a.depth <= 0.001 && a.color <= 1.0; }

Comparison::Comparison(const Model& model, const bake::Options& options)
    : model_(model), options_(options), radial_(bake_by(bake::cast_radial)) {}

Comparison::Baked Comparison::bake_by(const bake::Caster& caster) const {
    Baked baked;
    const bake::Caster keep = [&](const bake::CenteredModel& model, const Grid& grid,
                                  const bake::CastOptions& cast) {
        baked.model = model;
        return baked.crossings = caster(model, grid, cast);
    };
    baked.result = bake::bake_with(keep, model_, options_);
    return baked;
}

Agreement Comparison::of_orbit(bake::GlApi gl) const {
    const auto context = bake::make_gl_context(gl);
    return of(bake_by([&](const bake::CenteredModel& model, const Grid& grid, const bake::CastOptions& cast) {
        return bake::cast_orbit(*context, model, grid, options_.gl_naive, cast);
    }));
}

Agreement Comparison::of_embree() const {
    return of(bake_by([](const bake::CenteredModel& model, const Grid& grid, const bake::CastOptions& cast) {
        const trace::TriangleScene scene(model.positions, model.model->triangles);
        return measure::cast_embree(model, scene, grid, cast);
    }));
}

Agreement Comparison::of(const Baked& other) const {
    const measure::MapDifference difference = measure::compare(radial_.result.map.map, other.result.map.map);
    if (difference.structure) throw Error(ExitCode::internal, *difference.structure);
    Agreement result;
    for (const measure::SurfaceDifference& s : difference.surfaces) {
        result.coverage = std::max(result.coverage, double(s.coverage_differs) / double(s.samples));
        if (s.both == 0) continue;
        result.depth = std::max(result.depth, double(s.depth_differs) / double(s.both));
        result.color = std::max(result.color, s.color_mean);
        result.color_max = std::max(result.color_max, s.color_max);
        result.normal = std::max(result.normal, s.normal_median);
    }
    const auto mixed_here = radial_.result.map.map.parts.front().mixed;
    const auto mixed_there = other.result.map.map.parts.front().mixed;
    for (std::size_t i = 0; i < mixed_here.size(); ++i)
        result.mixed +=
            std::uint64_t(std::popcount(std::to_integer<unsigned>(mixed_here[i] ^ mixed_there[i])));
    const std::vector<bool> differs =
        differing_samples(radial_.result.map.map, other.result.map.map, options_.grid);
    for (std::size_t s = 0; s < differs.size(); ++s) {
        if (!differs[s]) continue;
        ++result.differing;
        ++(is_tie(other.crossings, s) ? result.ties : result.unexplained);
    }
    return result;
}

bool Comparison::is_tie(const CrossingGrid& other, std::size_t sample) const {
    const Vec3d g = sample_direction(options_.grid, {std::uint32_t(sample % options_.grid.width),
                                                     std::uint32_t(sample / options_.grid.width)});
    const auto found_here = crossings_of(radial_.crossings, sample);
    const auto found_there = crossings_of(other, sample);
    const auto tie_in = [&](std::span<const Crossing> a, std::span<const Crossing> b) {
        return std::any_of(a.begin(), a.end(), [&](const Crossing& c) {
            const auto same = [&](const Crossing& d) { return d.triangle == c.triangle; };
            if (std::any_of(b.begin(), b.end(), same)) return false;
            const bake::RaySetup setup(radial_.model, model_.triangles[c.triangle]);
            return std::any_of(std::begin(setup.edge), std::end(setup.edge), [&](Vec3d edge) {
                const double sine = std::abs(dot(edge, g)) / (length(edge) * length(g));
                return sine * double(c.radius) < edge_tie;
            });
        });
    };
    return tie_in(found_here, found_there) || tie_in(found_there, found_here);
}

} // namespace spa::test
