// SPDX-License-Identifier: Apache-2.0
#include "measure_map.h"

#include "map_surface.h"
#include "surface_samples.h"

#include "../bake/arena.h"
#include "../bake/progress_meter.h"
#include "../bake/shading.h"
#include "../core/error.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

namespace spa::measure {
namespace {

// A point of the model counts as captured if an exact layer ends there, but for rounding.
constexpr double captured_tolerance = 1e-5;

void require_equal_sizes(const Part& part) {
    const ImageView& first = part.layers.front().outer.depth;
    for (const Layer& layer : part.layers) {
        for (const Surface* s : {&layer.outer, &layer.inner}) {
            if (!s->empty() && (s->depth.width != first.width || s->depth.height != first.height))
                throw Error(ExitCode::unsupported,
                            "the map's depth images differ in size, which cannot be measured");
        }
    }
}

// A map without any surface is its centre: the distance to it is what is left to measure.
class DistanceTo {
public:
    explicit DistanceTo(const MapSurface& surface) {
        if (!surface.triangles.empty()) scene_.emplace(surface.positions, surface.triangles);
    }
    [[nodiscard]] double operator()(Vec3d p) const {
        return scene_ ? scene_->closest_point(p).distance : length(p);
    }

private:
    std::optional<trace::TriangleScene> scene_;
};

MapSurface stored_surface(const Part& part, double scale) {
    MapSurface result;
    for (const Layer& layer : part.layers) {
        for (const Surface* s : {&layer.outer, &layer.inner}) {
            if (s->empty()) continue;
            std::vector<double> depth;
            for (std::uint32_t y = 0; y < s->depth.height; ++y) {
                for (std::uint32_t x = 0; x < s->depth.width; ++x)
                    depth.push_back(scale * double(decode_depth(s->depth.format, s->depth.at(x, y))));
            }
            append_surface({part.mapping, s->depth.width, s->depth.height}, depth, part.frame, result);
        }
    }
    return result;
}

MapSurface exact_surface(const bake::SurfaceGrid& shape, const Mat3& frame) {
    MapSurface result;
    for (const std::vector<bake::SurfacePoint>& surface : shape.surfaces) {
        std::vector<double> depth;
        depth.reserve(surface.size());
        for (const bake::SurfacePoint& p : surface) depth.push_back(double(p.radius));
        append_surface(shape.grid, depth, frame, result);
    }
    return result;
}

// Points on the model's surface, without those where alpha leaves none.
std::vector<SurfaceSample> visible_samples(const Model& model, const Reference& reference,
                                           std::uint32_t count) {
    std::vector<SurfaceSample> samples = sample_surface(reference.object_positions(), model.triangles, count);
    const bake::Shader shader(reference.model());
    std::erase_if(samples, [&](const SurfaceSample& s) {
        return shader.needs_alpha(s.triangle) && !shader.color(s.triangle, s.barycentric, 0).visible;
    });
    return samples;
}

// Fills in all but the distances.
std::vector<SurfaceError> find_captured(const std::vector<SurfaceSample>& samples, const Part& part,
                                        const Reference& reference) {
    const Mat3 to_frame = inverse(part.frame);
    const Grid& grid = reference.shape().grid;
    std::vector<CenterRay> rays;
    rays.reserve(samples.size());
    for (const SurfaceSample& s : samples) {
        const Vec3d q = to_frame * s.position;
        const Vec2d at = position_of(grid, q);
        rays.push_back({wrap(grid, std::llround(at.x), std::llround(at.y)), q});
    }
    const bake::SurfaceGrid surfaces = reference.cast(grid, rays, {});
    std::vector<SurfaceError> result;
    result.reserve(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        result.push_back({to_float(rays[i].direction), 0, false});
        const double radius = length(rays[i].direction);
        for (const auto& surface : surfaces.surfaces)
            if (surface[i].radius > 0 && std::abs(double(surface[i].radius) - radius) < captured_tolerance)
                result.back().captured = true;
    }
    return result;
}

// Triangles that are points.
MapSurface captured_points(const std::vector<SurfaceSample>& samples,
                           const std::vector<SurfaceError>& errors) {
    MapSurface result;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (!errors[i].captured) continue;
        const auto v = std::uint32_t(result.positions.size());
        result.positions.push_back(to_float(samples[i].position));
        result.triangles.push_back({{v, v, v}});
    }
    return result;
}

void measure_surface(const Model& model, const Part& part, const Reference& reference,
                     const MeasureOptions& options, const bake::Progress& progress, Measurement& result) {
    const std::vector<SurfaceSample> samples = visible_samples(model, reference, options.surface_samples);
    result.surface = find_captured(samples, part, reference);
    const MapSurface stored = stored_surface(part, part.radius / reference.source_radius());
    const MapSurface exact = exact_surface(reference.shape(), part.frame);
    const DistanceTo to_stored(stored);
    const DistanceTo to_exact(exact);
    const MapSurface captured = captured_points(samples, result.surface);
    const DistanceTo to_captured(captured);
    std::vector<double> distance(samples.size());
    std::vector<double> exact_distance(samples.size());
    std::vector<double> star_distance(samples.size());
    bake::ProgressMeter meter(progress, samples.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, samples.size(), 256), [&](const auto& range) {
        if (meter.cancelled()) return;
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            distance[i] = to_stored(samples[i].position);
            exact_distance[i] = to_exact(samples[i].position);
            if (!result.surface[i].captured) star_distance[i] = to_captured(samples[i].position);
        }
        meter.add(range.size());
    });
    meter.throw_if_cancelled();

    for (std::size_t i = 0; i < samples.size(); ++i) {
        SurfaceError& error = result.surface[i];
        error.distance = float(distance[i]);
        if (error.captured)
            result.resolution_distances.push_back(exact_distance[i]);
        else
            result.star_distances.push_back(star_distance[i]);
    }
}

