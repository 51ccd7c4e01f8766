// SPDX-License-Identifier: Apache-2.0
// The plots of `spa bench trace`: error against time and against bytes, both logarithmic.
#pragma once

#include "bench_trace_report.h"

#include <cstddef>
#include <string>
#include <vector>

namespace spa::tools {

struct Plot {
    std::string name;   // of the picture without ".png", such as "trace-boot-6"
    std::string script; // for gnuplot, with its data; writes the picture to standard output
};

// One a model that has chords and at least one method with an error: left nanoseconds, right bytes, upwards
// mean |dt|.
std::vector<Plot> trace_plots(const TraceReport& report);

} // namespace spa::tools
