// SPDX-License-Identifier: Apache-2.0
// From a model to a spherical map.
#pragma once

#include "bake_options.h"
#include "crossings.h"
#include "placement.h"

#include "../core/spherical_map.h"
#include "../mesh/model.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace spa::bake {

// A SphericalMap that owns its pixels. Movable; the views in `map` stay valid.
struct OwnedMap {
    SphericalMap map;
    std::vector<std::unique_ptr<std::byte[]>> pixels;
};

// Of the edges between samples (fold records: ../core/folds.h).
struct FoldStatistics {
    std::uint64_t edges = 0;
    std::uint64_t searched = 0;   // whose samples' crossings do not match as they are
    std::uint64_t directions = 0; // cast between samples
    std::uint64_t pairs = 0;      // records of two crossings that meet
    std::uint64_t singles = 0;    // records of one that ends alone
    std::uint64_t unresolved = 0; // edges on which all crossings end in the middle, as records cannot say
                                  // what was found
};

struct LayerReport {
    double outer_coverage = 0; // share of the sphere's directions (by solid angle) with an outer surface
    double inner_coverage = 0; // ... whose interval ends before the centre
};

struct Report {
    std::uint64_t triangles = 0;          // baked
    std::uint64_t components = 0;         // pieces connected through vertices welded by position
    std::uint64_t open_edges = 0;         // directed edges without a partner in the opposite direction
    std::uint64_t turned_triangles = 0;   // wound against their neighbours; taken as if they were not
    std::uint64_t flipped_components = 0; // pieces whose faces point into the solid; taken the other way
                                          // round. Like the next one only counted where there are intervals
    std::uint64_t solid_components = 0;   // pieces that hold the centre: open sides reach it
    std::uint64_t edge_on_triangles = 0;  // their plane holds the centre: no direction sees them
    std::uint64_t unseen_components = 0;  // pieces of which no sample stores a crossing: needles lost between
                                          // the samples, or hidden behind the stored layers
    std::uint64_t back_facing_samples = 0; // whose outermost crossing is a back face
    std::uint64_t thin_samples = 0;        // with a surface that bounds no solid, stored as a thin shell
    std::uint64_t truncated_samples = 0;   // with more intervals than layers
    bool center_on_surface = false;        // the centre is closer to the surface than 1e-4 R
    bool center_inside = false;            // the centre is in the solid (intervals.h; one layer: winding.h)
    Placement placement;                   // what was chosen, before the centre was moved off the surface
    double center_moved = 0;               // how far it was moved off the surface, in units of R
    std::vector<LayerReport> layers;       // as written
    std::optional<double> mixed_triangles; // share of the map's triangles (mixed.h); none for latlong
    std::optional<FoldStatistics> folds;   // none where they are not looked for
    std::vector<std::string> warnings;     // full sentences
    std::string gl;                        // orbit: GlContext::description()
    double seconds = 0;                    // wall clock; never goes into a file
};

struct Result {
    OwnedMap map; // one part; metadata is left to the caller
    Report report;
};

// Bakes the whole model into one part. Throws Error (unsupported: no GL for the orbit; invalid_data: nothing
// to bake, such as a model of zero size; internal) and Cancelled. Same model and options, same bytes.
Result bake_model(const Model& model, const Options& options, const Progress& progress = {});

// Finds the crossings of all samples, as cast_radial does.
using Caster = std::function<CrossingGrid(const CenteredModel&, const Grid&, const CastOptions&)>;

// bake_model with crossings from `cast` instead of one of the two bakers: for checking them.
Result bake_with(const Caster& cast, const Model& model, const Options& options,
                 const Progress& progress = {});

} // namespace spa::bake
