// SPDX-License-Identifier: Apache-2.0
#include "any_case.h"

#include "import.h"

#include <algorithm>

namespace spa::import {

namespace fs = std::filesystem;

namespace {

std::string in_small_letters(std::string_view name) {
    std::string small(name);
    for (char& c : small) c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
    return small;
}

} // namespace

const AnyCase::Listing& AnyCase::listing(const fs::path& folder) {
    const auto [entry, is_new] = listings_.try_emplace(folder.string());
    Listing& names = entry->second;
    if (!is_new) return names;
    std::error_code code;
    for (fs::directory_iterator it(folder, code), end; !code && it != end; it.increment(code)) {
        std::string name = it->path().filename().string();
        const auto [same, first] = names.try_emplace(in_small_letters(name), name);
        if (!first && name < same->second) same->second = std::move(name);
    }
    return names;
}

std::optional<std::string> AnyCase::find(std::string_view name) {
    fs::path folder = folder_.empty() ? "." : folder_;
    std::string found;
    for (std::size_t begin = 0; begin <= name.size();) {
        const std::size_t end = std::min(name.find('/', begin), name.size());
        const Listing& names = listing(folder);
        const auto entry = names.find(in_small_letters(name.substr(begin, end - begin)));
        if (entry == names.end()) return std::nullopt;
        found += (found.empty() ? "" : "/") + entry->second;
        folder /= entry->second;
        begin = end + 1;
    }
    return found;
}

std::optional<std::string> find_in_any_case(const fs::path& folder, std::string_view name) {
    return AnyCase(folder).find(name);
}

} // namespace spa::import
