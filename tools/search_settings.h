// SPDX-License-Identifier: Apache-2.0
// The options of a bake that say how exact the map is to be instead of what it is to hold.
#pragma once

#include "arguments.h"

#include "../libspa/plan/search.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace spa::tools {

// As given.
struct GivenSearch {
    std::optional<double> target_error, footprint;
    std::optional<plan::Metric> target_metric;
    std::optional<std::uint64_t> max_bytes;
    bool best = false;
};

// Which options of a bake were given by hand: a search leaves them as they are.
struct GivenByHand {
    bool size = false, color_size = false, depth = false, layers = false, frame = false, center = false;
};

// Adds the options to the parser.
void define_search_options(CLI::App& app, GivenSearch& given);

// What is to be searched for; none if there is no target. options: complete. Throws Error{usage} where
// options contradict each other.
std::optional<plan::SearchRequest> complete_search(const GivenSearch& given, const GivenByHand& by_hand,
                                                   const bake::Options& options);

// Puts the options of the search into those of a bake, and takes those out that the search decides.
void add_search_options(const plan::SearchRequest& request, nlohmann::ordered_json& options);

} // namespace spa::tools
