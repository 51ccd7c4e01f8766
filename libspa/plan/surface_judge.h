// SPDX-License-Identifier: Apache-2.0
// Judges maps by the distance of the model's surface to theirs (../measure/map_surface.h), for any mapping.
#pragma once

#include "judge.h"
#include "metric.h"

#include "../mesh/model.h"

#include <cstdint>
#include <vector>

namespace spa::plan {

struct SurfaceJudgeOptions {
    Metric metric = Metric::hausdorff; // one of surfaces
    std::uint32_t points = 40'000;     // of the model's surface
    double unit = 0; // distances are in this many units of frame space; 0: the radius of the part
};

// The way from the model to the map is sampled. The way back is not: stored points lie on the model but for
// their quantization.
class SurfaceJudge : public Judge {
public:
    // O(triangles + points).
    SurfaceJudge(const Model& model, const SurfaceJudgeOptions& options);

    // O(samples of the part log(samples) + points log(samples)).
    [[nodiscard]] Estimate judge(const Part& part, double target) const override;

private:
    SurfaceJudgeOptions options_;
    std::vector<Vec3d> points_; // object space, in random order
};

} // namespace spa::plan
