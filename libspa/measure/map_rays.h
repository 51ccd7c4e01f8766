// SPDX-License-Identifier: Apache-2.0
// What rays meet in a map and what they meet in the model it stands for: hits and misses, distances, normals
// and colours, and which false answers no resolution would mend. What the figures mean:
// ../../docs/measures.md, "Rays".
#pragma once

#include "ray_errors.h"

#include "../bake/bake.h"
#include "../core/spherical_map.h"
#include "../mesh/partition.h"

#include <cstdint>
#include <span>

namespace spa::measure {

struct RayOptions {
    std::uint32_t rays = 100'000;    // in all
    std::uint32_t layers = 0;        // as MeasureOptions::layers
    std::uint32_t star_cells = 1024; // of the map that E_star is judged by, even; of
                                     // several parts that of each is coarser
    unsigned threads = 0;            // 0 = all cores; the result does not depend on it
};

// Distances are in units of the model's bounding sphere about the map's centre, in object space.
struct RayFigures {
    double band_width = 0; // of the silhouette band: two texels
    RayErrors errors;
    // Of the rays that hit the map alone, those that hit the star envelope (star_map.h) too; of those that
    // hit the model alone, those that miss that as well. More layers, another centre or parts would mend
    // them; texels and bits would not.
    std::uint64_t star_extra = 0, star_missed = 0;

    [[nodiscard]] std::uint64_t extra() const { return errors.band.extra + errors.interior.extra; }
    [[nodiscard]] std::uint64_t missed() const { return errors.band.missed + errors.interior.missed; }
    // Shares of all rays, in [0,1].
    [[nodiscard]] double false_hits() const {
        return errors.rays() == 0 ? 0 : double(extra()) / double(errors.rays());
    }
    [[nodiscard]] double missed_hits() const {
        return errors.rays() == 0 ? 0 : double(missed()) / double(errors.rays());
    }
};

// A third each of the bounces, chords and leaving rays of ray_sets.h: what a renderer's secondary rays are.
// Traces the part's own images, through both faces; the model by ray_truth.h. O(rays * log(triangles)), and a
// bake of star_cells^2 samples where an answer is false. part: octahedral; Throws Error{unsupported} for
// another, Error{invalid_data} for a model of zero size, and bake::Cancelled.
RayFigures measure_rays(const Model& model, const Part& part, const RayOptions& options,
                        const bake::Progress& progress = {});

// The same of a map of several parts, baked from these pieces of the model: rays are sent at all of them
// together. Distances are then in units of the model's bounding sphere about the centre of its box.
RayFigures measure_rays(const Model& model, const Partition& partition, std::span<const Part> parts,
                        const RayOptions& options, const bake::Progress& progress = {});

} // namespace spa::measure
