// SPDX-License-Identifier: Apache-2.0
// Figures that several reports of `spa bench` hold, as JSON.
#pragma once

#include "../libspa/measure/bench_bake.h"
#include "../libspa/measure/ray_errors.h"

#include <nlohmann/json_fwd.hpp>

namespace spa::tools {

nlohmann::ordered_json spread_json(const measure::Spread& spread);
nlohmann::ordered_json confusion_json(const measure::Confusion& confusion);
nlohmann::ordered_json full_distribution_json(const measure::Distribution& distribution);

} // namespace spa::tools
