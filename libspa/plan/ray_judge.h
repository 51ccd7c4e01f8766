// SPDX-License-Identifier: Apache-2.0
// Judges maps by rays: those of ../measure/map_rays.h, but others, so that measuring the map that was chosen
// is a second opinion.
#pragma once

#include "judge.h"
#include "metric.h"

#include "../mesh/model.h"
#include "../trace/ray.h"

#include <cstdint>
#include <vector>

namespace spa::plan {

struct RayJudgeOptions {
    Metric metric = Metric::p95_dt; // one of rays
    std::uint32_t rays = 60'000;
    double unit = 0; // distances are in this many units of object space; 0: the radius of the bounding sphere
};

class RayJudge : public Judge {
public:
    // center: of the parts that it will judge, in object space. Traces all rays through the model, once.
    // O(triangles log(triangles) + rays log(triangles)); parallel in the caller's arena. Throws
    // Error{invalid_data} for a model of zero size. The model need not outlive it.
    RayJudge(const Model& model, Vec3d center, const RayJudgeOptions& options);

    // part: octahedral, with or without colours. O(samples of the part + rays).
    [[nodiscard]] Estimate judge(const Part& part, double target) const override;

private:
    Metric metric_;
    Affine to_unit_sphere_;
    double scale_ = 1;             // of distances
    std::vector<trace::Ray> rays_; // of each set in turn, so that the first are of all
    std::vector<float> truth_;     // where each meets the model; infinity: nowhere
};

} // namespace spa::plan
