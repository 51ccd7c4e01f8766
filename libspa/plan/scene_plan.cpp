// SPDX-License-Identifier: Apache-2.0
#include "scene_plan.h"

#include "allocate.h"
#include "reasons.h"
#include "trials.h"

#include "../bake/arena.h"
#include "../bake/crossings.h"
#include "../core/error.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

namespace spa::plan {
namespace {

constexpr std::uint32_t smallest_size = 8;
constexpr std::uint32_t first_trials[] = {16, 32};
constexpr std::uint32_t largest_trial = 128;
constexpr int most_rounds = 10;
// Rendered pictures were up to this many times as far off as predicted (docs/planning.md, "How far it held").
constexpr double rendered_error = 2;
// Of a footprint: what a tolerance is.
constexpr double tolerated_share = 0.1;

// Half angle that one of n diffuse rays stands for.
double footprint(std::uint32_t samples) { return std::sqrt(2.0 / samples); }

// One thing that can be done with a group.
struct Option {
    Decision decision = Decision::triangles;
    std::size_t series = 0;
    std::uint32_t size = 0;
};

struct Group {
    ObjectGroup members;
    bool mappable = false;
    Trials::Shape shape;
    std::vector<TrialSeries> series; // the first with the settings that spa bake has of itself
    std::vector<Change> without;     // each object
    std::vector<bool> droppable;     // each object
    std::uint64_t bytes_triangles = 0;
    std::vector<Option> options; // of the menu
    Option chosen;
};

double wall() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

class Planner {
public:
    Planner(const Scene& scene, std::span<const Camera> cameras, const PlanOptions& options,
            const Progress& progress)
        : scene_(scene), options_(options), progress_(progress), objects_(find_objects(scene)),
          unit_(scene, objects_), paths_(unit_, objects_, cameras, options.paths), views_(paths_.views()),
          trials_(scene, objects_, unit_, paths_, options.threads) {
        const double alpha = tolerated_share * footprint(options.paths.samples);
        drop_below_ = options.drop_below.value_or(std::numbers::pi * alpha * alpha);
        for (std::uint32_t size = smallest_size; size <= options.largest_size; size *= 2)
            sizes_.push_back(size);
        if (options.target_image_error || options.budget_bytes) {
            limits_ = {options.target_image_error, options.budget_bytes};
        } else {
            limits_.error = default_error;
        }
        target_ = limits_.error;
    }

    ScenePlan run(double started) {
        const double traced = wall();
        step(0.2);
        std::vector<ObjectGroup> groups = group_objects(objects_);
        std::size_t done = 0;
        for (ObjectGroup& members : groups) {
            groups_.emplace_back().members = std::move(members);
            try_first(groups_.back());
            step(0.2 + 0.6 * double(++done) / double(groups.size()));
        }
        refine();
        ScenePlan plan = result();
        plan.trace_seconds = traced - started;
        plan.trial_seconds = wall() - traced;
        return plan;
    }

private:
    void step(double share) const {
        if (progress_ && !progress_(share)) throw bake::Cancelled{};
    }

    [[nodiscard]] const SceneObject& first(const Group& group) const {
        return objects_[group.members.objects.front()];
    }

    void try_first(Group& group) {
        for (const std::uint32_t object : group.members.objects) {
            group.bytes_triangles += triangle_bytes(scene_, objects_[object]);
            group.without.push_back(paths_.change(object, nullptr));
            group.droppable.push_back(views_[object].solid_angle_mean < drop_below_);
        }
        if (!first(group).invertible) return;
        const Model model = object_model(scene_, first(group));
        try {
            TrialSeries usual;
            for (const std::uint32_t size : first_trials)
                if (size <= options_.largest_size)
                    trials_.add(group.members, model, size, usual, &group.shape);
            group.series.push_back(std::move(usual));
        } catch (const Error& error) {
            // Nothing to bake, such as triangles without area.
            if (error.code() != ExitCode::invalid_data && error.code() != ExitCode::unsupported) throw;
            return;
        }
        group.mappable = true;
        constexpr double nearly_all = 0.97;
        if (group.shape.star_shaped || group.shape.captured >= nearly_all) {
            TrialSeries single;
            single.settings.layers = 1;
            const std::uint32_t size = group.series.front().largest();
            trials_.add(group.members, model, size, single);
            constexpr double as_good = 1.2;
            if (single.image_error(size) > as_good * group.series.front().image_error(size)) return;
            trials_.add(group.members, model, first_trials[0], single);
            group.series.push_back(std::move(single));
        }
    }

    // Objects of the group that are dropped whatever is done with the others: nobody misses them.
    [[nodiscard]] double error_without(const Group& group) const {
        double error = 0;
        for (const Change& change : group.without) error += change.image_error;
        return error;
    }

