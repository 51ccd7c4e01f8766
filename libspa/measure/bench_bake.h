// SPDX-License-Identifier: Apache-2.0
// How long the ways to find a model's crossings take, and how much memory a bake needs. What is compared is
// the same work: from a CenteredModel to the outermost crossing of every sample. What it means: README.md
// and ../../docs/measures.md, "Speed".
#pragma once

#include "../bake/bake_options.h"
#include "../bake/orbit.h"
#include "../mesh/model.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace spa::measure {

// Of the seconds that one thing took, run after run.
struct Spread {
    double median = 0, min = 0, max = 0;
    unsigned runs = 0;
};

// values: at least one. The median of an even number of values is the mean of the middle two.
Spread spread_of(std::vector<double> values);

enum class Caster : std::uint8_t {
    radial, // cast_radial
    embree, // a BVH of the model, then one ray a sample
    orbit,  // cast_orbit in batches
    naive,  // cast_orbit, one draw of the whole model a view
};
const char* name(Caster caster);

struct CastTiming {
    Caster caster = Caster::radial;
    unsigned threads = 1;
    // Centred model to crossings, everything included: triangle, radius, facing, normal and colour. Of the
    // orbit without making the context; of `naive` scaled from views_timed to all views.
    Spread crossings;
    // radial and embree: the same without normals and colours, which are the same work for both.
    std::optional<Spread> hits;
    std::optional<Spread> build;   // embree: the share of the BVH in both
    std::uint64_t views_timed = 0; // naive
};

struct BakeTiming {
    unsigned threads = 1;
    std::uint32_t layers = 1;
    Spread seconds; // bake_model, radial: model to images
};

struct BakeBenchmark {
    Grid grid;
    std::vector<CastTiming> casts;
    std::vector<BakeTiming> bakes;
};

struct BenchOptions {
    Grid grid{Mapping::latlong, 640, 480};
    std::vector<Caster> casters{Caster::radial, Caster::embree, Caster::orbit, Caster::naive};
    std::vector<unsigned> threads{1, 2}; // each >= 1
    unsigned runs = 5;                   // >= 1
    bake::GlApi gl = bake::GlApi::automatic;
    std::function<void(double)> progress; // share done; may be empty
};

// Times everything in turns, run by run, so that whatever else the machine does hits all alike. One thread
// for the orbit is one processor for the OpenGL implementation too. Whole bakes are timed along with
// Caster::radial. Throws as bake_model does.
BakeBenchmark bench_bake(const Model& model, const BenchOptions& options);

// What the model's arrays and textures (with their mips) take in memory.
std::uint64_t model_bytes(const Model& model);

// The peak of resident memory over one bake, the model included: model_bytes plus the growth of the
// process. None where the system does not tell (it takes Linux' /proc and glibc).
std::optional<std::uint64_t> peak_bake_bytes(const Model& model, const bake::Options& options);

} // namespace spa::measure
