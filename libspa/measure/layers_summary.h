// SPDX-License-Identifier: Apache-2.0
// What bench_layers measured of several meshes, as one: means, and the bars that they are held to.
#pragma once

#include "bench_layers.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace spa::measure {

// The columns of the table: of a row, or the mean of the same row of several meshes.
struct LayerFigures {
    Reconstruction reconstruction = Reconstruction::one_depth;
    std::uint32_t layers = 1, cells = 0;
    // Shares of all rays: the map alone is hit, or the model alone; and those of them that are interior.
    double false_hits = 0, missed_hits = 0, interior_false = 0, interior_missed = 0;
    double distance_mean = 0, distance_p95 = 0, distance_p99 = 0; // |dt| of rays that hit both, in R
    double normal_mean = 0;                                       // degrees
    double ns = 0;                                                // a ray
    std::optional<double> time_ratio;                             // LayerRow::time_ratio
    double file_bytes = 0, fold_bytes = 0;
    double fold_share = 0; // of the file
    double mixed_triangles = 0;
    double tangent_triangles = 0; // LayerRow::tangent_triangles
};

LayerFigures figures_of(const LayerRow& row);

// A mesh under the name that reports give it.
struct LayersMesh {
    std::string name;
    LayersBenchmark benchmark;
};

// Of those that are closed; all measured with the same options. No rows if none is.
std::vector<LayerFigures> closed_mean(std::span<const LayersMesh> meshes);
std::size_t closed_count(std::span<const LayersMesh> meshes);

struct LayersBar {
    std::string name; // such as "false hits"
    std::uint32_t cells = 0;
    bool worst_size = false; // cells: that at which the value is worst, of 128 and 256, or of all
    double value = 0;
    double limit = 0;
    bool at_least = false; // value >= limit is asked; else value <= limit
    std::string unit;      // "share", "R", "times"
    std::string mesh;      // of an open mesh; empty: the value is the mean of the closed ones
    // Of the closed ones that which is farthest off.
    std::string worst_mesh;
    double worst = 0;

    [[nodiscard]] bool reached() const { return at_least ? value >= limit : value <= limit; }
};

// Of the mean of the closed meshes with two intervals and folds: false and missed hits and mean |dt| at 128
// and 256 cells; interior hits, time and bytes at that of these two where they are worst (of
// all sizes, if neither was measured). Of every open mesh how many
// times fewer false hits folds have than one depth. What was not measured is left out.
std::vector<LayersBar> layers_bars(std::span<const LayersMesh> meshes);

} // namespace spa::measure
