// SPDX-License-Identifier: Apache-2.0
// Our own instead of tinyobjloader's, whose parser gives no line numbers, takes "nan" for 0 and reads a map
// option that it does not know as the beginning of the file name.
#include "mtl.h"

#include "text.h"

#include <array>
#include <cmath>

namespace spa::import {
namespace {

struct Context {
    const std::string& name;
    std::size_t line;
    Report& report;

    void warn(const std::string& what) const {
        import::warn(report, name + " line " + std::to_string(line) + ": " + what);
    }
};

std::optional<float> read_number(std::string_view& rest, const Context& context) {
    const std::string_view token = cut_token(rest);
    const auto value = parse_float(token);
    if (value && std::isfinite(*value)) return value;
    context.warn(quote(token) + " is not a number; the statement is ignored.");
    return std::nullopt;
}

std::optional<Vec3f> read_diffuse(std::string_view rest, const Context& context) {
    std::string_view peek = rest;
    const std::string_view first = cut_token(peek);
    if (equal_ignoring_case(first, "spectral") || equal_ignoring_case(first, "xyz")) {
        context.warn("Kd " + std::string(first) + " is not supported; the material is white.");
        return std::nullopt;
    }
    const auto red = read_number(rest, context);
    if (!red) return std::nullopt;
    if (trim(rest).empty())
        return Vec3f{*red, *red, *red}; // "if only r is specified, g and b are equal to r"
    const auto green = read_number(rest, context);
    const auto blue = green ? read_number(rest, context) : std::nullopt;
    if (!blue) return std::nullopt;
    return Vec3f{*red, *green, *blue};
}

std::optional<float> read_dissolve(std::string_view rest, const Context& context) {
    std::string_view peek = rest;
    if (equal_ignoring_case(cut_token(peek), "-halo")) rest = peek;
    return read_number(rest, context);
}

struct MapOption {
    std::string_view name;
    unsigned words; // that follow; for the numeric ones at most this many numbers
    bool numeric;
};

// Of the MTL specification 4.2, "Texture map statements".
constexpr std::array<MapOption, 13> map_options{{{"-s", 3, true},
                                                 {"-o", 3, true},
                                                 {"-t", 3, true},
                                                 {"-mm", 2, true},
                                                 {"-bm", 1, true},
                                                 {"-boost", 1, true},
                                                 {"-texres", 1, true},
                                                 {"-clamp", 1, false},
                                                 {"-blendu", 1, false},
                                                 {"-blendv", 1, false},
                                                 {"-cc", 1, false},
                                                 {"-imfchan", 1, false},
                                                 {"-type", 1, false}}};

std::optional<MtlMap> read_map(std::string_view rest, const Context& context) {
    MtlMap map;
    for (;;) {
        std::string_view after = rest;
        const std::string_view token = cut_token(after);
        const MapOption* option = nullptr;
        for (const MapOption& candidate : map_options) {
            if (equal_ignoring_case(candidate.name, token)) option = &candidate;
        }
        if (option == nullptr) break;
        rest = after;
        std::array<float, 3> numbers{};
        unsigned count = 0;
        std::string_view word;
        for (; count < option->words; ++count) {
            after = rest;
            word = cut_token(after);
            const auto number = option->numeric ? parse_float(word) : std::nullopt;
            if (option->numeric && !number) break;
            numbers[count] = number.value_or(0.0F);
            rest = after;
        }
        if (option->name == "-s" && count > 0) map.scale.x = numbers[0];
        if (option->name == "-s" && count > 1) map.scale.y = numbers[1];
        if (option->name == "-o" && count > 0) map.offset.x = numbers[0];
        if (option->name == "-o" && count > 1) map.offset.y = numbers[1];
        if (option->name == "-clamp") map.clamp = equal_ignoring_case(word, "on");
    }
    map.file = trim(rest);
    if (map.file.empty()) {
        context.warn("a texture map without a file name is ignored.");
        return std::nullopt;
    }
    return map;
}

} // namespace

std::vector<MtlMaterial> parse_mtl(std::string_view text, const std::string& name, Report& report) {
    std::vector<MtlMaterial> materials;
    LineReader lines{text};
    while (auto line = lines.read()) {
        std::string_view rest = *line;
        const std::string_view keyword = cut_token(rest);
        if (keyword.empty() || keyword.front() == '#') continue;
        const Context context{name, lines.line, report};
        const auto is = [&](std::string_view word) { return equal_ignoring_case(keyword, word); };
        if (is("newmtl")) {
            if (materials.size() > max_materials) break;
            materials.emplace_back();
            materials.back().name = trim(rest);
            materials.back().line = lines.line;
            continue;
        }
        if (materials.empty()) continue;
        MtlMaterial& material = materials.back();
        if (is("Kd"))
            material.diffuse = read_diffuse(rest, context);
        else if (is("d"))
            material.dissolve = read_dissolve(rest, context);
        else if (is("Tr"))
            material.transparency = read_dissolve(rest, context);
        else if (is("map_Kd"))
            material.map_diffuse = read_map(rest, context);
        else if (is("map_d"))
            material.map_dissolve = read_map(rest, context);
    }
    return materials;
}

} // namespace spa::import
