// SPDX-License-Identifier: Apache-2.0
#include "bake.h"

#include "arena.h"
#include "center.h"
#include "color_image.h"
#include "find_folds.h"
#include "intervals.h"
#include "mixed.h"
#include "orbit.h"
#include "pack.h"
#include "radial.h"
#include "winding.h"

#include "../core/cell_triangles.h"
#include "../core/error.h"
#include "../mesh/closest_point.h"
#include "../mesh/components.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace spa::bake {
namespace {

constexpr double on_surface_distance = 1e-4;

bool touches_center(Vec3d a, Vec3d b, Vec3d c) {
    // Most triangles lie clearly to one side of it along some axis.
    constexpr double clear = on_surface_distance * 1.001;
    const auto aside = [](double p, double q, double r) {
        return std::min(std::min(p, q), r) > clear || std::max(std::max(p, q), r) < -clear;
    };
    if (aside(a.x, b.x, c.x) || aside(a.y, b.y, c.y) || aside(a.z, b.z, c.z)) return false;
    return length(closest_point_on_triangle({}, a, b, c)) < on_surface_distance;
}

// What can be said of the triangles as the centre sees them. Whether it is inside costs time, and is asked
// only where crossings will not tell.
void inspect_triangles(const CenteredModel& centered, const Components& components, bool ask_inside,
                       Report& report) {
    struct Findings {
        std::uint64_t edge_on = 0;
        bool on_surface = false;
    };
    const auto& triangles = centered.model->triangles;
    WindingNumbers winding(components);
    const Findings findings = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, triangles.size(), 16384), Findings{},
        [&](const auto& range, Findings found) {
            WindingNumbers::Run run(winding);
            for (std::size_t t = range.begin(); t < range.end(); ++t) {
                const Vec3d a = to_double(centered.positions[triangles[t].vertex[0]]);
                const Vec3d b = to_double(centered.positions[triangles[t].vertex[1]]);
                const Vec3d c = to_double(centered.positions[triangles[t].vertex[2]]);
                if (dot(a, cross(b, c)) == 0) ++found.edge_on;
                if (!found.on_surface) found.on_surface = touches_center(a, b, c);
                if (ask_inside) run.add(t, a, b, c);
            }
            return found;
        },
        [](const Findings& p, const Findings& q) {
            return Findings{p.edge_on + q.edge_on, p.on_surface || q.on_surface};
        });
    report.edge_on_triangles = findings.edge_on;
    report.center_on_surface = findings.on_surface;
    report.center_inside = winding.any_solid();
}

std::uint64_t back_facing_samples(const CrossingGrid& crossings) {
    std::uint64_t count = 0;
    for (std::size_t s = 0; s + 1 < crossings.first.size(); ++s) {
        if (crossings.first[s] != crossings.first[s + 1] &&
            !crossings.crossings[crossings.first[s]].front_facing) {
            ++count;
        }
    }
    return count;
}

// The stored surfaces of one grid. What is learned of the pieces on the first grid is used on the second, so
// that depth and colour are paired alike.
class Surfaces {
public:
    Surfaces(const Caster& caster, const CenteredModel& model, const Components& components,
             const Options& options, Report& report)
        : caster_(caster), model_(model), components_(components), options_(options), report_(report) {}

    SurfaceGrid cast(const Grid& grid, const Progress& progress) {
        const CrossingGrid crossings =
            caster_(model_, grid, {options_.one_depth(), options_.threads, progress});
        const bool first = orientation_.seen.empty();
        if (first) {
            orientation_ = orient_components(crossings, components_);
            report_.back_facing_samples = back_facing_samples(crossings);
            for (std::uint32_t c = 0; c < components_.count; ++c) {
                if (!orientation_.seen[c]) ++report_.unseen_components;
                if (options_.one_depth()) continue;
                if (orientation_.flipped[c]) ++report_.flipped_components;
                if (orientation_.solid[c]) ++report_.solid_components;
            }
            if (report_.solid_components > 0) report_.center_inside = true;
        }
        if (options_.one_depth()) return outermost_surface(crossings);
        IntervalStatistics statistics;
        SurfaceGrid surfaces =
            pair_intervals(crossings, components_, orientation_, options_.layers, statistics);
        if (first) {
            report_.thin_samples = statistics.thin_samples;
            report_.truncated_samples = statistics.truncated_samples;
        }
        return surfaces;
    }

    // After the first cast.
    [[nodiscard]] const Orientation& orientation() const { return orientation_; }

private:
    const Caster& caster_;
    const CenteredModel& model_;
    const Components& components_;
    const Options& options_;
    Report& report_;
    Orientation orientation_;
};

