// SPDX-License-Identifier: Apache-2.0
#include "inspect_report.h"

#include "bake_arguments.h"
#include "surface_view.h"
#include "text.h"

#include "../libspa/core/cell_triangles.h"
#include "../libspa/core/folds.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;
using container::SectionEntry;

double ratio(std::uint64_t raw, std::uint64_t stored) {
    return stored == 0 ? 1 : double(raw) / double(stored);
}

using Sections = std::span<const SectionEntry>;

std::uint64_t raw_bytes(Sections sections) {
    std::uint64_t sum = 0;
    for (const SectionEntry& section : sections) sum += section.raw_length;
    return sum;
}

// Of other sections part has no meaning, or none that is known in the file's version.
bool has_part(const SectionEntry& section) {
    return container::is_image(section.type) || section.type == container::type_mixed ||
           section.type == container::type_fold || section.type == container::type_bind;
}

const char* side_name(const SectionEntry& section) {
    return section.side == std::uint16_t(container::Side::inner) ? "inner" : "outer";
}

Json section_json(const SectionEntry& section) {
    Json json = {{"type", container::type_name(section.type)}};
    if (has_part(section)) json["part"] = section.part;
    if (container::is_image(section.type)) {
        json["layer"] = section.layer;
        json["side"] = side_name(section);
        json["format"] = name(section.format);
        json["width"] = section.width;
        json["height"] = section.height;
    }
    json["scheme"] = name(section.scheme);
    json["offset"] = section.offset;
    json["stored_bytes"] = section.stored_length;
    json["raw_bytes"] = section.raw_length;
    json["ratio"] = ratio(section.raw_length, section.stored_length);
    return json;
}

Json image_json(const ImageView& image) {
    if (image.empty()) return nullptr;
    return {{"format", name(image.format)},
            {"width", image.width},
            {"height", image.height},
            {"bytes", image.bytes.size()}};
}

Json surface_json(const Surface& surface, Mapping mapping) {
    if (surface.empty()) return nullptr;
    const DepthStatistics depth = depth_statistics(surface.depth, mapping);
    return {{"coverage", depth.coverage},
            {"depth_min", depth.min},
            {"depth_max", depth.max},
            {"depth_histogram", depth.histogram},
            {"color", image_json(surface.color)},
            {"depth", image_json(surface.depth)},
            {"normals", image_json(surface.normal)}};
}

Json vector_json(Vec3d v) { return Json::array({v.x, v.y, v.z}); }

std::size_t fold_count(const Part& part) { return part.folds.size() / fold_record_bytes; }

Json part_json(const Part& part) {
    Json errors = Json::object();
    for (const ErrorFigureField& figure : error_figure_fields)
        if (const float value = part.errors.*figure.value; !std::isnan(value)) errors[figure.name] = value;
    Json layers = Json::array();
    for (const Layer& layer : part.layers)
        layers.push_back(Json{{"outer", surface_json(layer.outer, part.mapping)},
                              {"inner", surface_json(layer.inner, part.mapping)}});
    const ImageView& depth = part.layers.front().outer.depth;
    return {
        {"center", vector_json(part.center)},
        {"radius", part.radius},
        {"frame", Json::array({vector_json(part.frame.row[0]), vector_json(part.frame.row[1]),
                               vector_json(part.frame.row[2])})},
        {"mapping", name(part.mapping)},
        {"size", size_text({part.mapping, depth.width, depth.height})},
        {"node", part.node},
        {"joint", part.joint},
        {"center_inside", part.center_inside},
        {"mixed_triangles", part.mixed.empty() ? Json(nullptr) : Json(mixed_share(part.mixed))},
        {"fold_records", part.folds.empty() ? Json(nullptr) : Json(fold_count(part))},
        {"errors", errors},
        {"layers", layers},
    };
}

std::string version_text(container::Version version) {
    return std::to_string(version.major) + "." + std::to_string(version.minor);
}

std::string vector_text(Vec3d v) {
    return "(" + fixed(v.x, 6) + ", " + fixed(v.y, 6) + ", " + fixed(v.z, 6) + ")";
}

constexpr std::size_t label_width = 12;

std::string line(const char* label, const std::string& text) {
    return pad_right(label, label_width) + text + "\n";
}

// One character a bin; its height tells the share in relation to the fullest bin.
std::string bar_graph(const DepthStatistics& depth) {
    constexpr const char* blocks[] = {" ",      "\u2581", "\u2582", "\u2583", "\u2584",
                                      "\u2585", "\u2586", "\u2587", "\u2588"};
    double highest = 0;
    for (const double bin : depth.histogram) highest = std::max(highest, bin);
    std::string graph;
    for (const double bin : depth.histogram)
        graph += blocks[highest > 0 ? std::size_t(std::ceil(bin / highest * 8)) : 0];
    return graph;
}

std::string surface_text(const Surface& surface, Mapping mapping) {
    const DepthStatistics depth = depth_statistics(surface.depth, mapping);
    return "coverage " + pad_left(percent(depth.coverage), 7) + "  depth 0 |" + bar_graph(depth) +
           "| 1  from " + fixed(double(depth.min), 4) + " to " + fixed(double(depth.max), 4) + "\n";
}

std::string errors_text(const ErrorFigures& errors) {
    std::string text;
    for (const ErrorFigureField& figure : error_figure_fields)
        if (const float value = errors.*figure.value; !std::isnan(value))
            text += (text.empty() ? "" : "\n" + pad_right("", label_width)) + pad_right(figure.name, 23) +
                    significant(double(value), 3);
    return text.empty() ? "not measured" : text;
}

