// SPDX-License-Identifier: Apache-2.0
#include "paper_tables.h"

#include "../libspa/bake/crossings.h"
#include "../libspa/measure/image_errors.h"
#include "../libspa/measure/lod_peer.h"
#include "../libspa/measure/stopwatch.h"

#include <algorithm>
#include <map>

namespace spa::tools {
namespace {

constexpr std::uint32_t reference_seed = 2; // another than the frames', so that their noise is not its own
constexpr std::uint32_t first_frame_samples = 8;
constexpr std::uint32_t lod_samples = 32;

double rel_mse(const render::Frame& frame, const render::Frame& reference) {
    return measure::image_errors({frame.width, frame.height, frame.indirect},
                                 {reference.width, reference.height, reference.indirect})
        .rel_mse;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

class Tables {
public:
    Tables(const render::Gpu& gpu, const PaperTableOptions& options) : gpu_(gpu), options_(options) {
        steps_ = options.levels.size() * (paper_methods().size() + 3);
    }

    PaperTables run() {
        result_.width = options_.width;
        result_.height = options_.height;
        for (const int level : options_.levels) run_level(level);
        return std::move(result_);
    }

private:
    void step(int level, const std::string& what) {
        const std::string text = "boot level " + std::to_string(level) + ", " + what;
        if (options_.progress && !options_.progress(double(step_++) / double(steps_), text))
            throw bake::Cancelled();
    }

    render::Settings settings(const PaperMethod& method, const PaperScene& scene) const {
        render::Settings settings = settings_of(method, scene.camera, options_.width, options_.height);
        settings.backend = options_.backend;
        return settings;
    }

    void run_level(int level) {
        const PaperScene scene = options_.scene(level);
        PaperCosts& costs = result_.costs.emplace_back();
        costs.level = level;
        const Model object = object_model(scene);
        costs.vertices = object.positions.size();
        costs.triangles = object.triangles.size();

        step(level, "reference");
        const render::Frame* reference = nullptr;
        std::map<std::uint32_t, render::Frame> by_triangles;
        {
            const auto device_scene = on_device(gpu_, scene.scene, scene.object, nullptr, true);
            const PaperMethod& triangles = paper_method(triangles_name);
            reference = reference_of(level, scene, *device_scene);
            step(level, triangles.name);
            by_triangles = run_method(level, scene, *device_scene, triangles, nullptr, reference);
        }
        for (const MapKind kind : {MapKind::paper, MapKind::one_layer, MapKind::two_layers}) {
            const bake::OwnedMap map = bake_for(object, kind);
            const auto device_scene = on_device(gpu_, scene.scene, scene.object, &map.map, true);
            if (kind == MapKind::one_layer) {
                const render::SceneMemory& memory = device_scene->memory();
                costs.triangle_bytes = memory.replaced_triangles;
                costs.triangle_structure_bytes = memory.replaced_structures;
                costs.map_bytes = memory.maps;
                costs.map_structure_bytes = memory.map_structures;
                costs.triangle_build_seconds = device_scene->times().replaced_build;
                costs.map_load_seconds = device_scene->times().map_load;
            }
            for (const PaperMethod& method : paper_methods()) {
                if (method.map != kind) continue;
                step(level, method.name);
                run_method(level, scene, *device_scene, method, &by_triangles, reference);
            }
            if (kind == MapKind::one_layer) {
                step(level, "from the file to the first frame");
                first_frames(scene, object, map.map, costs);
                step(level, "simplified meshes of equal error");
                run_lods(scene, object, map.map, costs);
            }
        }
    }

    const render::Frame* reference_of(int level, const PaperScene& scene,
                                      const render::DeviceScene& device_scene) {
        const int of_level = std::min(level, options_.reference_level);
        const auto known = references_.find(of_level);
        if (known != references_.end()) return &known->second;
        render::Settings settings = this->settings(paper_method(triangles_name), scene);
        settings.samples = options_.reference_samples;
        settings.seed = reference_seed;
        return &references_.emplace(of_level, render::render(gpu_, device_scene, settings)).first->second;
    }

    // Frames with each number of samples. equal_seeds: those of triangles; null: these are.
    std::map<std::uint32_t, render::Frame>
    run_method(int level, const PaperScene& scene, const render::DeviceScene& device_scene,
               const PaperMethod& method, const std::map<std::uint32_t, render::Frame>* equal_seeds,
               const render::Frame* reference) {
        const render::Settings settings = this->settings(method, scene);
        std::vector<std::vector<render::FrameTimes>> times(options_.runs);
        std::vector<render::Frame> frames;
        for (std::vector<render::FrameTimes>& run : times)
            frames = render::render_series(gpu_, device_scene, settings, options_.samples, &run);
        std::map<std::uint32_t, render::Frame> by_samples;
        for (std::size_t i = 0; i < frames.size(); ++i) {
            PaperCell& cell = result_.cells.emplace_back();
            cell.level = level;
            cell.method = method.name;
            cell.samples = options_.samples[i];
            std::vector<double> all, secondary;
            for (const std::vector<render::FrameTimes>& run : times) {
                all.push_back(run[i].primary + run[i].secondary);
                secondary.push_back(run[i].secondary);
            }
            cell.seconds = median(all);
            cell.secondary_seconds = median(secondary);
            cell.secondary_rays = times.front()[i].secondary_rays;
            const render::Frame& frame = by_samples.emplace(cell.samples, std::move(frames[i])).first->second;
            cell.relmse = rel_mse(frame, *reference);
            if (equal_seeds != nullptr)
                cell.relmse_equal_seeds = rel_mse(frame, equal_seeds->at(cell.samples));
        }
        return by_samples;
    }

    // Each from a file, without what only the other needs.
    void first_frames(const PaperScene& scene, const Model& object, const SphericalMap& map,
                      PaperCosts& costs) const {
        const PaperTableOptions::Files files = options_.files(object, map);
        costs.glb_bytes = files.glb_bytes;
        costs.spa_bytes = files.spa_bytes;
        costs.triangle_first_frame =
            files.read_glb + measure::seconds_of([&] {
                const auto device_scene = on_device(gpu_, scene.scene, scene.object, nullptr, true);
                render::Settings settings = this->settings(paper_method(triangles_name), scene);
                settings.samples = first_frame_samples;
                static_cast<void>(render::render(gpu_, *device_scene, settings));
            });
        const Scene rest = without_object(scene);
        costs.map_first_frame =
            files.read_spa + measure::seconds_of([&] {
                const auto device_scene = on_device(gpu_, rest, scene.object, &map, false);
                render::Settings settings = this->settings(paper_method("projective"), scene);
                settings.primary = render::Geometry::maps;
                settings.samples = first_frame_samples;
                static_cast<void>(render::render(gpu_, *device_scene, settings));
            });
    }

    // How fast secondary rays are on simplified meshes that are as exact as the map.
    void run_lods(const PaperScene& scene, const Model& object, const SphericalMap& map,
                  PaperCosts& costs) const {
        const measure::LodPeer peer = measure::lod_peer(object, map.parts.front());
        costs.map_mean = peer.map_mean;
        costs.map_median = peer.map_median;
        if (peer.by_mean) costs.lod_by_mean = rates_of(scene, *peer.by_mean);
        if (peer.by_median) costs.lod_by_median = rates_of(scene, *peer.by_median);
    }

    PaperCosts::LodRates rates_of(const PaperScene& scene, const measure::MeasuredLod& measured) const {
        const measure::Lod& lod = measured.lod;
        const Scene with_lod = with_object(scene, lod.positions, lod.normals, lod.triangles);
        const auto device_scene = on_device(gpu_, with_lod, scene.object, nullptr, true);
        render::Settings settings = this->settings(paper_method(triangles_name), scene);
        settings.samples = lod_samples;
        render::FrameTimes times;
        static_cast<void>(render::render(gpu_, *device_scene, settings, &times));
        return {lod.triangles.size(), measured.mean, measured.median,
                double(times.secondary_rays) / times.secondary};
    }

    const render::Gpu& gpu_;
    const PaperTableOptions& options_;
    PaperTables result_;
    std::map<int, render::Frame> references_;
    std::size_t step_ = 0, steps_ = 1;
};

} // namespace

const PaperCell* PaperTables::find(int level, const std::string& method, std::uint32_t samples) const {
    for (const PaperCell& cell : cells)
        if (cell.level == level && cell.method == method && cell.samples == samples) return &cell;
    return nullptr;
}

PaperTables run_paper_tables(const render::Gpu& gpu, const PaperTableOptions& options) {
    return Tables(gpu, options).run();
}

} // namespace spa::tools
