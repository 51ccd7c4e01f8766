// SPDX-License-Identifier: Apache-2.0
#include "ray_judge.h"

#include "../bake/center.h"
#include "../measure/ray_sets.h"
#include "../measure/ray_truth.h"
#include "../measure/source_radius.h"
#include "../trace/scene.h"
#include "../trace/trace_map.h"
#include "../trace/triangle_scene.h"

#include <array>
#include <cmath>
#include <span>

namespace spa::plan {
namespace {

using measure::RaySet;

// Not that of measure_rays.
constexpr std::uint64_t seed = 20261126;
constexpr std::uint32_t first_rays = 3'000; // of the first stage; each stage takes four times as many

std::vector<trace::Ray> rays_in_turn(std::uint32_t count, const bake::CenteredModel& model) {
    constexpr std::array sets{RaySet::bounce, RaySet::chords, RaySet::leaving};
    const auto share = std::uint32_t(count / sets.size());
    std::vector<trace::Ray> rays(std::size_t(share) * sets.size());
    for (std::size_t s = 0; s < sets.size(); ++s) {
        const auto some =
            measure::make_rays(sets[s], share, seed + s, model.positions, model.model->triangles);
        for (std::size_t i = 0; i < some.size(); ++i) rays[i * sets.size() + s] = some[i];
    }
    return rays;
}

Affine scaled_about(Vec3d center, double scale) {
    return {{{{scale, 0, 0}, {0, scale, 0}, {0, 0, scale}}}, center * -scale};
}

// Of the rays judged so far.
class Answers {
public:
    Answers(Metric metric, double scale) : metric_(metric), scale_(scale) {}

    void add(const trace::Ray& ray, float truth, const trace::Hit& hit) {
        ++rays_;
        const bool expected = std::isfinite(truth);
        if (hit.valid() && !expected) ++extra_;
        if (!hit.valid() && expected) ++missed_;
        if (!hit.valid() || !expected) return;
        distances_.push_back(std::abs(double(hit.t) - double(truth)) * length(to_double(ray.direction)) *
                             scale_);
    }

    [[nodiscard]] Estimate estimate() const {
        Estimate estimate = metric_ == Metric::false_hits    ? estimate_share(extra_, rays_)
                            : metric_ == Metric::missed_hits ? estimate_share(missed_, rays_)
                            : metric_ == Metric::mean_dt     ? estimate_mean(distances_)
                                                             : estimate_quantile(distances_, share());
        estimate.samples = rays_;
        return estimate;
    }

private:
    [[nodiscard]] double share() const { return metric_ == Metric::p99_dt ? 0.99 : 0.95; }

    Metric metric_;
    double scale_;
    std::uint64_t rays_ = 0, extra_ = 0, missed_ = 0;
    std::vector<double> distances_;
};

} // namespace

RayJudge::RayJudge(const Model& model, Vec3d center, const RayJudgeOptions& options)
    : metric_(options.metric) {
    const double radius = measure::radius_about(model, center, Mat3{});
    to_unit_sphere_ = scaled_about(center, 1 / radius);
    scale_ = options.unit > 0 ? radius / options.unit : 1;
    const bake::CenteredModel centered = bake::center_model(model, {center, Mat3{}, radius});
    const trace::TriangleScene triangles(centered.positions, model.triangles);
    rays_ = rays_in_turn(options.rays, centered);
    truth_.reserve(rays_.size());
    for (const measure::RayAnswer& answer : measure::RayTruth(centered, triangles).trace(rays_))
        truth_.push_back(answer.t);
}

Estimate RayJudge::judge(const Part& part, double target) const {
    const trace::TraceMap map(part, {.layers = 0, .images = false});
    trace::Scene scene;
    scene.add(map, part, to_unit_sphere_);
    Answers answers(metric_, scale_);
    std::vector<trace::Hit> hits;
    std::size_t begin = 0;
    for (std::size_t end = first_rays; begin < rays_.size(); end *= 4) {
        const auto rays = std::span(rays_).subspan(begin, std::min(end, rays_.size()) - begin);
        hits.assign(rays.size(), {});
        scene.closest_hits(rays, trace::no_flags, hits);
        for (std::size_t i = 0; i < rays.size(); ++i) answers.add(rays[i], truth_[begin + i], hits[i]);
        begin += rays.size();
        const Estimate estimate = answers.estimate();
        if (estimate.low > target || estimate.high <= target) return estimate;
    }
    return answers.estimate();
}

} // namespace spa::plan
