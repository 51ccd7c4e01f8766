// SPDX-License-Identifier: Apache-2.0
#include "validate_report.h"

#include "ray_report.h"
#include "text.h"

#include <nlohmann/json.hpp>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;
using measure::Distribution;
using measure::Measurement;
using measure::WorstTexel;

Json distribution_json(const Distribution& d) {
    return {{"count", d.count}, {"max", d.max}, {"mean", d.mean}, {"rms", d.rms}, {"p95", d.p95}};
}

Json place_json(const std::optional<WorstTexel>& at) {
    if (!at) return nullptr;
    return {{"part", at->part}, {"layer", at->layer}, {"side", measure::name(at->side)},
            {"x", at->texel.x}, {"y", at->texel.y},   {"value", at->value}};
}

Json coverage_json(const measure::CoverageFigures& c) {
    return {{"share", c.share()},
            {"texels", c.texels},
            {"missing", c.missing},
            {"extra", c.extra},
            {"ties", c.ties}};
}

std::string line(const char* label, const std::string& text) { return pad_right(label, 20) + text + "\n"; }

std::string columns(const char* label, const Distribution& d, const char* unit) {
    std::string text;
    for (const double value : {d.max, d.mean, d.rms, d.p95}) text += pad_right(significant(value, 3), 11);
    return line(label, text + unit);
}

std::string surface_text(const Measurement& m) {
    std::string text = line("", pad_right("max", 11) + pad_right("mean", 11) + pad_right("rms", 11) + "p95");
    text += columns("texel to source", m.texel_distance, "R");
    text += columns("source to map", m.surface_distance, "R");
    text += columns("  not captured", m.star_error, "R   (E_star)");
    text += columns("  captured", m.resolution_error, "R   (E_res)");
    text += columns("depth", m.quantization.error, "R   (E_quant)");
    text += columns("normal", m.normal_angle, "degrees");
    text += columns("colour", m.color_difference, "of 255");
    return text + columns("alpha", m.alpha_difference, "of 255");
}

std::string coverage_text(const measure::CoverageFigures& c) {
    return percent(c.share(), 3) + " of " + std::to_string(c.texels) +
           " texels agree: " + std::to_string(c.missing) + " missing, " + std::to_string(c.extra) +
           " extra; " + std::to_string(c.ties) + " on edges";
}

std::string source_text(const SourceFacts& source) {
    if (!source.differing)
        return source.path.string() + "; the metadata does not say what the map was baked from";
    if (source.differing->empty()) return source.path.string() + ", the files the map was baked from";
    std::string text = source.path.string() + ", NOT what the map was baked from:";
    for (const std::string& name : *source.differing) text += " " + name;
    return text;
}

} // namespace

std::string Judged::sentence() const {
    std::string text = option + " " + significant(limit, 6) +
                       (option.starts_with("--min") ? " is not reached: " : " is exceeded: ") +
                       significant(value, 6);
    if (at) text += " at " + measure::place(*at);
    return text;
}

Json figures_json(const Measurement& m) {
    return {
        {"source_radius", m.source_radius},
        {"texel_distance", distribution_json(m.texel_distance)},
        {"surface_distance", distribution_json(m.surface_distance)},
        {"hausdorff", m.hausdorff()},
        {"captured_area", m.captured_area},
        {"normal_angle", distribution_json(m.normal_angle)},
        {"color_difference", distribution_json(m.color_difference)},
        {"alpha_difference", distribution_json(m.alpha_difference)},
        {"coverage", coverage_json(m.coverage)},
        {"quantization",
         {{"bound", m.quantization.bound},
          {"holds", m.quantization.holds()},
          {"above", m.quantization.above}}},
        {"shell_ends", m.shell_ends},
        {"normals_above", m.normals_above},
        {"error_parts",
         {{"star", distribution_json(m.star_error)},
          {"resolution", distribution_json(m.resolution_error)},
          {"quantization", distribution_json(m.quantization.error)}}},
        {"rays", m.rays ? rays_json(*m.rays) : Json(nullptr)},
    };
}

Json validate_json(const MapFile& file, const Validation& v) {
    Json source = nullptr;
    if (v.source) {
        source = {{"path", v.source->path.string()},
                  {"matches", v.source->differing ? Json(v.source->differing->empty()) : Json(nullptr)},
                  {"differing", v.source->differing.value_or(std::vector<std::string>{})}};
    }
    Json worst = nullptr;
    Json parts = Json::array();
    if (v.measurement) {
        const Measurement& whole = v.measurement->whole;
        worst = {{"texel_distance", place_json(whole.worst_distance)},
                 {"depth", place_json(whole.worst_depth)},
                 {"normal_angle", place_json(whole.worst_normal)},
                 {"color_difference", place_json(whole.worst_color)},
                 {"alpha_difference", place_json(whole.worst_alpha)}};
        for (const Measurement& part : v.measurement->parts) parts.push_back(figures_json(part));
    }
    Json findings = Json::array();
    for (const measure::Finding& finding : v.findings)
        findings.push_back(
            {{"kind", finding.kind}, {"message", finding.message}, {"at", place_json(finding.at)}});
    Json thresholds = Json::array();
    bool met = true;
    for (const Judged& judged : v.thresholds) {
        thresholds.push_back({{"option", judged.option},
                              {"limit", judged.limit},
                              {"value", judged.value},
                              {"met", judged.met}});
        met = met && judged.met;
    }
    return {
        {"file", file.name},
        {"valid", true},
        {"source", source},
        {"figures", v.measurement ? figures_json(v.measurement->whole) : Json(nullptr)},
        {"parts", parts},
        {"worst", worst},
        {"findings", findings},
        {"thresholds", thresholds},
        {"thresholds_met", met},
    };
}

std::string validate_text(const MapFile& file, const Validation& v) {
    std::string text = file.name + ": valid container\n";
    if (!v.source) return text + line("source", "none found beside it: not measured (--source)");
    text += line("source", source_text(*v.source));
    const Measurement& m = v.measurement->whole;
    if (file.map().parts.size() > 1)
        text += line("parts",
                     std::to_string(file.map().parts.size()) + ", together; R is the radius of the whole");
    text += surface_text(m);
    text += line("hausdorff", significant(m.hausdorff(), 3) + " R");
    text += line("captured", percent(m.captured_area, 2) + " of the source's area");
    text += line("coverage", coverage_text(m.coverage));
    text += line("quantization", "bound " + significant(m.quantization.bound, 3) + " R" +
                                     (m.quantization.holds()
                                          ? " holds"
                                          : ": " + std::to_string(m.quantization.above) + " texels above"));
    if (m.shell_ends > 0)
        text += line("thin shells", std::to_string(m.shell_ends) + " inner ends, not measured");
    if (m.rays) text += rays_text(*m.rays, 20);
    for (const measure::Finding& finding : v.findings) text += line("finding", finding.message);
    for (const Judged& judged : v.thresholds)
        text += line("threshold", judged.met ? judged.option + " " + significant(judged.limit, 6) +
                                                   " is met (" + significant(judged.value, 6) + ")"
                                             : judged.sentence());
    return text;
}

} // namespace spa::tools
