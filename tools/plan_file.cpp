// SPDX-License-Identifier: Apache-2.0
#include "plan_file.h"

#include "text.h"

#include "../formats/container/checksum.h"
#include "../formats/import/import.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <set>
#include <span>
#include <utility>

namespace spa::tools {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

constexpr std::uintmax_t most_bytes = std::uintmax_t(256) << 20U; // some 1000 an object are usual
constexpr std::size_t most_objects = std::size_t(1) << 16U;
constexpr std::uint32_t most_samples = 1U << 20U; // of spa render --samples
constexpr std::uint32_t largest_size = 8192;      // of spa bake --size

// A value of the plan and where it stands.
class Value {
public:
    Value(const Json& json, std::string file, std::string pointer)
        : json_(json), file_(std::move(file)), pointer_(std::move(pointer)) {}

    [[noreturn]] void refuse(const std::string& what) const {
        throw Error(ExitCode::invalid_data, file_ + ": " + (pointer_.empty() ? "the document" : pointer_) +
                                                " " + what + "; make the plan anew with spa plan");
    }
    [[nodiscard]] bool has(const char* key) const {
        return json_.is_object() && json_.contains(key) && !json_[key].is_null();
    }
    [[nodiscard]] Value operator[](const char* key) const {
        if (!json_.is_object()) refuse("is no object");
        const auto found = json_.find(key);
        if (found == json_.end()) refuse(std::string("has no member \"") + key + "\"");
        return {*found, file_, pointer_ + "/" + key};
    }
    [[nodiscard]] std::vector<Value> elements(std::size_t most) const {
        if (!json_.is_array()) refuse("is no array");
        if (json_.size() > most) refuse("has more than " + std::to_string(most) + " elements");
        std::vector<Value> all;
        for (std::size_t i = 0; i < json_.size(); ++i)
            all.emplace_back(json_[i], file_, pointer_ + "/" + std::to_string(i));
        return all;
    }
    [[nodiscard]] std::string text() const {
        if (!json_.is_string()) refuse("is no text");
        std::string value = json_.get<std::string>();
        if (value.find('\0') != std::string::npos) refuse("has a zero byte in it");
        return value;
    }
    [[nodiscard]] std::uint64_t number(std::uint64_t lowest, std::uint64_t highest) const {
        const std::uint64_t value = json_.is_number_unsigned() ? json_.get<std::uint64_t>() : 0;
        if (!json_.is_number_unsigned() || value < lowest || value > highest)
            refuse("is no whole number from " + std::to_string(lowest) + " to " + std::to_string(highest));
        return value;
    }
    [[nodiscard]] const Json& json() const { return json_; }
    [[nodiscard]] std::string place() const { return file_ + ": " + pointer_; }

private:
    const Json& json_;
    std::string file_, pointer_;
};

bool leads_out(const fs::path& path) {
    return path.empty() || path.is_absolute() || path.has_root_name() ||
           std::find(path.begin(), path.end(), "..") != path.end();
}

bool is_inside(const fs::path& path, const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

std::string read_text(const fs::path& path) {
    std::error_code error;
    if (fs::is_directory(path, error))
        throw Error(ExitCode::input_output, path.string() + ": is a folder; name a plan that spa plan wrote");
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Error(ExitCode::input_output, path.string() + ": cannot be opened; check the path");
    std::string text;
    std::vector<char> block(std::size_t(1) << 16U);
    while (file.read(block.data(), std::streamsize(block.size())), file.gcount() > 0) {
        text.append(block.data(), std::size_t(file.gcount()));
        if (text.size() > most_bytes)
            throw Error(ExitCode::invalid_data, path.string() + ": is larger than 256 MiB, which no plan is");
    }
    if (file.bad()) throw Error(ExitCode::input_output, path.string() + ": cannot be read to its end");
    return text;
}

PlanDecision parse_decision(const Value& value) {
    const std::string text = value.text();
    for (const PlanDecision decision : {PlanDecision::map, PlanDecision::triangles, PlanDecision::drop})
        if (text == name(decision)) return decision;
    value.refuse("is '" + text + "' instead of map, triangles or drop");
}

fs::path parse_map(const Value& value) {
    const fs::path map = value.text();
    if (leads_out(map))
        value.refuse("is '" + map.string() +
                     "', which leads out of the plan's folder: a map is written below it");
    if (map.extension() != ".spa") value.refuse("is '" + map.string() + "', which does not end with .spa");
    return map.lexically_normal();
}

PlanObject parse_object(const Value& value) {
    PlanObject object;
    object.node = std::uint32_t(value["node"].number(0, no_index - 1));
    object.name = value["name"].text();
    if (value.has("same_as")) object.same_as = std::uint32_t(value["same_as"].number(0, no_index - 1));
    object.decision = parse_decision(value["decision"]);
    if (object.decision != PlanDecision::map) return object;
    object.method = value["method"].text();
    if (object.same_as) return object;
    object.settings = parse_given_settings(value["settings"].json(), value["settings"].place());
    object.map = parse_map(value["map"]);
    return object;
}

void check_objects(Plan& plan, const std::vector<Value>& values) {
    std::set<fs::path> maps;
    for (std::size_t i = 0; i < plan.objects.size(); ++i) {
        const PlanObject& object = plan.objects[i];
        if (!plan.by_node.emplace(object.node, i).second)
            values[i]["node"].refuse("is " + std::to_string(object.node) +
                                     ", as that of an object before it");
        if (!object.map.empty() && !maps.insert(object.map).second)
            values[i]["map"].refuse("is '" + object.map.string() + "', as that of an object before it");
    }
    for (std::size_t i = 0; i < plan.objects.size(); ++i) {
        const PlanObject& object = plan.objects[i];
        if (object.decision != PlanDecision::map || !object.same_as) continue;
        const auto owner = plan.by_node.find(*object.same_as);
        if (owner == plan.by_node.end() || plan.objects[owner->second].map.empty())
            values[i]["same_as"].refuse("is " + std::to_string(*object.same_as) +
                                        ", which is no object with a map of its own");
    }
}

std::vector<PlanSource> parse_files(const Value& value) {
    std::vector<PlanSource> files;
    for (const Value& file : value.elements(most_objects))
        files.push_back({file["name"].text(),
                         file["bytes"].number(0, std::numeric_limits<std::uint64_t>::max()),
                         file["xxh3"].text()});
    return files;
}

// Empty if it cannot be read.
std::string hash_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return {};
    container::RunningChecksum sum;
    std::vector<char> block(std::size_t(1) << 18U);
    while (file.read(block.data(), std::streamsize(block.size())), file.gcount() > 0)
        sum.add(std::as_bytes(std::span(block).first(std::size_t(file.gcount()))));
    return file.bad() ? std::string() : hex64(sum.value());
}

} // namespace

