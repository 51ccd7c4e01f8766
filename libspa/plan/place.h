// SPDX-License-Identifier: Apache-2.0
// A frame and a centre of a search: what maps of the model look like from there, what they cost and how far
// off they are.
#pragma once

#include "judge.h"
#include "search.h"
#include "shape_baker.h"

#include <map>
#include <memory>

namespace spa::plan {

class Place {
public:
    // unit: distances are in so many units of object space (metrics of rays) or of the frame (of surfaces);
    // 0: in R. All outlive it.
    Place(const Model& model, const Components& components, const SearchRequest& request, bake::Frame frame,
          bake::Center center, double unit, const bake::Progress& progress);

    // R in that unit's space.
    [[nodiscard]] double radius() const { return radius_; }
    [[nodiscard]] bake::Frame frame() const { return frame_; }
    [[nodiscard]] bake::Center center() const { return center_; }

    // Decides on the size of colour: the least that keeps the target, as far as it takes no more than half of
    // max_bytes. Before that the smallest counts.
    void choose_colors(std::vector<TriedColor>& tried);

    // Of the place's frame and centre; what is not said is zero.
    [[nodiscard]] Candidate candidate(std::uint32_t cells, std::uint32_t layers, ElementFormat depth) const;
    // truncated: see Shape. exactly: with all samples there are, not with as few as tell that the target is
    // met or missed.
    Tried try_out(const Candidate& candidate, bool& truncated, bool exactly = false);
    // The bytes of another size, with another depth, after one that was tried.
    [[nodiscard]] std::uint64_t estimate_bytes(const Tried& tried, const Candidate& other);
    // ... before anything was.
    [[nodiscard]] std::uint64_t estimate_bytes(const Candidate& candidate);

private:
    std::uint64_t color_bytes(const Candidate& candidate);

    const Model& model_;
    const SearchRequest& request_;
    bake::Frame frame_;
    bake::Center center_;
    ShapeBaker baker_;
    double radius_;
    std::unique_ptr<Judge> judge_;
    std::uint32_t color_cells_;
    std::map<std::uint32_t, std::uint64_t> color_bytes_; // by layers
};

} // namespace spa::plan