void summarize_surface(Measurement& result) {
    std::vector<double> distance;
    distance.reserve(result.surface.size());
    for (const SurfaceError& error : result.surface) distance.push_back(double(error.distance));
    result.captured_area =
        distance.empty() ? 0 : double(result.resolution_distances.size()) / double(distance.size());
    result.surface_distance = distribution(std::move(distance));
    result.star_error = distribution(result.star_distances);
    result.resolution_error = distribution(result.resolution_distances);
}

WorstTexel worst_texel(const TexelErrors& errors, const Grid& grid, std::size_t i, double value) {
    return {errors.part,
            errors.layer,
            errors.side,
            {std::uint32_t(i % grid.width), std::uint32_t(i / grid.width)},
            value};
}

struct Values {
    std::vector<double> all;
    std::optional<WorstTexel> worst;

    void add(const TexelErrors& errors, const Grid& grid, std::size_t i, double value) {
        if (std::isnan(value)) return;
        all.push_back(value);
        if (worst && !(value > worst->value)) return;
        worst = worst_texel(errors, grid, i, value);
    }
};

// parts: of the map. radius: R, in object space's unit of frames that do not stretch.
void summarize_texels(std::span<const Part> parts, double radius, Measurement& result) {
    Values distance;
    Values depth;
    Values normal;
    Values color;
    Values alpha;
    CoverageFigures& coverage = result.coverage;
    QuantizationFigures& quantization = result.quantization;
    for (const TexelErrors& errors : result.texels) {
        const Part& part = parts[errors.part];
        const double scale = part.radius / radius;
        const double bound =
            depth_quantum_error(surface_of(part, errors.layer, errors.side).depth.format) * scale;
        const ImageView normals = surface_of(part, errors.layer, errors.side).normal;
        const double normal_bound = normals.empty() ? 180 : normal_tolerance(normals.format);
        quantization.bound = std::max(quantization.bound, bound);
        coverage.texels += errors.state.size();
        for (std::size_t i = 0; i < errors.state.size(); ++i) {
            const TexelState state = errors.state[i];
            if (state == TexelState::tie) ++coverage.ties;
            if (state == TexelState::missing && ++coverage.missing == 1)
                result.first_missing = worst_texel(errors, errors.grid, i, 0);
            if (state == TexelState::extra && ++coverage.extra == 1)
                result.first_extra = worst_texel(errors, errors.grid, i, 0);
            if (double(errors.normal[i]) > normal_bound) ++result.normals_above;
            if (double(errors.depth[i]) > bound + float_rounding) ++quantization.above;
            if (std::isnan(errors.distance[i]) && !std::isnan(errors.depth[i])) ++result.shell_ends;
            distance.add(errors, errors.grid, i, double(errors.distance[i]));
            depth.add(errors, errors.grid, i, double(errors.depth[i]));
            normal.add(errors, errors.grid, i, double(errors.normal[i]));
        }
        for (std::size_t i = 0; i < errors.color.size(); ++i) {
            for (unsigned c = 0; c < 3; ++c)
                color.add(errors, errors.color_grid, i, double(errors.color[i][c]));
            alpha.add(errors, errors.color_grid, i, double(errors.color[i][3]));
        }
    }
    result.texel_distance = distribution(std::move(distance.all));
    quantization.error = distribution(std::move(depth.all));
    result.normal_angle = distribution(std::move(normal.all));
    result.color_difference = distribution(std::move(color.all));
    result.alpha_difference = distribution(std::move(alpha.all));
    result.worst_alpha = alpha.worst;
    result.worst_distance = distance.worst;
    result.worst_depth = depth.worst;
    result.worst_normal = normal.worst;
    result.worst_color = color.worst;
}

} // namespace

