// SPDX-License-Identifier: Apache-2.0
#include "trials.h"

#include "../bake/coarse_model.h"
#include "../bake/surface_views.h"

#include <algorithm>
#include <cmath>

namespace spa::plan {
namespace {

std::vector<SizedValue> values_of(const std::vector<Trial>& trials, double (*value)(const Trial&)) {
    std::vector<SizedValue> values;
    values.reserve(trials.size());
    for (const Trial& trial : trials) values.push_back({trial.size, value(trial)});
    return values;
}

const Trial* tried(const std::vector<Trial>& trials, std::uint32_t size) {
    const auto found =
        std::find_if(trials.begin(), trials.end(), [&](const Trial& trial) { return trial.size == size; });
    return found == trials.end() ? nullptr : &*found;
}

bool is_star(const bake::Report& report) {
    constexpr double all = 0.9999; // of the sphere's directions
    return report.center_inside && report.layers.size() == 1 && report.layers.front().outer_coverage > all &&
           report.layers.front().inner_coverage < 1 - all;
}

} // namespace

std::vector<ObjectGroup> group_objects(const std::vector<SceneObject>& objects) {
    std::vector<ObjectGroup> groups;
    std::vector<std::size_t> group_of(objects.size());
    for (std::uint32_t i = 0; i < objects.size(); ++i) {
        if (objects[i].same_as == no_index) {
            group_of[i] = groups.size();
            groups.emplace_back();
        } else {
            group_of[i] = group_of[objects[i].same_as];
        }
        groups[group_of[i]].objects.push_back(i);
    }
    return groups;
}

std::uint64_t TrialSeries::bytes(std::uint32_t size) const {
    if (const Trial* trial = tried(trials, size)) return trial->bytes;
    return BytesLaw::fit(values_of(trials, [](const Trial& t) { return double(t.bytes); })).at(size);
}

double TrialSeries::image_error(std::uint32_t size) const {
    const ErrorLaw law = ErrorLaw::fit(values_of(trials, [](const Trial& t) { return t.image_error; }));
    const Trial* trial = tried(trials, size);
    return trial == nullptr ? law.at(size) : std::max(trial->image_error, law.at(size));
}

double TrialSeries::deviation(std::uint32_t size) const {
    const Trial* trial = tried(trials, size);
    if (trial == nullptr) trial = &trials.back();
    return trial->image_error > 0 ? trial->deviation / trial->image_error * image_error(size) : 0;
}

const Trial& TrialSeries::nearest(std::uint32_t size) const {
    const auto found =
        std::find_if(trials.begin(), trials.end(), [&](const Trial& trial) { return trial.size >= size; });
    return found == trials.end() ? trials.back() : *found;
}

double TrialSeries::distance(std::uint32_t size) const {
    if (const Trial* trial = tried(trials, size)) return trial->distance;
    return ErrorLaw::fit(values_of(trials, [](const Trial& t) { return t.distance; })).at(size);
}

void Trials::add(const ObjectGroup& group, const Model& model, std::uint32_t size, TrialSeries& series,
                 Shape* shape) {
    if (tried(series.trials, size) != nullptr) return;
    MapSettings settings = series.settings;
    settings.size = settings.color_size = size;
    bake::Options options = settings.options();
    options.threads = threads_;
    const TrialMap map = make_trial_map(model, options);
    ++maps_;
    Trial trial;
    trial.size = size;
    trial.bytes = map.bytes();
    double variance = 0;
    for (const std::uint32_t object : group.objects) {
        const StandIn stand_in(unit_, map, scene_.nodes[objects_[object].node].to_world);
        const Change change = paths_.change(object, &stand_in);
        trial.of_object.push_back(change.image_error);
        trial.pixels.insert(trial.pixels.end(), change.pixels.begin(), change.pixels.end());
        trial.image_error += change.image_error;
        variance += change.deviation * change.deviation;
        trial.distance = std::max(trial.distance, change.distance.p95);
    }
    trial.deviation = std::sqrt(variance);
    if (shape != nullptr) {
        shape->captured = std::min(
            1.0, bake::SurfaceViews(bake::coarse_model(model), 1).from({map.part().center, {}}).captured);
        shape->star_shaped = is_star(map.baked.report);
    }
    const auto after = std::find_if(series.trials.begin(), series.trials.end(),
                                    [&](const Trial& other) { return other.size > size; });
    series.trials.insert(after, std::move(trial));
}

} // namespace spa::plan
