// SPDX-License-Identifier: Apache-2.0
// What small maps of an object do to the picture, and what larger ones would.
#pragma once

#include "error_law.h"
#include "light_paths.h"
#include "scene_plan.h"

#include <cstdint>
#include <span>
#include <vector>

namespace spa::plan {

// Objects that one map serves.
struct ObjectGroup {
    std::vector<std::uint32_t> objects; // the first one is whose node the map is baked from
};
std::vector<ObjectGroup> group_objects(const std::vector<SceneObject>& objects);

// One size that was tried, all objects of the group together.
struct Trial {
    std::uint32_t size = 0;
    std::uint64_t bytes = 0;
    double image_error = 0, deviation = 0;
    std::vector<double> of_object;   // image_error of each
    std::vector<PixelChange> pixels; // of all objects, one after the other
    double distance = 0;             // 95th percentile of |dt|, in the object's radius
};

// Of one group and one way to bake apart from the size.
struct TrialSeries {
    MapSettings settings;      // size is not looked at
    std::vector<Trial> trials; // sizes ascending

    [[nodiscard]] std::uint64_t bytes(std::uint32_t size) const;
    // Measured where that size was tried and not below what the law says, which a lucky sample may be.
    [[nodiscard]] double image_error(std::uint32_t size) const;
    [[nodiscard]] double deviation(std::uint32_t size) const;
    [[nodiscard]] double distance(std::uint32_t size) const;
    // The trial of that size, or the one next to it.
    [[nodiscard]] const Trial& nearest(std::uint32_t size) const;
    [[nodiscard]] std::uint32_t largest() const { return trials.empty() ? 0 : trials.back().size; }
};

class Trials {
public:
    // All outlive this object.
    Trials(const Scene& scene, const std::vector<SceneObject>& objects, const UnitScene& unit,
           const LightPaths& paths, unsigned threads)
        : scene_(scene), objects_(objects), unit_(unit), paths_(paths), threads_(threads) {}

    // What a bake says of the object's shape.
    struct Shape {
        double captured = 0;
        bool star_shaped = false;
    };

    // Bakes and measures; appends to series.trials unless that size has been tried. model: of the group's
    // first object. Throws as bake_model does.
    void add(const ObjectGroup& group, const Model& model, std::uint32_t size, TrialSeries& series,
             Shape* shape = nullptr);
    [[nodiscard]] std::uint64_t maps() const { return maps_; }

private:
    const Scene& scene_;
    const std::vector<SceneObject>& objects_;
    const UnitScene& unit_;
    const LightPaths& paths_;
    unsigned threads_;
    std::uint64_t maps_ = 0;
};

} // namespace spa::plan
