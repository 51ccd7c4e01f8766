// SPDX-License-Identifier: Apache-2.0
// A folder of assets and what `spa batch` makes of them, compared with what `spa bake` makes.
#pragma once

#include "../cli/process.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace spa::test {

class BatchFolder {
public:
    // options: of every bake.
    explicit BatchFolder(std::vector<std::string> options = {"--size", "16"});

    // Where the commands run. Assets are in "in", maps in "out", both below it.
    [[nodiscard]] const std::filesystem::path& path() const { return folder_.path(); }
    [[nodiscard]] std::filesystem::path in(const std::string& name = "") const {
        return path() / "in" / name;
    }
    [[nodiscard]] std::filesystem::path out(const std::string& name = "") const {
        return path() / "out" / name;
    }
    // That of an asset.
    [[nodiscard]] std::filesystem::path map_of(const std::string& name) const;

    // Writes in/NAME and the folders above it.
    void write(const std::string& name, const std::string& bytes) const;
    // As write(), of an asset, whose map is expected from now on.
    void add(const std::string& name, const std::string& bytes);
    // An asset whose bake takes minutes in a slow_batch(), and no longer than any other in another run, if
    // its name begins with "slow". It is the largest, and so the first that is begun.
    void add_slow(const std::string& name);
    // No longer.
    void forget(const std::string& name) { assets_.erase(name); }
    [[nodiscard]] const std::set<std::string>& assets() const { return assets_; }

    // The arguments of `spa batch in -o out --jobs 2` with the options and more.
    [[nodiscard]] std::vector<std::string> batch(const std::vector<std::string>& more = {}) const;
    // As batch(), with further options for the assets that a pattern matches.
    [[nodiscard]] std::vector<std::string> batch_with(const std::string& pattern,
                                                      const nlohmann::json& options,
                                                      const std::vector<std::string>& more = {}) const;
    // As batch(), but for assets whose name begins with "slow".
    [[nodiscard]] std::vector<std::string> slow_batch(const std::vector<std::string>& more = {}) const;
    // Of a batch() with more.
    [[nodiscard]] Outcome run(const std::vector<std::string>& more = {},
                              const Surroundings& surroundings = {}) const;

    // The map that `spa bake` makes of an asset as it and the other files of its folder are now.
    const std::string& reference(const std::string& name);

    // Every file in "out" whose name ends in .spa is the map of an asset as `spa bake` makes it.
    testing::AssertionResult maps_are_right();
    // maps_are_right(), none is missing, and there is nothing else.
    testing::AssertionResult is_complete();
    // What is in "out" besides maps and folders.
    [[nodiscard]] std::vector<std::string> others() const;

    // What `spa batch --report report.json` wrote, checked against its schema.
    [[nodiscard]] nlohmann::json report() const;

private:
    TemporaryFolder folder_;
    std::vector<std::string> options_;
    std::set<std::string> assets_;
    std::map<std::string, std::string> references_; // by what they depend on
};

// A file passes every check of the container.
testing::AssertionResult is_whole(const std::filesystem::path& map);
testing::AssertionResult says(const std::string& text, const std::string& part);
// The asset of a report; null if it has none of this name.
nlohmann::json asset_of(const nlohmann::json& report, const std::string& name);

} // namespace spa::test
