// SPDX-License-Identifier: Apache-2.0
#include "glob.h"

#include <algorithm>
#include <fnmatch.h>
#include <vector>

namespace spa::tools {

namespace {

std::vector<std::string> parts_of(std::string_view path) {
    std::vector<std::string> parts;
    while (!path.empty()) {
        const std::size_t end = std::min(path.find('/'), path.size());
        if (end > 0) parts.emplace_back(path.substr(0, end));
        path.remove_prefix(std::min(end + 1, path.size()));
    }
    return parts;
}

std::vector<std::string> parts_of_pattern(const std::string& pattern) {
    std::vector<std::string> parts = parts_of(pattern);
    if (!parts.empty() && pattern.find('/') == std::string::npos) parts.insert(parts.begin(), "**");
    return parts;
}

bool part_matches(const std::string& pattern, const std::string& part) {
    return fnmatch(pattern.c_str(), part.c_str(), FNM_NOESCAPE) == 0;
}

} // namespace

bool glob_matches(const std::string& pattern, std::string_view path) {
    const std::vector<std::string> parts = parts_of(path);
    const std::vector<std::string> wanted = parts_of_pattern(pattern);
    if (wanted.empty() || parts.empty()) return false;
    // reached[j]: the pattern so far matches the first j parts.
    std::vector<bool> reached(parts.size() + 1, false);
    reached[0] = true;
    for (const std::string& want : wanted) {
        std::vector<bool> next(reached.size(), false);
        for (std::size_t j = 0; j < reached.size(); ++j) {
            if (want == "**")
                next[j] = reached[j] || (j > 0 && next[j - 1]);
            else
                next[j] = j > 0 && reached[j - 1] && part_matches(want, parts[j - 1]);
        }
        reached = next;
    }
    return std::any_of(reached.begin() + 1, reached.end(), [](bool match) { return match; });
}

bool glob_may_match_below(const std::string& pattern, std::string_view folder) {
    const std::vector<std::string> wanted = parts_of_pattern(pattern);
    const std::vector<std::string> parts = folder == "." ? std::vector<std::string>() : parts_of(folder);
    if (wanted.empty()) return false;
    if (glob_matches(pattern, folder)) return true;
    // What is left of the pattern after the parts of the folder; "**" takes any number of them.
    std::size_t left = 0;
    for (const std::string& part : parts) {
        if (wanted[left] == "**") return true;
        if (!part_matches(wanted[left], part)) return false;
        if (++left == wanted.size()) return false;
    }
    return true;
}

} // namespace spa::tools