    Menu menu_of(Group& group) const {
        group.options.clear();
        Menu menu;
        const auto offer = [&](const Option& option, std::uint64_t bytes, double error) {
            group.options.push_back(option);
            menu.push_back({bytes, error});
        };
        if (std::all_of(group.droppable.begin(), group.droppable.end(), [](bool may) { return may; }))
            offer({Decision::drop}, 0, error_without(group));
        offer({Decision::triangles}, group.bytes_triangles, 0);
        for (std::size_t s = 0; s < group.series.size(); ++s)
            for (const std::uint32_t size : sizes_) {
                const TrialSeries& series = group.series[s];
                offer({Decision::map, s, size}, series.bytes(size), series.image_error(size));
                if (!limits_.error && finer_than_tolerated(group, series.distance(size))) break;
            }
        return menu;
    }

    [[nodiscard]] bool finer_than_tolerated(const Group& group, double distance) const {
        return std::all_of(group.members.objects.begin(), group.members.objects.end(),
                           [&](std::uint32_t object) {
                               const std::optional<double> most = tolerance(object);
                               return !most || distance <= *most;
                           });
    }

    [[nodiscard]] std::optional<double> tolerance(std::uint32_t object) const {
        if (views_[object].rays == 0 || !(objects_[object].radius > 0)) return std::nullopt;
        return tolerated_share * footprint(options_.paths.samples) * views_[object].distance_median /
               objects_[object].radius;
    }

    void choose() {
        std::vector<Menu> menus;
        for (Group& group : groups_) menus.push_back(menu_of(group));
        allocation_ = allocate(menus, limits_);
        for (std::size_t i = 0; i < groups_.size(); ++i)
            groups_[i].chosen = groups_[i].options[allocation_.chosen[i]];
    }

    // Sizes that were chosen by what others promise are tried, and it is chosen again.
    void refine() {
        for (int round = 0; round < most_rounds; ++round) {
            choose();
            bool all_tried = true;
            for (Group& group : groups_) {
                if (group.chosen.decision != Decision::map) continue;
                TrialSeries& series = group.series[group.chosen.series];
                const std::uint32_t size = std::min(group.chosen.size, largest_trial);
                if (size <= series.largest() && series.nearest(size).size == size) continue;
                all_tried = false;
                trials_.add(group.members, object_model(scene_, first(group)),
                            std::min(size, 2 * series.largest()), series);
                step(0.8);
            }
            together_ = errors_together();
            if (all_tried && !ask_for_less()) return;
        }
        choose();
        together_ = errors_together();
    }

    // What the chosen changes do at once, as a multiple of the sum of what they do alone: they lie on the
    // same pixels, and coarse maps err to the same side.
    [[nodiscard]] double errors_together() const {
        std::vector<Vec3f> sum(paths_.pixels());
        const auto add = [&sum](const std::vector<PixelChange>& pixels, double scale) {
            for (const PixelChange& change : pixels)
                sum[change.pixel] = sum[change.pixel] + change.radiance * float(scale);
        };
        for (const Group& group : groups_) {
            if (group.chosen.decision == Decision::drop)
                for (const Change& change : group.without) add(change.pixels, 1);
            if (group.chosen.decision != Decision::map) continue;
            const TrialSeries& series = group.series[group.chosen.series];
            const Trial& trial = series.nearest(group.chosen.size);
            if (!(trial.image_error > 0)) continue;
            add(trial.pixels, std::sqrt(series.image_error(group.chosen.size) / trial.image_error));
        }
        return allocation_.error > 0
                   ? rendered_error * std::max(1.0, paths_.image_error(sum) / allocation_.error)
                   : 1;
    }

    // Whether all errors together miss the target, and the sum has to become smaller.
    bool ask_for_less() {
        if (!target_ || allocation_.error * together_ <= *target_) return false;
        limits_.error = std::min(*target_ / together_, 0.9 * *limits_.error);
        return true;
    }

    [[nodiscard]] ScenePlan result() const {
        ScenePlan plan;
        plan.objects.resize(objects_.size());
        for (const Group& group : groups_) {
            for (std::size_t i = 0; i < group.members.objects.size(); ++i)
                plan.objects[group.members.objects[i]] = object_plan(group, i);
        }
        double variance = 0;
        for (const Group& group : groups_) {
            plan.bytes_triangles += group.bytes_triangles;
            if (group.chosen.decision == Decision::map) {
                const double deviation = group.series[group.chosen.series].deviation(group.chosen.size);
                variance += deviation * deviation;
            }
        }
        plan.bytes = allocation_.bytes;
        plan.image_error = allocation_.error * together_;
        plan.errors_together = together_;
        plan.image_error_deviation = std::sqrt(variance) * together_;
        plan.meets_error = !target_ || plan.image_error <= *target_;
        plan.meets_budget = allocation_.meets_bytes;
        compare_one_size(plan);
        plan.pixels = paths_.pixels();
        plan.secondary_rays = paths_.secondary_rays();
        plan.trial_maps = trials_.maps();
        return plan;
    }

    struct OneSize {
        std::uint32_t size = 0;
        std::uint64_t bytes = 0;
        double image_error = 0;
    };

