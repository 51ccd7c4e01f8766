// SPDX-License-Identifier: Apache-2.0
// Speed against error of tracing: what it costs to find what rays meet in a map, in triangles and in fewer
// triangles, and how wrong each is. What it means: ../../docs/measures.md, "Rays".
#pragma once

#include "bench_bake.h"
#include "error_parts.h"
#include "trace_methods.h"

#include "../core/spherical_map.h"
#include "../mesh/model.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace spa::measure {

struct TraceTiming {
    RaySet set = RaySet::chords;
    unsigned threads = 1;
    CallKind kind = CallKind::single;
    std::string call; // TraceMethod::call_name
    Spread ns; // nanoseconds a ray: of one thread its own time (which other processes do not add to), of
               // several the wall clock's
};

struct SetErrors {
    RaySet set = RaySet::chords;
    double band_width = 0; // of the silhouette band, in R
    RayErrors errors;
};

// A map in a file and back.
struct FileTrip {
    std::uint64_t bytes = 0; // of the file
    Spread first_ray;        // seconds from opening it to the answer of a ray, one thread
};

struct MethodReport {
    std::string name;
    Family family = Family::mesh;
    std::uint32_t cells = 0, layers = 0; // as in TraceMethod
    std::uint64_t triangles = 0;
    double target_error = 0;
    std::uint64_t bytes = 0;
    std::optional<FileTrip> file;              // maps
    std::optional<double> build_seconds;       // Embree's hierarchy, one thread
    std::optional<double> build_seconds_cores; // mesh: with all cores
    std::vector<SetErrors> errors;
    std::vector<TraceTiming> timings;
    std::optional<ErrorParts> parts; // projective

    [[nodiscard]] const SetErrors* errors_of(RaySet set) const;
    [[nodiscard]] const TraceTiming* timing(RaySet set, unsigned threads, CallKind kind) const;
    // The faster of both kinds; null if nothing was timed.
    [[nodiscard]] const TraceTiming* fastest(RaySet set, unsigned threads) const;
};

struct TraceBenchmark {
    std::uint64_t vertices = 0, triangles = 0;
    double simplify_seconds = 0; // all steps
    std::vector<MethodReport> methods;

    [[nodiscard]] const MethodReport* find(const std::string& name) const;
};

struct TraceBenchOptions {
    std::vector<Family> families{Family::fan,  Family::march, Family::projective,
                                 Family::mesh, Family::lod,   Family::surface};
    std::vector<std::uint32_t> cells{32, 64, 128, 256, 512};
    std::vector<std::uint32_t> layers{1, 2};
    std::vector<std::uint32_t> tests{1, 3, 5, 10, 25, 50, 0}; // fan
    std::vector<double> lod_errors;                           // in R, descending; empty: default_lod_errors()
    std::vector<RaySet> sets{ray_sets().begin(), ray_sets().end()};
    std::uint32_t rays = 100000; // of each set, for errors and times alike
    unsigned runs = 5;
    // The first for all sets, others for chords alone (of which renderers have most).
    std::vector<unsigned> threads{1, 2};
    bool parts = true; // measure ErrorParts
    // Writes a map as a file does, and opens it `runs` times for `ray`. May be empty: no FileTrip.
    std::function<FileTrip(const SphericalMap& map, const trace::Ray& ray, unsigned runs)> through_file;
    std::function<bool(double share, const std::string& step)> progress; // false: cancels; may be empty
};
// From 0.05 to 5e-5 R, three a decade.
std::vector<double> default_lod_errors();

// Everything is timed in turns, run by run. Throws as bake_model does, and bake::Cancelled.
TraceBenchmark bench_trace(const Model& model, const TraceBenchOptions& options);

} // namespace spa::measure
