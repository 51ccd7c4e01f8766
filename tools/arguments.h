// SPDX-License-Identifier: Apache-2.0
// Arguments that several verbs share, and how any of them is defined: as text that is parsed here, so that
// each message says what was given and what would be right. Everything throws Error{usage}.
#pragma once

#include "../libspa/core/error.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace spa::tools {

// names: as in CLI11, such as "-o,--output" or "IN". value_name: how help calls the value.
CLI::Option* add_text(CLI::App& app, const std::string& names, const std::string& value_name,
                      const std::string& description, const std::function<void(const std::string&)>& set);

CLI::Option* add_path(CLI::App& app, const std::string& names, const std::string& value_name,
                      const std::string& description, std::filesystem::path& path);

// One of `values`, called by what name(value) returns. set: called with the value that was given.
template <class T>
CLI::Option* add_choice(CLI::App& app, const std::string& option, std::initializer_list<T> values,
                        const std::string& description, std::function<void(T)> set) {
    std::string choices;
    for (const T value : values) choices += (choices.empty() ? "" : "|") + std::string(name(value));
    const auto choose = [=, values = std::vector<T>(values)](const std::string& text) {
        for (const T value : values)
            if (text == name(value)) return set(value);
        std::string message = option + ": '" + text + "' is not one of ";
        for (const T value : values)
            message += (value == values.front() ? "" : ", ") + std::string(name(value));
        throw Error(ExitCode::usage, message);
    };
    return add_text(app, option, choices, description, choose);
}

// A whole number in [lowest, highest]. Throws Error{usage} whose message starts with `option`.
std::uint32_t parse_number(const std::string& option, const std::string& text, std::uint32_t lowest,
                           std::uint32_t highest);

// A number >= 0 with '.' whatever the locale, such as "0.001" or "2e-3". Throws Error{usage} whose message
// starts with `option`.
double parse_measure(const std::string& option, const std::string& text);

// How a verb that reports does it.
enum class ReportFormat : std::uint8_t { text, json };
const char* name(ReportFormat format);
CLI::Option* add_report_format(CLI::App& app, ReportFormat& format);

// description: of the value 0 too. threads: its value is the default.
void add_threads(CLI::App& app, const std::string& description, unsigned& threads);

// Limits::follow_links (import.h) as an option.
void add_follow_links(CLI::App& app, bool& follow_links);

// As every verb prints it: indented by two spaces, ends with a newline. Text that is not UTF-8, such as a
// file name may be, gets replacement characters.
std::string json_text(const nlohmann::ordered_json& json);

} // namespace spa::tools
