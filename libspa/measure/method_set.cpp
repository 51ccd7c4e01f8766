// SPDX-License-Identifier: Apache-2.0
#include "method_set.h"

#include "lods.h"
#include "outermost_surface.h"
#include "stopwatch.h"

#include <algorithm>
#include <cmath>

namespace spa::measure {
namespace {

class Maker {
public:
    Maker(const Model& model, const bake::CenteredModel& centered, const TraceBenchOptions& options,
          const Step& step)
        : model_(model), centered_(centered), options_(options), step_(step) {}

    MethodSet make() {
        if (wants(Family::fan) || wants(Family::march)) make_paper_methods();
        if (wants(Family::projective) || wants(Family::surface)) make_maps();
        step_(0.5, "building Embree's hierarchies");
        if (wants(Family::mesh)) make_mesh();
        if (wants(Family::lod)) make_lods();
        return std::move(result_);
    }

private:
    [[nodiscard]] bool wants(Family family) const {
        return std::find(options_.families.begin(), options_.families.end(), family) !=
               options_.families.end();
    }

    void add(std::unique_ptr<TraceMethod> method, const std::string& name, MethodReport report) {
        method->name = name;
        report.name = name;
        report.family = method->family;
        report.cells = method->cells;
        report.layers = method->layers;
        report.triangles = method->triangles;
        report.target_error = method->target_error;
        report.bytes = method->bytes;
        result_.methods.push_back(std::move(method));
        result_.reports.push_back(std::move(report));
    }

    [[nodiscard]] static bake::Options bake_options(const Grid& grid, std::uint32_t layers,
                                                    ElementFormat depth) {
        bake::Options bake;
        bake.grid = bake.color_grid = grid;
        bake.layers = layers;
        bake.depth = depth;
        return bake;
    }
    std::optional<FileTrip> through_file(const SphericalMap& map) const {
        if (!options_.through_file) return {};
        const auto rays = make_rays(RaySet::chords, 1, bench_seed, {}, {});
        return options_.through_file(map, rays.front(), options_.runs);
    }

    // The paper's map: latlong, 640 x 480, a byte a depth.
    void make_paper_methods() {
        bake::Options paper = bake_options({Mapping::latlong, 640, 480}, 1, ElementFormat::u8);
        paper.normals = ElementFormat::rgb8;
        const bake::OwnedMap map = bake::bake_model(model_, paper).map;
        const Part& part = map.map.parts.front();
        MethodReport report;
        report.file = through_file(map.map);
        if (wants(Family::fan)) {
            for (const std::uint32_t tests : options_.tests)
                add(map_method(Family::fan, part, 1, tests),
                    "fan " + (tests == 0 ? "N(d2)" : std::to_string(tests)), report);
        }
        if (!wants(Family::march)) return;
        const bake::OwnedMap fine =
            bake::bake_model(model_, bake_options(paper.grid, 1, ElementFormat::u16)).map;
        report.file = through_file(fine.map);
        add(map_method(Family::march, fine.map.parts.front(), 1, 0), "march", report);
    }

    void make_maps() {
        std::size_t done = 0;
        const std::size_t all = options_.cells.size() * options_.layers.size();
        for (const std::uint32_t cells : options_.cells) {
            for (const std::uint32_t layers : options_.layers) {
                step_(0.5 * double(done++) / double(all), "baking");
                const bake::OwnedMap map = bake_octahedral(model_, cells, layers, ElementFormat::u16);
                const Part& part = map.map.parts.front();
                if (wants(Family::projective)) {
                    MethodReport report;
                    report.file = through_file(map.map);
                    add(map_method(Family::projective, part, layers, 0),
                        "projective " + std::to_string(cells) + "x" + std::to_string(layers),
                        std::move(report));
                }
                if (wants(Family::surface) && layers == options_.layers.front()) make_surface(part, cells);
            }
        }
    }

    static std::unique_ptr<TraceMethod> on_one_thread(Family family, std::span<const Vec3f> positions,
                                                      std::span<const Vec3f> normals,
                                                      std::span<const Triangle> triangles,
                                                      MethodReport& report) {
        double seconds = 0;
        auto method = triangle_method(family, positions, normals, triangles, true, seconds);
        report.build_seconds = seconds;
        return method;
    }

    void make_surface(const Part& part, std::uint32_t cells) {
        const MapSurface surface = outermost_surface(part);
        MethodReport report;
        auto method = on_one_thread(Family::surface, surface.positions, {}, surface.triangles, report);
        method->cells = cells;
        add(std::move(method), "surface " + std::to_string(cells), std::move(report));
    }

    void make_mesh() {
        MethodReport report;
        double seconds = 0;
        (void)triangle_method(Family::mesh, centered_.positions, {}, model_.triangles, false, seconds);
        report.build_seconds_cores = seconds;
        auto method =
            on_one_thread(Family::mesh, centered_.positions, centered_.normals, model_.triangles, report);
        add(std::move(method), "mesh", std::move(report));
    }

    void make_lods() {
        const std::vector<double> errors =
            options_.lod_errors.empty() ? default_lod_errors() : options_.lod_errors;
        step_(0.7, "simplifying");
        std::vector<Lod> lods;
        result_.simplify_seconds = seconds_of(
            [&] { lods = simplify(centered_.positions, centered_.normals, model_.triangles, errors); });
        std::size_t last = 0; // triangles of the step before
        for (const Lod& lod : lods) {
            // Steps that are all alike, or as large as the model, say nothing new.
            if (lod.triangles.empty() || lod.triangles.size() == last) continue;
            last = lod.triangles.size();
            MethodReport report;
            auto method = on_one_thread(Family::lod, lod.positions, lod.normals, lod.triangles, report);
            method->target_error = lod.target_error;
            add(std::move(method), "lod " + std::to_string(lod.triangles.size()), std::move(report));
        }
    }

    const Model& model_;
    const bake::CenteredModel& centered_;
    const TraceBenchOptions& options_;
    const Step& step_;
    MethodSet result_;
};

} // namespace

std::vector<double> default_lod_errors() {
    std::vector<double> errors;
    for (int i = 0; i <= 9; ++i) errors.push_back(0.05 * std::pow(10, -i / 3.0));
    return errors;
}

MethodSet make_methods(const Model& model, const bake::CenteredModel& centered,
                       const TraceBenchOptions& options, const Step& step) {
    return Maker(model, centered, options, step).make();
}

} // namespace spa::measure
