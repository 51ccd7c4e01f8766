// SPDX-License-Identifier: Apache-2.0
#include "report_map.h"

#include "bake_settings.h"
#include "coarse_part.h"
#include "failure.h"
#include "map_file.h"
#include "map_source.h"
#include "report_plan.h"
#include "sheet.h"
#include "text.h"
#include "thumbnail.h"

#include "../formats/import/import.h"
#include "../libspa/measure/map_rays.h"
#include "../libspa/measure/object_speed.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace spa::tools {

namespace {

using Json = PickedJson;

constexpr std::uint32_t thumbnail_size = 96; // pixels; twice what the page shows
constexpr std::uint32_t sheet_cells = 96;    // of the images on a sheet
constexpr std::size_t most_sheet_parts = 4, most_sheet_layers = 4;

// ---- What the file holds ----

Json sections_json(const container::File& file) {
    Json sections = Json::array();
    for (const container::SectionEntry& entry : file.sections()) {
        const std::string type = container::type_name(entry.type);
        auto found = std::find_if(sections.begin(), sections.end(),
                                  [&](const Json& section) { return section["type"] == type; });
        if (found == sections.end()) {
            sections.push_back({{"type", type}, {"count", 0}, {"stored_bytes", 0}, {"raw_bytes", 0}});
            found = sections.end() - 1;
        }
        (*found)["count"] = (*found)["count"].get<std::uint64_t>() + 1;
        (*found)["stored_bytes"] = (*found)["stored_bytes"].get<std::uint64_t>() + entry.stored_length;
        (*found)["raw_bytes"] = (*found)["raw_bytes"].get<std::uint64_t>() + entry.raw_length;
    }
    return sections;
}

Json image_json(const Part& part, const ImageView& image) {
    if (image.empty()) return nullptr;
    return {{"size", size_text({part.mapping, image.width, image.height})}, {"format", name(image.format)}};
}

// Of the first part, which a report's table shows; parts are baked alike.
Json shape_json(const SphericalMap& map) {
    const Part& part = map.parts.front();
    const Surface& outer = part.layers.front().outer;
    std::uint64_t samples = 0;
    std::size_t layers = 0;
    for (const Part& each : map.parts) {
        layers = std::max(layers, each.layers.size());
        for (const Layer& layer : each.layers)
            for (const Surface* s : {&layer.outer, &layer.inner})
                samples += std::uint64_t(s->depth.width) * s->depth.height;
    }
    return {{"parts", map.parts.size()},
            {"mapping", name(part.mapping)},
            {"layers", layers},
            {"samples", samples},
            {"depth", image_json(part, outer.depth)},
            {"color", image_json(part, outer.color)},
            {"normals", image_json(part, outer.normal)}};
}

// ---- Errors: in units of R, shares of rays and of area ----

Json errors_of_figures(const Json& figures) {
    const Json& rays = pick(figures, "rays");
    const Json captured = pick_measure(figures, "captured_area", 1);
    return {{"from", "file"},
            {"false_hits", pick_measure(pick(rays, "false_hits"), "share", 1)},
            {"missed_hits", pick_measure(pick(rays, "missed_hits"), "share", 1)},
            {"mean_distance", pick_measure(pick(rays, "distance"), "mean")},
            {"p95_distance", pick_measure(pick(rays, "distance"), "p95")},
            {"hausdorff", pick_measure(figures, "hausdorff")},
            {"not_captured", captured.is_null() ? captured : Json(1 - captured.get<double>())}};
}

// The worst of what the parts' records say; null if one says nothing.
Json errors_of_parts(const SphericalMap& map) {
    double hausdorff = 0, not_captured = 0;
    for (const Part& part : map.parts) {
        const ErrorFigures& e = part.errors;
        hausdorff = std::isnan(hausdorff) || std::isnan(e.texel_distance_max)
                        ? std::nan("")
                        : std::max({hausdorff, double(e.texel_distance_max), double(e.surface_distance_max)});
        not_captured =
            std::isnan(e.captured_area) ? std::nan("") : std::max(not_captured, 1 - double(e.captured_area));
    }
    if (!std::isfinite(hausdorff)) return nullptr;
    return {{"from", "file"},
            {"false_hits", nullptr},
            {"missed_hits", nullptr},
            {"mean_distance", nullptr},
            {"p95_distance", nullptr},
            {"hausdorff", hausdorff},
            {"not_captured", std::isfinite(not_captured) ? Json(not_captured) : Json(nullptr)}};
}

Json errors_of_rays(const measure::RayFigures& figures) {
    return {{"from", "source"},
            {"false_hits", figures.false_hits()},
            {"missed_hits", figures.missed_hits()},
            {"mean_distance", figures.errors.distance.mean},
            {"p95_distance", figures.errors.distance.p95},
            {"hausdorff", nullptr},
            {"not_captured", nullptr}};
}

// ---- The source ----

// Beside the map, else below `folder` where the map lies below its own, else in `folder`; empty: not found.
std::filesystem::path find_source(const MapFile& map, const ReportFile& file,
                                  const std::filesystem::path& folder) {
    std::filesystem::path path = source_beside(map);
    if (!path.empty() || folder.empty()) return path;
    path = source_in(folder / std::filesystem::path(file.name).parent_path(), map);
    return path.empty() ? source_in(folder, map) : path;
}

Json source_json(const Json& metadata, const std::filesystem::path& path) {
    const Json& source = pick(metadata, "source");
    if (!source.is_object()) return nullptr;
    return {{"name", pick_text(source, "name")},
            {"bytes", pick_count(source, "bytes")},
            {"triangles", pick_count(source, "triangles")},
            {"path", path.empty() ? Json(nullptr) : Json(path.string())},
            {"matches", nullptr}};
}

Json speed_json(const measure::RaySpeed& speed) { return {{"ns", speed.ns}, {"bytes", speed.bytes}}; }

class Reporter {
public:
    Reporter(const ReportFile& file, const MapReportOptions& options, const std::function<bool()>& go_on)
        : file_(file), options_(options), go_on_(go_on) {}

