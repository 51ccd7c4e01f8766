// SPDX-License-Identifier: Apache-2.0
// What layers and the ways to join them bring: false and missed hits, errors along rays, time and bytes of
// maps of one mesh, side by side. What the figures mean: ../../docs/speed.md, "Layers".
#pragma once

#include "bench_bake.h"
#include "ray_errors.h"

#include "../bake/bake.h"
#include "../core/spherical_map.h"
#include "../mesh/model.h"
#include "../trace/ray.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace spa::measure {

class RayTruth;

// What a map holds, and how its tracer joins what neighbouring samples see.
enum class Reconstruction : std::uint8_t {
    one_depth, // the outermost surface alone, solid to the centre: the paper's data
    tangents,  // intervals; in mixed triangles the planes of the stored normals
    folds,     // intervals; in mixed triangles what fold records say (folds.h)
};
const char* name(Reconstruction reconstruction);
// For tables: "one depth", "tangents", "folds".
const char* title(Reconstruction reconstruction);

// layers: kept intervals; without a meaning for one depth.
bake::Options reconstruction_options(Reconstruction reconstruction, std::uint32_t layers,
                                     std::uint32_t cells);

// One map, measured.
struct LayerRow {
    Reconstruction reconstruction = Reconstruction::one_depth;
    std::uint32_t layers = 1, cells = 0;
    double band_width = 0; // of the silhouette band: two texels, in R
    RayErrors errors;
    Spread ns;                        // a ray of a stream, one thread
    std::optional<double> time_ratio; // to one interval of the same reconstruction and size: the median of
                                      // all runs' own ratios; none for one depth, and where it is not there
    std::uint64_t file_bytes = 0;
    std::uint64_t fold_bytes = 0; // by how much fold records make the file larger
    std::uint64_t fold_records = 0;
    double mixed_triangles = 0;   // share of the map's triangles
    double tangent_triangles = 0; // share of those that are divided along tangent planes: for want of folds,
                                  // or because they make no sense, as at cusps
    bake::Report bake;
};

// What a camera sees, one answer a ray of make_rays(RaySet::primary, side * side).
struct LayerView {
    std::uint32_t side = 0;  // 0: there is no view
    std::uint32_t cells = 0; // of the maps
    std::uint32_t layers = 0;
    std::vector<trace::Ray> rays;
    std::vector<RayAnswer> source, one_depth, folds;
};

struct LayersBenchmark {
    std::uint64_t vertices = 0, triangles = 0, components = 0, open_edges = 0;
    Vec3d center; // of the maps, object space
    double radius = 0;
    std::vector<LayerRow> rows; // by size, then reconstruction, then layers
    LayerView view;

    [[nodiscard]] bool closed() const { return open_edges == 0; }
    // Null if it was not measured. layers: of one depth 1.
    [[nodiscard]] const LayerRow* find(Reconstruction reconstruction, std::uint32_t layers,
                                       std::uint32_t cells) const;
};

// The size at which maps are looked at and judged: the first of at least 128 cells, else the largest; and the
// intervals: 2 if they are among them, else the most. cells, layers: not empty.
std::uint32_t usual_cells(std::span<const std::uint32_t> cells);
std::uint32_t usual_layers(std::span<const std::uint32_t> layers);

struct LayersOptions {
    std::vector<std::uint32_t> cells{64, 128, 256, 512}; // ascending
    std::vector<std::uint32_t> layers{1, 2, 3};          // ascending
    std::uint32_t rays = 200'000;                        // chords of ray_sets.h
    std::uint64_t seed = 20240501;
    unsigned runs = 5; // of each timing
    bake::Center center = bake::Center::bounds;
    unsigned threads = 0;        // 0 = all cores; only times depend on it, and those little
    std::uint32_t view_side = 0; // pixels; 0: no view
    // What a file with this map takes. May be empty: 0.
    std::function<std::uint64_t(const SphericalMap&)> file_bytes;
    std::function<bool(double share, const std::string& step)> progress; // false: cancels; may be empty
};

// 1 for every ray with a silhouette within `width`: of eight parallels, four at half of it and four at all of
// it, in two directions across the ray, one hits where the ray itself misses, or the other way round. Others
// are interior. Parallel in the caller's arena.
std::vector<std::uint8_t> near_silhouette(const RayTruth& judge, std::span<const trace::Ray> rays,
                                          std::span<const RayAnswer> truth, float width);

// The maps of one size are timed in turns, run by run. Throws as bake_model does, and bake::Cancelled.
LayersBenchmark bench_layers(const Model& model, const LayersOptions& options);

} // namespace spa::measure