    // The first size at which maps of all that is not dropped, or of what is a map in the plan, are as exact
    // as the plan; or the largest.
    [[nodiscard]] OneSize one_size(bool of_maps, double image_error) const {
        OneSize one;
        for (const std::uint32_t size : sizes_) {
            one = {size, 0, 0};
            for (const Group& group : groups_) {
                if (group.chosen.decision == Decision::drop) {
                    one.image_error += error_without(group);
                } else if (!group.mappable || (of_maps && group.chosen.decision != Decision::map)) {
                    one.bytes += group.bytes_triangles;
                } else {
                    one.bytes += group.series.front().bytes(size);
                    one.image_error += group.series.front().image_error(size);
                }
            }
            if (one.image_error * together_ <= image_error) break;
        }
        one.image_error *= together_;
        return one;
    }

    void compare_one_size(ScenePlan& plan) const {
        const OneSize all = one_size(false, plan.image_error), maps = one_size(true, plan.image_error);
        plan.one_size = all.size;
        plan.bytes_one_size = all.bytes;
        plan.image_error_one_size = all.image_error;
        plan.one_size_of_maps = maps.size;
        plan.bytes_one_size_of_maps = maps.bytes;
        plan.image_error_one_size_of_maps = maps.image_error;
    }

    [[nodiscard]] ObjectPlan object_plan(const Group& group, std::size_t member) const {
        const std::uint32_t index = group.members.objects[member];
        const SceneObject& object = objects_[index];
        ObjectPlan plan;
        plan.node = object.node;
        plan.name = scene_.nodes[object.node].name;
        if (member > 0) plan.same_as = first(group).node;
        plan.triangles = object.triangles.size();
        plan.bytes_triangles = triangle_bytes(scene_, object);
        plan.radius = object.radius;
        plan.captured = group.shape.captured;
        plan.star_shaped = group.shape.star_shaped;
        plan.views = views_[index];
        plan.tolerance = tolerance(index);
        plan.decision = group.chosen.decision;
        Reasons reasons{plan, group.mappable, group.members.objects.size(), drop_below_};
        reasons.without = group.without[member].image_error;
        reasons.largest_size = options_.largest_size;
        if (group.mappable) {
            const std::size_t s = plan.decision == Decision::map ? group.chosen.series : 0;
            const TrialSeries& series = group.series[s];
            for (const std::uint32_t size : sizes_)
                reasons.sizes.push_back({size, series.bytes(size), series.image_error(size)});
            if (plan.decision == Decision::map) fill_map(series, group.chosen.size, member, plan);
        }
        if (plan.decision == Decision::drop) plan.expected = Expected{0, 0, 0, reasons.without};
        plan.why = why(reasons);
        return plan;
    }

    static void fill_map(const TrialSeries& series, std::uint32_t size, std::size_t member,
                         ObjectPlan& plan) {
        plan.settings = series.settings;
        plan.settings->size = plan.settings->color_size = size;
        Expected expected;
        expected.bytes = member == 0 ? series.bytes(size) : 0;
        expected.nanoseconds = nanoseconds_of(size);
        expected.error = series.distance(size);
        // As the errors of the largest map that was tried are spread over the objects.
        const Trial& trial = series.trials.back();
        const double share = trial.image_error > 0 ? trial.of_object[member] / trial.image_error
                                                   : 1 / double(trial.of_object.size());
        expected.image_error = series.image_error(size) * share;
        plan.expected = expected;
    }

    // What docs/layers.md measured of maps of two layers with 64 to 512 cells, to 2 ns.
    static double nanoseconds_of(std::uint32_t size) { return 92 + 0.08 * std::max(0.0, double(size) - 128); }

    const Scene& scene_;
    const PlanOptions& options_;
    const Progress& progress_;
    std::vector<SceneObject> objects_;
    UnitScene unit_;
    LightPaths paths_;
    std::vector<ObjectViews> views_;
    Trials trials_;
    double drop_below_ = 0;
    std::vector<std::uint32_t> sizes_;
    std::optional<double> target_;
    Limits limits_; // of the sum of errors
    double together_ = 1;
    std::vector<Group> groups_;
    Allocation allocation_;
};

} // namespace

const char* name(Decision decision) {
    switch (decision) {
    case Decision::map: return "map";
    case Decision::triangles: return "triangles";
    case Decision::drop: break;
    }
    return "drop";
}

bake::Options MapSettings::options() const {
    bake::Options options;
    options.grid = {Mapping::octahedral, size + 1, size + 1};
    options.color_grid = {Mapping::octahedral, color_size + 1, color_size + 1};
    options.layers = layers;
    options.center = center;
    options.frame = frame;
    return options;
}

ScenePlan plan_scene(const Scene& scene, std::span<const Camera> cameras, const PlanOptions& options,
                     const Progress& progress) {
    if (scene.model.triangles.empty()) throw Error(ExitCode::invalid_data, "the scene has no triangles");
    const double started = wall();
    ScenePlan plan;
    tbb::task_arena arena(bake::arena_concurrency(options.threads));
    arena.execute([&] { plan = Planner(scene, cameras, options, progress).run(started); });
    plan.seconds = wall() - started;
    return plan;
}

} // namespace spa::plan
