// SPDX-License-Identifier: Apache-2.0
// Tables 1 to 7 of the paper on this device: boots of seven levels of subdivision, each met by every method,
// with the error of every cell, and what it costs to have the object on the device.
#pragma once

#include "paper_methods.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace spa::tools {

struct PaperCell {
    int level = 0;
    std::string method;
    std::uint32_t samples = 0; // secondary rays a pixel
    double seconds = 0;        // of the frame, on the device
    std::uint64_t secondary_rays = 0;
    double secondary_seconds = 0;
    // Of the indirect light: against triangles with the same directions, which is the method's own error, and
    // against many samples of triangles, which is what is seen.
    double relmse_equal_seeds = 0, relmse = 0;
};

// What an object costs on the device, as triangles and as a map.
struct PaperCosts {
    int level = 0;
    std::uint64_t vertices = 0, triangles = 0;
    std::uint64_t triangle_bytes = 0, triangle_structure_bytes = 0; // attributes; acceleration structure
    std::uint64_t map_bytes = 0, map_structure_bytes = 0;           // one layer
    double triangle_build_seconds = 0, map_load_seconds = 0;
    double triangle_first_frame = 0, map_first_frame = 0; // from the file to the first frame
    std::uint64_t glb_bytes = 0, spa_bytes = 0;
    // Simplified meshes that are as exact as the map, by the mean and by the median of |dt| of random chords.
    struct LodRates {
        std::uint64_t triangles = 0;
        double mean = 0, median = 0; // |dt|, R
        double rays_a_second = 0;    // secondary ones
    };
    double map_mean = 0, map_median = 0;
    std::optional<LodRates> lod_by_mean, lod_by_median;
};

struct PaperTables {
    std::uint32_t width = 0, height = 0;
    std::vector<PaperCell> cells;
    std::vector<PaperCosts> costs; // one a level

    [[nodiscard]] const PaperCell* find(int level, const std::string& method, std::uint32_t samples) const;
};

struct PaperTableOptions {
    std::vector<int> levels{0, 1, 2, 3, 4, 5, 6};
    std::vector<std::uint32_t> samples{8, 32, 128, 256};
    std::uint32_t width = 128, height = 96;
    std::uint32_t reference_samples = 512;
    // On levels above this the reference of this level is used: the boots no longer differ to the eye.
    int reference_level = 4;
    unsigned runs = 1; // of each frame; times are the medians
    render::Backend backend = render::Backend::pipeline;
    std::function<PaperScene(int level)> scene;
    // Seconds from a file to what a renderer takes, for the object as a glTF file and as a map; the map has
    // to live until the next call.
    struct Files {
        std::uint64_t glb_bytes = 0, spa_bytes = 0;
        double read_glb = 0, read_spa = 0;
    };
    std::function<Files(const Model& object, const SphericalMap& map)> files;
    std::function<bool(double share, const std::string& step)> progress; // false: cancels; may be empty
};

// Throws Error, and bake::Cancelled.
PaperTables run_paper_tables(const render::Gpu& gpu, const PaperTableOptions& options);

} // namespace spa::tools
