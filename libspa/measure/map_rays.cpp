// SPDX-License-Identifier: Apache-2.0
#include "map_rays.h"

#include "ray_sets.h"
#include "ray_truth.h"
#include "source_radius.h"
#include "star_map.h"

#include "../bake/arena.h"
#include "../bake/center.h"
#include "../core/error.h"
#include "../mesh/part_frame.h"
#include "../mesh/piece_model.h"
#include "../trace/scene.h"
#include "../trace/triangle_scene.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

namespace spa::measure {
namespace {

constexpr std::uint64_t seed = 20240502;

std::vector<trace::Ray> secondary_rays(std::uint32_t count, const bake::CenteredModel& model) {
    constexpr std::array sets{RaySet::bounce, RaySet::chords, RaySet::leaving};
    std::vector<trace::Ray> rays;
    for (std::uint32_t i = 0; i < sets.size(); ++i) {
        const auto share = std::uint32_t((count + i) / sets.size());
        const auto some = make_rays(sets[i], share, seed + i, model.positions, model.model->triangles);
        rays.insert(rays.end(), some.begin(), some.end());
    }
    return rays;
}

// Colours of a surface that a ray meets, whatever its coverage: the ray has hit it.
std::array<std::uint8_t, 4> color_of(const trace::Shade& shade) {
    if (!shade.has_color) return {};
    return {linear_to_srgb(shade.color.x), linear_to_srgb(shade.color.y), linear_to_srgb(shade.color.z),
            std::uint8_t(255)};
}

std::vector<RayAnswer> answers_of(const trace::Scene& scene, const std::vector<trace::Ray>& rays) {
    std::vector<trace::Hit> hits(rays.size());
    scene.closest_hits(rays, trace::no_flags, hits);
    std::vector<RayAnswer> answers(rays.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), 4096), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            if (!hits[i].valid()) continue;
            const trace::Shade shade = scene.shade(hits[i]);
            answers[i] = {hits[i].t, shade.normal, color_of(shade)};
        }
    });
    return answers;
}

// From object space to that of the rays.
Affine to_unit_sphere(Vec3d center, double radius) {
    const double scale = 1 / radius;
    return {{{{scale, 0, 0}, {0, scale, 0}, {0, 0, scale}}}, center * -scale};
}

// What the maps of all parts are traced from.
class PartScene {
public:
    void add(const Part& part, const trace::CompileOptions& options, const Affine& placed) {
        maps_.push_back(std::make_unique<trace::TraceMap>(part, options));
        scene_.add(*maps_.back(), part, placed);
    }
    [[nodiscard]] const trace::Scene& scene() const { return scene_; }

private:
    std::vector<std::unique_ptr<trace::TraceMap>> maps_;
    trace::Scene scene_;
};

class Measure {
public:
    Measure(const Model& model, const Partition* partition, std::span<const Part> parts, Vec3d center,
            const RayOptions& options, const bake::Progress& progress)
        : model_(model), partition_(partition), parts_(parts), center_(center), options_(options),
          progress_(progress) {}

    RayFigures run() {
        const double radius = radius_about(model_, center_, Mat3{});
        const bake::CenteredModel centered = bake::center_model(model_, {center_, Mat3{}, radius});
        const trace::TriangleScene triangles(centered.positions, model_.triangles);
        const RayTruth judge(centered, triangles);
        const std::vector<trace::Ray> rays = secondary_rays(options_.rays, centered);
        step(0.1);
        const std::vector<RayAnswer> truth = judge.trace(rays);
        step(0.2);
        RayFigures figures;
        for (const Part& part : parts_) figures.band_width = std::max(figures.band_width, two_texels(part));
        const auto band = judge.silhouette_band(rays, truth, float(figures.band_width));
        step(0.5);

        const Affine placed = to_unit_sphere(center_, radius);
        PartScene maps;
        for (const Part& part : parts_) maps.add(part, {}, placed);
        const std::vector<RayAnswer> answers = answers_of(maps.scene(), rays);
        figures.errors = compare_answers(rays, truth, answers, band);
        step(0.6);
        attribute(rays, truth, answers, placed, figures);
        return figures;
    }

private:
    void step(double share) const {
        if (progress_ && !progress_(share)) throw bake::Cancelled{};
    }

