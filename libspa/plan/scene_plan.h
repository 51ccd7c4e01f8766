// SPDX-License-Identifier: Apache-2.0
// A plan for a whole scene: which objects are worth a map, of which size, which stay triangles, and which
// nobody would miss. What is decided how: ../../docs/planning.md.
#pragma once

#include "light_paths.h"
#include "scene_objects.h"

#include "../bake/bake_options.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace spa::plan {

struct PlanOptions {
    PathOptions paths;
    // As few bytes as this error of the indirect light allows (relMSE); without a budget default_error.
    std::optional<double> target_image_error;
    // No more bytes than these, and as little error as they allow.
    std::optional<std::uint64_t> budget_bytes;
    // sr; an object of which surfaces see less on average may be dropped. Absent: that of a tolerance, pi (k
    // alpha)^2.
    std::optional<double> drop_below;
    std::uint32_t largest_size = 512; // cells a side; a power of two, 8 to 4096
    unsigned threads = 0;             // 0 = all cores; the plan does not depend on it
};
constexpr double default_error = 1e-3;

enum class Decision : std::uint8_t { map, triangles, drop };
const char* name(Decision decision);

// What a map is baked with.
struct MapSettings {
    std::uint32_t size = 0, color_size = 0; // cells a side
    std::uint32_t layers = 2;
    bake::Center center = bake::Center::bounds;
    bake::Frame frame = bake::Frame::sphere;

    [[nodiscard]] bake::Options options() const;
};

struct Expected {
    std::uint64_t bytes = 0; // of memory while rendering; 0 where another object pays for the map
    double nanoseconds = 0;  // of a random chord on one core
    double error = 0;        // 95th percentile of |dt| of the rays of this scene, in the object's radius
    double image_error = 0;  // its share of that of the picture
};

struct ObjectPlan {
    std::uint32_t node = 0;
    std::string name;
    std::uint32_t same_as = no_index; // node of the object whose map it shares
    std::uint64_t triangles = 0, bytes_triangles = 0;
    double radius = 0;   // of its bounding sphere, in the world
    double captured = 0; // share of its surface that a single layer can hold
    bool star_shaped = false;
    ObjectViews views;
    std::optional<double> tolerance; // in its radius; none where no ray meets it
    Decision decision = Decision::triangles;
    std::optional<MapSettings> settings; // of a map
    std::optional<Expected> expected;    // of a map or of nothing in its place
    std::string why;                     // one sentence
};

struct ScenePlan {
    std::vector<ObjectPlan> objects;
    std::uint32_t one_size = 0; // at which all objects as maps are as exact, or the largest
    std::uint64_t bytes = 0, bytes_triangles = 0, bytes_one_size = 0;
    double image_error = 0, image_error_one_size = 0;
    double errors_together = 1;       // image_error as a multiple of the sum of the objects' shares
    double image_error_deviation = 0; // standard deviation of image_error as an estimate
    // The same if what stays triangles in the plan does so there too: what sizes of their own alone bring.
    std::uint32_t one_size_of_maps = 0;
    std::uint64_t bytes_one_size_of_maps = 0;
    double image_error_one_size_of_maps = 0;
    bool meets_error = true, meets_budget = true;
    // How it came about; not for files.
    std::uint64_t pixels = 0, secondary_rays = 0, trial_maps = 0;
    double trace_seconds = 0, trial_seconds = 0, seconds = 0; // trial: bakes and what they change
};

// share: of the work; returning false cancels.
using Progress = std::function<bool(double share)>;

// scene: with lights. cameras: at least one. Same arguments, same plan (but for seconds). Time: that of
// options.paths.most_rays rays with all their hits, and of two to four bakes of 16 to 128 cells for each
// object that matters. Throws Error{invalid_data} for a scene of zero size, and bake::Cancelled.
ScenePlan plan_scene(const Scene& scene, std::span<const Camera> cameras, const PlanOptions& options,
                     const Progress& progress = {});

} // namespace spa::plan
