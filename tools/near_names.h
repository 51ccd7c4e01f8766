// SPDX-License-Identifier: Apache-2.0
// What somebody may have meant who wrote a name that there is not.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace spa::tools {

// The number of single-letter edits between two words (Levenshtein 1966).
std::size_t edit_distance(std::string_view a, std::string_view b);

// "; did you mean 'boot' or 'boots'?": those that are at most two edits away, each once, the nearest first
// and at most three; empty if there are none.
std::string did_you_mean(std::string_view given, std::span<const std::string> names);

} // namespace spa::tools