std::string plural(std::uint64_t count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

void add_warnings(Report& report, const Options& options) {
    const auto warn = [&](std::string text) { report.warnings.push_back(std::move(text)); };
    if (report.layers.front().outer_coverage == 0) {
        warn("no direction from the centre meets the surface: the map is empty; try --center captured");
    }
    if (report.center_moved > 0) {
        warn("the centre of the bounding box lies on the surface, where the inside cannot be told from the "
             "outside: it was moved by " +
             std::to_string(int(std::lround(100 * report.center_moved))) + " % of the radius");
    }
    if (report.center_on_surface) {
        warn("the centre lies on the surface, so depths near it are unreliable; try --center captured");
    }
    if (report.edge_on_triangles > 0) {
        warn(plural(report.edge_on_triangles, "triangle is", "triangles are") +
             " seen edge-on from the centre and cannot be stored");
    }
    if (report.unseen_components > 0) {
        warn(plural(report.unseen_components, "piece", "pieces") + " of " +
             std::to_string(report.components) + " met no sample: thinner than the sampling, or hidden" +
             (options.one_depth() ? " behind others; more --layers or a larger --size may keep them"
                                  : "; a larger --size may keep them"));
    }
    if (report.truncated_samples > 0) {
        warn(plural(report.truncated_samples, "sample has", "samples have") + " more surfaces than " +
             plural(options.layers, "layer holds", "layers hold") + "; the innermost are left out");
    }
}

} // namespace

Result bake_model(const Model& model, const Options& options, const Progress& progress) {
    if (options.baker == Baker::radial) return bake_with(cast_radial, model, options, progress);
    const std::unique_ptr<GlContext> context = make_gl_context(options.gl);
    const Caster orbit = [&](const CenteredModel& centered, const Grid& grid, const CastOptions& cast) {
        return cast_orbit(*context, centered, grid, options.gl_naive, cast);
    };
    Result result = bake_with(orbit, model, options, progress);
    result.report.gl = context->description();
    return result;
}

Result bake_with(const Caster& cast, const Model& model, const Options& options, const Progress& progress) {
    const auto start = std::chrono::steady_clock::now();
    if (model.triangles.empty())
        throw Error(ExitCode::invalid_data, "the model has no triangles: nothing to bake");
    Result result;
    Report& report = result.report;
    tbb::task_arena arena(arena_concurrency(options.threads));
    arena.execute([&] {
        const Components components = find_components(model);
        report.placement = place_part(model, options, components.turned);
        const Vec3d center = report.placement.center;
        if (report.placement.moved_behind) {
            report.warnings.emplace_back(
                "the object is flat, so the centre of its bounding box would see it edge-on: the "
                "centre was moved behind it");
        }
        const auto place = [&](Vec3d at) { return make_part_frame(model, at, report.placement.frame); };
        PartFrame frame = place(center);
        CenteredModel centered = center_model(model, frame);
        const bool ask_inside = options.one_depth();
        inspect_triangles(centered, components, ask_inside, report);
        if (report.center_on_surface) {
            const double radius = frame.radius;
            frame = place(center_off_surface(model, center));
            centered = center_model(model, frame);
            report.center_moved = length(frame.center - center) / radius;
            inspect_triangles(centered, components, ask_inside, report);
        }
        report.triangles = model.triangles.size();
        report.components = components.count;
        report.open_edges = components.open_edges;
        report.turned_triangles =
            std::uint64_t(std::count(components.turned.begin(), components.turned.end(), 1));

        const Grid color_grid = fine_grid(options.color_grid, options.samples);
        const bool shared = color_grid == options.grid;
        const double color_samples = shared ? 0 : double(color_grid.width) * color_grid.height;
        const double shape_samples = double(options.grid.width) * options.grid.height;
        const double split = shape_samples / (shape_samples + color_samples);
        const auto between = [&](double from, double to) {
            return progress ? Progress([&progress, from, to](double f) {
                return progress(from + (to - from) * f);
            })
                            : Progress{};
        };
        Surfaces surfaces(cast, centered, components, options, report);
        const SurfaceGrid shape = surfaces.cast(options.grid, between(0, split));
        const SurfaceGrid color = shared ? SurfaceGrid{} : surfaces.cast(color_grid, between(split, 1));

        Part part;
        part.center = frame.center;
        part.frame = frame.frame;
        part.radius = frame.radius;
        part.mapping = options.grid.mapping;
        part.center_inside = report.center_inside;
        pack_layers(shape, shared ? shape : color, options, part, result.map);
        if (part.mapping == Mapping::octahedral) {
            const std::uint32_t cells = options.grid.width - 1;
            std::vector<std::uint8_t> edges = match_edges(shape, face_normals(centered));
            if (options.folds && !options.one_depth() && cells <= most_fold_cells &&
                options.layers <= most_fold_layers) {
                const Folds folds = find_folds(centered, components, surfaces.orientation(), shape, edges);
                report.folds = folds.statistics;
                pack_folds(folds.records, part, result.map);
            }
            pack_mixed(mixed_triangles(cells, edges), part, result.map);
            report.mixed_triangles = mixed_share(part.mixed);
        }
        for (std::size_t k = 0; k < part.layers.size(); ++k) {
            report.layers.push_back(
                {coverage(shape.surfaces[2 * k], shape.grid),
                 part.layers[k].inner.empty() ? 0 : coverage(shape.surfaces[2 * k + 1], shape.grid)});
        }
        result.map.map.parts.push_back(std::move(part));
    });
    add_warnings(report, options);
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

} // namespace spa::bake