const char* name(PlanDecision decision) {
    switch (decision) {
    case PlanDecision::map: return "map";
    case PlanDecision::drop: return "drop";
    case PlanDecision::triangles: break;
    }
    return "triangles";
}

const PlanObject& Plan::owner_of_map(const PlanObject& object) const {
    return object.same_as ? objects[by_node.at(*object.same_as)] : object;
}

Plan read_plan(const fs::path& path) {
    const std::string text = read_text(path);
    Json json;
    try {
        json = Json::parse(text);
    } catch (const Json::exception& error) {
        throw Error(ExitCode::invalid_data, path.string() + ": is not JSON: " + error.what());
    }
    const Value document(json, path.string(), "");
    Plan plan;
    plan.path = path;
    const std::string scene = document["scene"]["path"].text();
    if (scene.empty()) document["scene"]["path"].refuse("is empty");
    plan.scene = path.parent_path() / scene; // the second alone if it is absolute
    plan.files = parse_files(document["scene"]["files"]);
    const Value request = document["request"];
    if (request.has("camera")) plan.camera = request["camera"].text();
    if (request.has("samples")) plan.samples = std::uint32_t(request["samples"].number(0, most_samples));
    plan.one_size = std::uint32_t(document["one_size"].number(2, largest_size));
    if (plan.one_size % 2 != 0) document["one_size"].refuse("is odd; the sizes of maps are even");
    const std::vector<Value> objects = document["objects"].elements(most_objects);
    for (const Value& object : objects) plan.objects.push_back(parse_object(object));
    check_objects(plan, objects);
    return plan;
}

std::vector<std::string> changed_sources(const Plan& plan, const fs::path& scene) {
    std::vector<std::string> sentences;
    for (std::size_t i = 0; i < plan.files.size(); ++i) {
        const PlanSource& planned = plan.files[i];
        if (i > 0 && leads_out(planned.name)) continue;
        // The scene itself may have another name by now.
        const fs::path file = i == 0 ? scene : scene.parent_path() / planned.name;
        std::error_code error;
        if (fs::file_size(file, error) == planned.bytes && !error && hash_of(file) == planned.xxh3) continue;
        sentences.push_back(file.string() + ": is not what " + plan.path.string() +
                            " was made for: its content differs; make the plan anew with spa plan");
    }
    return sentences;
}

fs::path folder_of_plan(const fs::path& plan) {
    return plan.has_parent_path() ? plan.parent_path() : fs::path(".");
}

fs::path map_path(const Plan& plan, const PlanObject& object, const fs::path& folder, bool follow_links) {
    fs::path path = folder / object.map;
    if (follow_links) return path;
    std::error_code error;
    const fs::path real_folder = fs::weakly_canonical(fs::absolute(folder), error);
    const fs::path real = error ? fs::path() : fs::weakly_canonical(fs::absolute(path).parent_path(), error);
    if (error || !is_inside(real, real_folder))
        throw Error(ExitCode::invalid_data, plan.path.string() + ": the map '" + object.map.string() +
                                                "' leads out of " + folder.string() +
                                                " through a symbolic link; --follow-links allows it");
    return path;
}

} // namespace spa::tools
