// SPDX-License-Identifier: Apache-2.0
#include "batch_config.h"

#include "glob.h"
#include "near_names.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace spa::tools {

namespace {

using Json = nlohmann::json;

struct SettingName {
    std::string name; // "--size"
    bool is_flag = false;
};

std::vector<SettingName> setting_names() {
    CLI::App app;
    app.set_help_flag();
    const std::function<BakeSettings()> owner = define_bake_settings(app);
    std::vector<SettingName> names;
    for (const CLI::Option* option : app.get_options())
        if (!option->get_group().empty())
            names.push_back({option->get_name(), option->get_items_expected() == 0});
    return names;
}

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
    throw Error(ExitCode::invalid_data, where + ": " + what);
}

std::string text_of(const Json& value, const SettingName& setting, const std::string& where) {
    if (setting.is_flag) {
        if (!value.is_boolean()) refuse(where, "is true or false");
        return value.get<bool>() ? "true" : "false";
    }
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_number()) refuse(where, "is a text or a number");
    return value.dump();
}

void check_members(const Json& json, std::initializer_list<const char*> allowed, const std::string& where) {
    if (!json.is_object()) refuse(where, "is not an object");
    for (const auto& [key, value] : json.items())
        if (std::find(allowed.begin(), allowed.end(), key) == allowed.end())
            refuse(where, "there is no member '" + key + "' here" +
                              did_you_mean(key, std::vector<std::string>(allowed.begin(), allowed.end())));
}

} // namespace

GivenSettings parse_given_settings(const Json& json, const std::string& where) {
    if (!json.is_object()) refuse(where, "is an object of options");
    const std::vector<SettingName> known = setting_names();
    GivenSettings given;
    for (const auto& [key, value] : json.items()) {
        std::string name = "--" + key;
        std::replace(name.begin(), name.end(), '_', '-');
        const auto found = std::find_if(known.begin(), known.end(),
                                        [&](const SettingName& setting) { return setting.name == name; });
        if (found == known.end()) {
            std::vector<std::string> names;
            names.reserve(known.size());
            for (const SettingName& setting : known) names.push_back(setting.name.substr(2));
            refuse(where, "there is no option '" + key + "' of a bake" + did_you_mean(name.substr(2), names));
        }
        given[name] = text_of(value, *found, where + "." + key);
    }
    try {
        static_cast<void>(parse_settings(given));
    } catch (const Error& error) {
        refuse(where, error.what());
    }
    return given;
}

BatchConfig read_batch_config(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Error(ExitCode::input_output, path.string() + ": cannot be opened; check the path");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    Json json;
    try {
        json = Json::parse(text);
    } catch (const Json::exception& error) {
        refuse(path.string(), std::string("is not JSON: ") + error.what());
    }
    check_members(json, {"options", "patterns"}, path.string());
    BatchConfig config;
    if (json.contains("options"))
        config.options = parse_given_settings(json["options"], path.string() + ": options");
    if (!json.contains("patterns")) return config;
    const Json& patterns = json["patterns"];
    if (!patterns.is_array()) refuse(path.string() + ": patterns", "is not an array");
    for (std::size_t i = 0; i < patterns.size(); ++i) {
        const std::string where = path.string() + ": patterns[" + std::to_string(i) + "]";
        check_members(patterns[i], {"match", "options"}, where);
        if (!patterns[i].contains("match") || !patterns[i]["match"].is_string() ||
            patterns[i]["match"].get_ref<const std::string&>().empty())
            refuse(where, "has no 'match', the pattern of the assets that it is for");
        if (!patterns[i].contains("options")) refuse(where, "has no 'options'");
        config.by_pattern.emplace_back(patterns[i]["match"].get<std::string>(),
                                       parse_given_settings(patterns[i]["options"], where + ".options"));
    }
    return config;
}

GivenSettings given_settings(const CLI::App& app) {
    GivenSettings given;
    for (const SettingName& setting : setting_names()) {
        const CLI::Option& option = *app.get_option(setting.name);
        if (option.count() > 0) given[setting.name] = setting.is_flag ? "true" : option.results().back();
    }
    return given;
}

BakeSettings parse_settings(const GivenSettings& given) {
    CLI::App app;
    const std::function<BakeSettings()> complete = define_bake_settings(app);
    std::vector<std::string> arguments;
    for (const auto& [name, text] : given) {
        if (text == "false") continue;
        arguments.push_back(text == "true" ? name : name + "=" + text);
    }
    try {
        // CLI11 takes them last first.
        app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    } catch (const CLI::ParseError& error) {
        throw Error(ExitCode::usage, error.what());
    }
    return complete();
}

const BakeSettings& BatchSettings::of(const std::string& name, const GivenSettings& own) {
    GivenSettings merged = command_line_;
    for (auto pattern = config_.by_pattern.rbegin(); pattern != config_.by_pattern.rend(); ++pattern)
        if (glob_matches(pattern->first, name)) merged.insert(pattern->second.begin(), pattern->second.end());
    merged.insert(config_.options.begin(), config_.options.end());
    merged.insert(own.begin(), own.end());
    const auto found = parsed_.find(merged);
    if (found != parsed_.end()) return found->second;
    try {
        const BakeSettings settings = parse_settings(merged);
        return parsed_.emplace(std::move(merged), settings).first->second;
    } catch (const Error& error) {
        throw Error(error.code(), name + ": " + error.what());
    }
}

} // namespace spa::tools
