// SPDX-License-Identifier: Apache-2.0
// What somebody may have meant who wrote a name that there is not.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spa::tools {

// The number of single-letter edits between two words (Levenshtein 1966).
std::size_t edit_distance(std::string_view a, std::string_view b);

// "; did you mean 'boot' or 'boots'?": those that are at most two edits away, each once, the nearest first
// and at most three; empty if there are none.
std::string did_you_mean(std::string_view given, std::span<const std::string> names);

// What may have been meant, or else what there is: "; there are boot, floor, ...".
std::string suggestion(const std::string& given, const std::vector<std::string>& names);

// The names of all, each once, in order; of the first hundred thousand.
template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
    std::vector<std::string> names;
    for (const Named& one : all)
        if (!one.name.empty() && std::find(names.begin(), names.end(), one.name) == names.end() &&
            names.size() < 100000)
            names.push_back(one.name);
    return names;
}

} // namespace spa::tools
