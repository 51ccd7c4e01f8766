// SPDX-License-Identifier: Apache-2.0
#include "near_names.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace spa::tools {

namespace {
constexpr std::size_t most_edits = 2;
constexpr std::size_t most_names = 3;
} // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row.back();
}

std::string did_you_mean(std::string_view given, std::span<const std::string> names) {
    std::vector<std::pair<std::size_t, std::string>> near;
    for (const std::string& name : names) {
        // Names may be long: their lengths alone are so many edits apart.
        const std::size_t longer = std::max(name.size(), given.size());
        if (name.empty() || longer - std::min(name.size(), given.size()) > most_edits) continue;
        const std::size_t edits = edit_distance(given, name);
        if (edits <= most_edits) near.emplace_back(edits, name);
    }
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    std::string text;
    for (std::size_t i = 0; i < near.size() && i < most_names; ++i)
        text += (i == 0 ? "; did you mean '" : " or '") + near[i].second + "'";
    return text.empty() ? text : text + "?";
}

std::string suggestion(const std::string& given, const std::vector<std::string>& names) {
    constexpr std::size_t most_listed = 12;
    std::string near = did_you_mean(given, names);
    if (!near.empty()) return near;
    if (names.empty()) return "; none has a name";
    std::string text = "; there are ";
    for (std::size_t i = 0; i < names.size() && i < most_listed; ++i) text += (i == 0 ? "" : ", ") + names[i];
    return names.size() > most_listed ? text + ", ..." : text;
}

} // namespace spa::tools