Measurement measure_map(const Model& model, const Part& part, const MeasureOptions& options,
                        const bake::Progress& progress) {
    require_equal_sizes(part);
    const auto between = [&](double from, double to) {
        return progress ? bake::Progress(
                              [&progress, from, to](double f) { return progress(from + (to - from) * f); })
                        : bake::Progress{};
    };
    const bool traces = options.rays > 0 && part.mapping == Mapping::octahedral;
    const double end = traces ? 0.7 : 1; // of the progress, without rays
    Measurement result;
    tbb::task_arena arena(bake::arena_concurrency(options.threads));
    arena.execute([&] {
        const Reference reference(model, part, options.layers, options.threads, between(0, 0.3 * end));
        result.source_radius = reference.source_radius();
        result.texels = texel_errors(part, reference, options.color_samples, options.threads,
                                     between(0.3 * end, 0.6 * end));
        measure_surface(model, part, reference, options, between(0.6 * end, end), result);
    });
    summarize_surface(result);
    summarize_texels({&part, 1}, result.source_radius, result);
    if (traces) {
        const RayOptions rays{.rays = options.rays, .layers = options.layers, .threads = options.threads};
        result.rays = measure_rays(model, part, rays, between(end, 1));
    }
    return result;
}

Measurement combine(std::span<const Measurement> measurements, std::span<const Part> parts, double radius) {
    Measurement whole;
    whole.source_radius = radius;
    std::uint64_t above = 0;
    for (std::uint32_t i = 0; i < measurements.size(); ++i) {
        const Measurement& one = measurements[i];
        const double scale = one.source_radius / radius;
        for (TexelErrors errors : one.texels) {
            errors.part = i;
            for (float& distance : errors.distance) distance *= float(scale);
            for (float& depth : errors.depth) depth *= float(scale);
            whole.texels.push_back(std::move(errors));
        }
        for (SurfaceError error : one.surface) {
            error.distance *= float(scale);
            whole.surface.push_back(error);
        }
        for (const double distance : one.star_distances) whole.star_distances.push_back(distance * scale);
        for (const double distance : one.resolution_distances)
            whole.resolution_distances.push_back(distance * scale);
        above += one.quantization.above;
    }
    summarize_surface(whole);
    summarize_texels(parts, radius, whole);
    whole.quantization.above = above; // rounding scales with the part
    return whole;
}

ErrorFigures error_figures(const Measurement& m) {
    ErrorFigures figures;
    figures.texel_distance_max = float(m.texel_distance.max);
    figures.texel_distance_mean = float(m.texel_distance.mean);
    figures.surface_distance_max = float(m.surface_distance.max);
    figures.surface_distance_mean = float(m.surface_distance.mean);
    figures.captured_area = float(m.captured_area);
    figures.normal_angle_mean = float(m.normal_angle.mean);
    figures.color_difference_mean = float(m.color_difference.mean);
    figures.quantization_bound = float(m.quantization.bound);
    return figures;
}

} // namespace spa::measure