    MapReport run() {
        Json& json = report_.json;
        json = {{"name", file_.name}, {"path", file_.path.string()}, {"error", nullptr}};
        for (const char* key : {"version", "bytes", "shape", "sections", "source", "settings", "warnings",
                                "errors", "speed", "search"})
            json[key] = nullptr;
        json["warnings"] = Json::array();
        try {
            const MapFile map = open_map(file_.path.string());
            describe(map);
        } catch (const bake::Cancelled&) {
            throw;
        } catch (...) {
            const Failure failure = current_failure();
            json["error"] = failure.message;
            report_.failure = failure.code;
        }
        return std::move(report_);
    }

private:
    void warn(const std::string& message) { report_.json["warnings"].push_back(message); }

    void step() const {
        if (!go_on_()) throw bake::Cancelled{};
    }

    void describe(const MapFile& map) {
        Json& json = report_.json;
        const container::Version version = map.file.version();
        json["version"] = std::to_string(version.major) + "." + std::to_string(version.minor);
        json["bytes"] = map.file.length();
        json["shape"] = shape_json(map.map());
        json["sections"] = sections_json(map.file);
        const Json metadata = parse_metadata(map.map());
        json["settings"] = pick_settings(metadata, "options");
        json["warnings"] = pick_texts(pick(metadata, "report"), "warnings", 50);
        json["search"] = search_json(metadata);
        json["errors"] = pick(metadata, "figures").is_object() ? errors_of_figures(metadata["figures"])
                                                               : errors_of_parts(map.map());
        const std::filesystem::path source = find_source(map, file_, options_.source_folder);
        json["source"] = source_json(metadata, source);
        step();
        if (options_.rays > 0) measure(map, source);
        if (options_.pictures) draw(map.map());
    }

    void measure(const MapFile& map, const std::filesystem::path& source) {
        Json& json = report_.json;
        const measure::SpeedOptions speed{.rays = options_.rays};
        json["speed"] = {{"rays", options_.rays}, {"map", nullptr}, {"triangles", nullptr}};
        try {
            json["speed"]["map"] = speed_json(measure::map_speed(map.map(), speed));
        } catch (const Error& error) {
            warn(std::string("not timed: ") + error.what());
        }
        step();
        if (source.empty()) return;
        try {
            const import::Result read = import::read_model(source, {.follow_links = options_.follow_links});
            const auto differing = differing_files(map, read.report);
            const bool matches = differing && differing->empty();
            json["source"]["matches"] = matches;
            if (!matches) return warn(source.filename().string() + " is not what this was baked from");
            step();
            json["speed"]["triangles"] = speed_json(measure::triangle_speed(read.model, map.map(), speed));
            step();
            if (json["errors"].is_null()) measure_rays(read.model, map.map());
        } catch (const bake::Cancelled&) {
            throw;
        } catch (...) {
            warn("the source was not measured: " + current_failure().message);
        }
    }

    void measure_rays(const Model& model, const SphericalMap& map) {
        if (map.parts.size() != 1 || map.parts.front().mapping != Mapping::octahedral) return;
        measure::RayOptions options;
        options.rays = options_.rays;
        options.star_cells = 32; // of a figure that is not shown
        report_.json["errors"] = errors_of_rays(
            measure::measure_rays(model, map.parts.front(), options, [this](double) { return go_on_(); }));
    }

    void draw(const SphericalMap& map) {
        report_.pictures.thumbnail = encode_png(thumbnail(map, thumbnail_size));
        if (!options_.sheets) return;
        std::vector<CoarsePart> coarse;
        SphericalMap small;
        for (const Part& part : map.parts) {
            if (coarse.size() == most_sheet_parts) break;
            coarse.push_back(coarse_part(part, sheet_cells));
            Part& last = small.parts.emplace_back(coarse.back().part);
            last.layers.resize(std::min(last.layers.size(), most_sheet_layers));
        }
        report_.pictures.sheet = encode_png(contact_sheet(small, file_.path.filename().string()));
    }

    const ReportFile& file_;
    const MapReportOptions& options_;
    const std::function<bool()>& go_on_;
    MapReport report_;
};

} // namespace

MapReport report_map(const ReportFile& file, const MapReportOptions& options,
                     const std::function<bool()>& go_on) {
    return Reporter(file, options, go_on).run();
}

} // namespace spa::tools
