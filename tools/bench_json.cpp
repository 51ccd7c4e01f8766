// SPDX-License-Identifier: Apache-2.0
#include "bench_json.h"

#include <nlohmann/json.hpp>

namespace spa::tools {

using Json = nlohmann::ordered_json;

Json spread_json(const measure::Spread& spread) {
    return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}, {"runs", spread.runs}};
}

Json confusion_json(const measure::Confusion& c) {
    return {{"both", c.both}, {"neither", c.neither}, {"missed", c.missed}, {"extra", c.extra}};
}

Json full_distribution_json(const measure::Distribution& d) {
    return {{"count", d.count}, {"mean", d.mean}, {"rms", d.rms}, {"median", d.median},
            {"p95", d.p95},     {"p99", d.p99},   {"max", d.max}};
}

} // namespace spa::tools
