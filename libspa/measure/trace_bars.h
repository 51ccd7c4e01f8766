// SPDX-License-Identifier: Apache-2.0
// What the projective tracer is held to, against its rivals in the same run: ../../docs/speed.md, "Tracing".
#pragma once

#include "bench_trace.h"

#include <optional>
#include <string>
#include <vector>

namespace spa::measure {

// A simplified mesh that would have a given mean |dt|, between two steps that were measured: logarithms of
// nanoseconds and bytes are linear in the logarithm of the mean |dt|.
struct EqualLod {
    double ns = 0; // of the faster call
    double bytes = 0;
    double missed = 0; // rays in the silhouette band that miss, of all rays
}; // Of chords, with one number of threads. Where the coarsest step is more exact already, that step; where
   // even the finest is less exact,
// the model itself. None if there are no steps, or the model was not traced.
std::optional<EqualLod> equal_lod(const TraceBenchmark& benchmark, double mean_distance, unsigned threads);

struct Bar {
    std::string name;   // such as "stream against mesh"
    std::string model;  // of the name it was given
    std::string method; // the map's, such as "projective 128x1"; where several are asked, the worst
    double value = 0;   // what was measured
    double limit = 0;
    bool at_least = true; // value >= limit is asked; else value <= limit
    std::string unit;     // "times", "R", "rays", "share"
    // Rays of chords that miss although the model is hit, in the silhouette band, as shares of all rays: of
    // the map, and of the rival where it is not exact.
    double missed = 0;
    std::optional<double> rival_missed;

    [[nodiscard]] bool reached() const { return at_least ? value >= limit : value <= limit; }
}; // The bars that a model is held to: names that begin with "boot" and "smooth" have their own, those
   // against
// triangles from a million vertices on; others those that any model has. One thread, chords. Bars whose
// methods were not measured are left out.
std::vector<Bar> trace_bars(const std::string& model, const TraceBenchmark& benchmark);

} // namespace spa::measure