std::string part_text(const Part& part, std::size_t index) {
    const ImageView& depth = part.layers.front().outer.depth;
    std::string text = "\npart " + std::to_string(index) + "\n";
    text +=
        line("  mapping", std::string(name(part.mapping)) + " " +
                              size_text({part.mapping, depth.width, depth.height}) + ", " +
                              std::to_string(depth.width) + "x" + std::to_string(depth.height) + " samples");
    text += line("  centre", vector_text(part.center) + (part.center_inside ? ", inside the solid" : ""));
    text += line("  radius", fixed(part.radius, 6));
    if (part.frame == Mat3{}) {
        text += line("  frame", "object space");
    } else {
        text += line("  frame", vector_text(part.frame.row[0]));
        text += line("", vector_text(part.frame.row[1]));
        text += line("", vector_text(part.frame.row[2]));
    }
    if (part.node >= 0) text += line("  node", std::to_string(part.node));
    if (part.joint >= 0) text += line("  joint", std::to_string(part.joint));
    if (!part.mixed.empty())
        text += line("  mixed", percent(mixed_share(part.mixed)) + " of the triangles between samples");
    if (!part.folds.empty())
        text += line("  folds",
                     std::to_string(fold_count(part)) + " records of surfaces that end between samples");
    text += line("  errors", errors_text(part.errors));
    for (std::size_t i = 0; i < part.layers.size(); ++i) {
        const Layer& layer = part.layers[i];
        const std::string label = "  layer " + std::to_string(i) + " ";
        text += label + "outer  " + surface_text(layer.outer, part.mapping);
        text +=
            label + "inner  " +
            (layer.inner.empty() ? "none: solid to the centre\n" : surface_text(layer.inner, part.mapping));
    }
    return text;
}

std::string row(const std::array<std::string, 7>& cells) {
    return "  " + pad_right(cells[0], 6) + pad_right(cells[1], 22) + pad_right(cells[2], 16) +
           pad_right(cells[3], 14) + pad_left(cells[4], 10) + pad_left(cells[5], 10) + pad_left(cells[6], 8) +
           "\n";
}

std::string ratio_text(std::uint64_t raw, std::uint64_t stored) { return fixed(ratio(raw, stored), 2) + "x"; }

std::string place_text(const SectionEntry& section) {
    if (!has_part(section)) return "";
    std::string text = "part " + std::to_string(section.part);
    if (container::is_image(section.type))
        text += " layer " + std::to_string(section.layer) + " " + side_name(section);
    return text;
}

std::string sections_text(Sections sections) {
    std::string text = "\nsections\n" + row({"type", "of", "image", "scheme", "stored", "raw", "ratio"});
    std::uint64_t stored = 0;
    for (const SectionEntry& section : sections) {
        const bool image = container::is_image(section.type);
        stored += section.stored_length;
        text +=
            row({container::type_name(section.type), place_text(section),
                 image ? std::to_string(section.width) + "x" + std::to_string(section.height) + " " +
                             name(section.format)
                       : "",
                 name(section.scheme), std::to_string(section.stored_length),
                 std::to_string(section.raw_length), ratio_text(section.raw_length, section.stored_length)});
    }
    const std::uint64_t raw = raw_bytes(sections);
    return text +
           row({"total", "", "", "", std::to_string(stored), std::to_string(raw), ratio_text(raw, stored)});
}

// Provenance: one line a value; nested objects with their names joined, as in "options.size".
void metadata_lines(const Json& json, const std::string& prefix, std::string& text) {
    for (const auto& [key, value] : json.items()) {
        const std::string path = prefix.empty() ? key : prefix + "." + key;
        if (value.is_object())
            metadata_lines(value, path, text);
        else if (!value.is_array() || !value.empty())
            text += "  " + pad_right(path, 28) + " " +
                    (value.is_string() ? value.get<std::string>()
                                       : value.dump(-1, ' ', false, Json::error_handler_t::replace)) +
                    "\n";
    }
}

} // namespace

Json sections_json(Sections sections) {
    Json json = Json::array();
    for (const SectionEntry& section : sections) json.push_back(section_json(section));
    return json;
}

Json inspect_json(const MapFile& file) {
    const Sections sections = file.file.sections();
    Json parts = Json::array();
    for (const Part& part : file.map().parts) parts.push_back(part_json(part));
    const std::uint64_t raw = raw_bytes(sections);
    return {
        {"file", file.name},
        {"version", version_text(file.file.version())},
        {"bytes", file.file.length()},
        {"raw_bytes", raw},
        {"ratio", ratio(raw, file.file.length())},
        {"parts", parts},
        {"sections", sections_json(sections)},
        {"metadata", parse_metadata(file.map())},
    };
}

std::string inspect_text(const MapFile& file) {
    const std::vector<Part>& parts = file.map().parts;
    std::string text = file.name + ": spherical map, version " + version_text(file.file.version()) + ", " +
                       std::to_string(parts.size()) + (parts.size() == 1 ? " part, " : " parts, ") +
                       std::to_string(file.file.length()) + " bytes\n";
    for (std::size_t i = 0; i < parts.size(); ++i) text += part_text(parts[i], i);
    text += sections_text(file.file.sections()) + "\nmetadata\n";
    const Json json = parse_metadata(file.map());
    if (json.is_null())
        text += "  none\n";
    else
        metadata_lines(json, "", text);
    return text;
}

} // namespace spa::tools
