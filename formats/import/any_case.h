// SPDX-License-Identifier: Apache-2.0
// Files by names that may differ from theirs in the case of letters.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace spa::import {

// Lists each folder once.
class AnyCase {
public:
    // folder: that names are relative to.
    explicit AnyCase(std::filesystem::path folder) : folder_(std::move(folder)) {}

    // As find_in_any_case (import.h).
    std::optional<std::string> find(std::string_view name);

private:
    // The entries of a folder by their names in small letters, the first in the order of bytes where several
    // are equal.
    using Listing = std::map<std::string, std::string>;
    const Listing& listing(const std::filesystem::path& folder);

    std::filesystem::path folder_;
    std::map<std::string, Listing> listings_; // by folder
};

} // namespace spa::import
