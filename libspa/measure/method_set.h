// SPDX-License-Identifier: Apache-2.0
// Everything that bench_trace compares, made ready for one model.
#pragma once

#include "bench_trace.h"

#include "../bake/crossings.h"
#include "../mesh/model.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace spa::measure {

struct MethodSet {
    std::vector<std::unique_ptr<TraceMethod>> methods;
    std::vector<MethodReport> reports; // one a method: all that is known before rays are traced
    double simplify_seconds = 0;
};

// Called with the share done in [0,1] and what comes next; throws to cancel.
using Step = std::function<void(double share, const std::string& what)>;

constexpr std::uint64_t bench_seed = 20240501; // of rays

// centered: the model in the space of its maps. Both outlive the result. Bakes, simplifies and builds; throws
// as bake_model does.
MethodSet make_methods(const Model& model, const bake::CenteredModel& centered,
                       const TraceBenchOptions& options, const Step& step);

} // namespace spa::measure
