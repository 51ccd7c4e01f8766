// SPDX-License-Identifier: Apache-2.0
// Bakes the shape of a model at many sizes and numbers of layers for little more than the largest of them.
#pragma once

#include "../bake/bake.h"
#include "../bake/intervals.h"
#include "../mesh/components.h"

#include <cstdint>
#include <map>

namespace spa::plan {

// A map without colours, that is with images of colour of no use.
struct Shape {
    bake::OwnedMap map;
    bool truncated = false; // a sample has more intervals than the map has layers
};

// One model from one place: centre and frame. Octahedral grids of N, N/2, N/4 cells have their samples in
// common, bit for bit, so the crossings of the largest one cast serve them all; only what depends on
// neighbours (mixed triangles, folds) and the packing is done for each. Where alpha decides what is crossed,
// it is filtered for the size of a texel: there, and for latlong, every size is cast.
class ShapeBaker {
public:
    // components: find_components(model). options: frame, centre and mapping of all maps that it will bake.
    // Runs in the caller's arena, and the casts on options.threads. Throws as bake_model does. model and
    // components outlive it.
    ShapeBaker(const Model& model, const Components& components, const bake::Options& options,
               const bake::Progress& progress);

    // Without layers: where the part stands.
    [[nodiscard]] const Part& place() const { return place_; }

    // The shape that bake_model gives with these options: depths, normals, mixed triangles and folds. The
    // same frame and centre as the constructor's. O(samples + triangles). Throws as bake_model does.
    Shape bake(const bake::Options& options);

    // The bytes that colours of so many cells take in a compressed file, estimated from a few of them.
    std::uint64_t estimate_color_bytes(const bake::Options& options, bool compress);

private:
    // One depth has its own: where two triangles share an edge it may take the other one.
    struct Casts {
        bake::CrossingGrid latest;
        std::map<std::uint32_t, bake::CrossingGrid> largest; // of each family of sizes, by its odd factor
    };
    const bake::CrossingGrid& crossings(const Grid& grid, bool outermost_only);
    [[nodiscard]] std::uint32_t cells_to_cast(std::uint32_t cells) const;
    bake::SurfaceGrid surfaces(const bake::CrossingGrid& crossings, const bake::Options& options,
                               bake::Orientation& orientation, bool& truncated) const;

    const Model& model_;
    const Components& components_;
    unsigned threads_;
    bake::Progress progress_;
    Part place_;
    bool solid_of_one_depth_ = false;
    bool common_samples_ = true;
    bake::CenteredModel centered_;
    Casts all_, outermost_;
};

} // namespace spa::plan
