// SPDX-License-Identifier: Apache-2.0
#include "batch_folder.h"

#include "assets.h"

#include "../cli/schema.h"

#include "../../formats/container/reader.h"
#include "../../formats/container/status.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace spa::test {

namespace fs = std::filesystem;

namespace {

// Of what can be read; an asset that cannot be has no reference.
std::string content_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// All that a bake may read: the files of the asset's folder.
std::string state_of(const fs::path& asset) {
    std::vector<std::string> files;
    std::error_code unreadable; // such as a link to itself
    for (const fs::directory_entry& entry : fs::directory_iterator(asset.parent_path()))
        if (entry.is_regular_file(unreadable))
            files.push_back(entry.path().filename().string() + '\0' + content_of(entry));
    std::sort(files.begin(), files.end());
    std::string state = asset.filename().string();
    for (const std::string& file : files) state += '\0' + std::to_string(file.size()) + '\0' + file;
    return state;
}

} // namespace

BatchFolder::BatchFolder(std::vector<std::string> options) : options_(std::move(options)) {
    fs::create_directory(in());
}

fs::path BatchFolder::map_of(const std::string& name) const { return out(name).replace_extension(".spa"); }

void BatchFolder::write(const std::string& name, const std::string& bytes) const {
    fs::create_directories(in(name).parent_path());
    write_file(in(name), bytes);
}

void BatchFolder::add(const std::string& name, const std::string& bytes) {
    write(name, bytes);
    assets_.insert(name);
}

void BatchFolder::add_slow(const std::string& name) { add(name, obj_of_size(0, 100'000)); }

std::vector<std::string> BatchFolder::batch(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"batch", "in", "-o", "out", "--jobs", "2"};
    arguments.insert(arguments.end(), options_.begin(), options_.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

std::vector<std::string> BatchFolder::batch_with(const std::string& pattern, const nlohmann::json& options,
                                                 const std::vector<std::string>& more) const {
    // All in the file: what is in the command line would overrule the pattern.
    nlohmann::json config = {{"options", nlohmann::json::object()},
                             {"patterns", {{{"match", pattern}, {"options", options}}}}};
    for (std::size_t i = 0; i + 1 < options_.size(); i += 2)
        config["options"][options_[i].substr(2)] = options_[i + 1];
    write_file(path() / "config.json", config.dump());
    std::vector<std::string> arguments{"batch", "in", "-o", "out", "--jobs", "2", "--config", "config.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

std::vector<std::string> BatchFolder::slow_batch(const std::vector<std::string>& more) const {
    // A hundred million camera views.
    return batch_with(
        "slow*",
        {{"paper", true}, {"size", "1280x960"}, {"samples", 8}, {"baker", "orbit"}, {"gl", "osmesa"}}, more);
}

Outcome BatchFolder::run(const std::vector<std::string>& more, const Surroundings& surroundings) const {
    return run_spa(batch(more), path(), "", surroundings);
}

const std::string& BatchFolder::reference(const std::string& name) {
    std::string& bytes = references_[state_of(in(name))];
    if (!bytes.empty()) return bytes;
    const fs::path map = path() / "reference.spa";
    // "./": a name may begin with what is no file name there.
    std::vector<std::string> arguments{"bake", "./in/" + name, "-o", map.string()};
    arguments.insert(arguments.end(), options_.begin(), options_.end());
    const Outcome outcome = run_spa(arguments, path());
    if (outcome.exit_code != 0) throw std::runtime_error("no reference: " + outcome.err);
    bytes = read_file(map);
    fs::remove(map);
    return bytes;
}

testing::AssertionResult BatchFolder::maps_are_right() {
    if (!fs::exists(out())) return testing::AssertionSuccess();
    std::map<fs::path, std::string> names;
    for (const std::string& name : assets_) names[map_of(name)] = name;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(out())) {
        if (!entry.is_regular_file() || entry.path().extension() != ".spa") continue;
        const auto name = names.find(entry.path());
        if (name == names.end()) return testing::AssertionFailure() << entry.path() << " is of no asset";
        if (testing::AssertionResult whole = is_whole(entry.path()); !whole) return whole;
        if (read_file(entry.path()) != reference(name->second))
            return testing::AssertionFailure() << entry.path() << " is not what `spa bake` makes";
    }
    return testing::AssertionSuccess();
}

testing::AssertionResult BatchFolder::is_complete() {
    if (testing::AssertionResult right = maps_are_right(); !right) return right;
    for (const std::string& name : assets_)
        if (!fs::exists(map_of(name))) return testing::AssertionFailure() << name << " has no map";
    if (const std::vector<std::string> left = others(); !left.empty())
        return testing::AssertionFailure() << left.front() << " was left behind";
    return testing::AssertionSuccess();
}

std::vector<std::string> BatchFolder::others() const {
    std::vector<std::string> names;
    if (!fs::exists(out())) return names;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(out()))
        if (!entry.is_directory() && entry.path().extension() != ".spa")
            names.push_back(fs::relative(entry.path(), out()).string());
    std::sort(names.begin(), names.end());
    return names;
}

nlohmann::json BatchFolder::report() const {
    nlohmann::json report = nlohmann::json::parse(read_file(path() / "report.json"));
    const std::string error = schema_error(load_schema("batch"), report);
    EXPECT_EQ(error, "");
    return report;
}

testing::AssertionResult is_whole(const fs::path& map) {
    container::File file;
    const container::Status status =
        container::open(map.string(), file, {container::no_limits, container::CheckDepth::full, false});
    if (status.ok()) return testing::AssertionSuccess();
    return testing::AssertionFailure() << container::describe(status, map.string());
}

testing::AssertionResult says(const std::string& text, const std::string& part) {
    if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "'" << part << "' is not in:\n" << text;
}

nlohmann::json asset_of(const nlohmann::json& report, const std::string& name) {
    for (const nlohmann::json& asset : report["assets"])
        if (asset["source"] == name) return asset;
    return nullptr;
}

} // namespace spa::test