    // In units of the model's sphere: about the part's own centre, if it is the only one.
    [[nodiscard]] double two_texels(const Part& part) const {
        const double cells = double(part.layers.front().outer.depth.width) - 1;
        const double whole = partition_ == nullptr ? radius_about(model_, part.center, part.frame)
                                                   : radius_about(model_, center_, Mat3{});
        return 2 * (2 / cells) * part.radius / whole;
    }

    // Which of the false answers the star envelope gives too.
    void attribute(const std::vector<trace::Ray>& rays, const std::vector<RayAnswer>& truth,
                   const std::vector<RayAnswer>& answers, const Affine& placed, RayFigures& figures) const {
        std::vector<trace::Ray> wrong;
        std::vector<bool> extra;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (truth[i].hits() == answers[i].hits()) continue;
            wrong.push_back(rays[i]);
            extra.push_back(answers[i].hits());
        }
        if (wrong.empty()) return;
        std::vector<bake::OwnedMap> stars;
        PartScene maps;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            stars.push_back(star_of(i));
            maps.add(stars.back().map.parts.front(), {.layers = 0, .images = false}, placed);
        }
        std::vector<std::uint8_t> blocked(wrong.size());
        maps.scene().occluded(wrong, trace::no_flags, blocked);
        for (std::size_t i = 0; i < wrong.size(); ++i) {
            if (extra[i] && blocked[i] != 0) ++figures.star_extra;
            if (!extra[i] && blocked[i] == 0) ++figures.star_missed;
        }
    }

    [[nodiscard]] bake::OwnedMap star_of(std::size_t i) const {
        const Part& part = parts_[i];
        const auto of_model = [&](const Model& model) {
            const double radius = radius_about(model, part.center, part.frame);
            const double count = double(parts_.size());
            // As many samples in all as one part has.
            const auto cells = 2 * std::uint32_t(std::ceil(options_.star_cells / (2 * std::sqrt(count))));
            return star_map(model, part, radius, options_.layers, cells, options_.threads, [&](double share) {
                return !progress_ || progress_(0.6 + 0.4 * (double(i) + share) / count);
            });
        };
        return partition_ == nullptr ? of_model(model_)
                                     : of_model(piece_model(model_, (*partition_)[i].triangles));
    }

    const Model& model_;
    const Partition* partition_; // null: the model is the only piece
    std::span<const Part> parts_;
    Vec3d center_;
    const RayOptions& options_;
    const bake::Progress& progress_;
};

} // namespace

namespace {

RayFigures run(const Model& model, const Partition* partition, std::span<const Part> parts, Vec3d center,
               const RayOptions& options, const bake::Progress& progress) {
    for (const Part& part : parts)
        if (part.mapping != Mapping::octahedral)
            throw Error(ExitCode::unsupported,
                        std::string("rays are traced through octahedral maps; this one is ") +
                            name(part.mapping));
    RayFigures figures;
    tbb::task_arena arena(bake::arena_concurrency(options.threads));
    arena.execute([&] { figures = Measure(model, partition, parts, center, options, progress).run(); });
    return figures;
}

} // namespace

RayFigures measure_rays(const Model& model, const Part& part, const RayOptions& options,
                        const bake::Progress& progress) {
    return run(model, nullptr, {&part, 1}, part.center, options, progress);
}

RayFigures measure_rays(const Model& model, const Partition& partition, std::span<const Part> parts,
                        const RayOptions& options, const bake::Progress& progress) {
    if (parts.size() == 1) return measure_rays(model, parts.front(), options, progress);
    bool moved = false;
    return run(model, &partition, parts, bounds_center(model, moved), options, progress);
}

} // namespace spa::measure
