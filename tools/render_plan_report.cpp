// SPDX-License-Identifier: Apache-2.0
#include "render_plan_report.h"

#include "render_compare.h"
#include "text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <utility>
#include <vector>

namespace spa::tools {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t column_width = 14;
constexpr std::size_t row_label_width = 26;

double frame_seconds(const render::FrameTimes& times) { return times.primary + times.secondary; }

double rays_per_second(const render::FrameTimes& times) {
    const double seconds = frame_seconds(times);
    const std::uint64_t rays = times.primary_rays + times.secondary_rays + times.shadow_rays;
    return seconds > 0 ? double(rays) / seconds : 0;
}

std::size_t count(const Plan& plan, PlanDecision decision) {
    return std::size_t(std::count_if(plan.objects.begin(), plan.objects.end(),
                                     [&](const PlanObject& object) { return object.decision == decision; }));
}

Json errors_json(const std::optional<measure::ImageErrors>& errors) {
    return errors ? image_figures_json(*errors) : Json(nullptr);
}

Json variant_json(const PlanVariant& variant) {
    const NeededMemory memory = needed_memory(variant.memory);
    return {{"indirect", errors_json(variant.to_triangles)},
            {"indirect_to_reference", errors_json(variant.to_reference)},
            {"frame_seconds", frame_seconds(variant.times)},
            {"rays_per_second", rays_per_second(variant.times)},
            {"maps", variant.maps},
            {"file_bytes", variant.file_bytes},
            {"memory",
             {{"by_map_rays", memory.by_map_rays},
              {"by_triangle_rays", memory.by_triangle_rays},
              {"resident", memory.resident}}}};
}

Json variant_json(const std::optional<PlanVariant>& variant) {
    return variant ? variant_json(*variant) : Json(nullptr);
}

using Cell = std::function<std::string(const PlanVariant&)>;

std::string figure_text(const std::optional<measure::ImageErrors>& errors, const char* name) {
    if (!errors) return "-";
    for (const ImageFigure& figure : image_figures())
        if (std::string_view(figure.name) == name) {
            const std::optional<double> value = figure.value(*errors);
            return value ? significant(*value, 3) : "none";
        }
    return "-";
}

class Table {
public:
    Table(const PlanFacts& facts, std::size_t label_width) : indent_(label_width, ' ') {
        if (facts.triangles) columns_.emplace_back("triangles", &*facts.triangles);
        if (facts.one_size) columns_.emplace_back("one size", &*facts.one_size);
        columns_.emplace_back("plan", &facts.plan);
        text_ = indent_ + std::string(row_label_width, ' ');
        for (const auto& [title, variant] : columns_) text_ += pad_left(title, column_width);
        text_ += "\n";
    }
    void row(const std::string& label, const Cell& cell) {
        text_ += indent_ + pad_right(label, row_label_width);
        for (const auto& [title, variant] : columns_) text_ += pad_left(cell(*variant), column_width);
        text_ += "\n";
    }
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    std::string indent_, text_;
    std::vector<std::pair<std::string, const PlanVariant*>> columns_;
};

std::string table_text(const PlanFacts& facts, std::size_t label_width) {
    Table table(facts, label_width);
    if (facts.triangles) {
        table.row("indirect light, relMSE",
                  [](const PlanVariant& v) { return figure_text(v.to_triangles, "relmse"); });
        table.row("  PSNR, dB", [](const PlanVariant& v) { return figure_text(v.to_triangles, "psnr"); });
    }
    if (facts.plan.to_reference)
        table.row("  relMSE to --compare",
                  [](const PlanVariant& v) { return figure_text(v.to_reference, "relmse"); });
    table.row("seconds a frame", [](const PlanVariant& v) { return significant(frame_seconds(v.times), 3); });
    table.row("million rays a second",
              [](const PlanVariant& v) { return significant(rays_per_second(v.times) / 1e6, 3); });
    table.row("maps", [](const PlanVariant& v) { return std::to_string(v.maps); });
    table.row("files of maps", [](const PlanVariant& v) { return byte_count(v.file_bytes); });
    const auto memory = [](std::uint64_t NeededMemory::*member) {
        return [member](const PlanVariant& v) { return byte_count(needed_memory(v.memory).*member); };
    };
    table.row("memory: rays meet maps", memory(&NeededMemory::by_map_rays));
    table.row("  rays meet triangles", memory(&NeededMemory::by_triangle_rays));
    table.row("  all on the device", memory(&NeededMemory::resident));
    return table.text();
}

} // namespace

NeededMemory needed_memory(const render::SceneMemory& memory) {
    const std::uint64_t kept = memory.triangles + memory.triangle_structures + memory.top_level;
    const std::uint64_t replaced = memory.replaced_triangles + memory.replaced_structures;
    const std::uint64_t maps = memory.maps + memory.map_structures;
    return {kept + maps, kept + replaced, kept + replaced + maps};
}

Json plan_json(const PlanFacts& facts) {
    const Plan& plan = facts.placed.plan;
    return {{"path", plan.path.string()},
            {"objects",
             {{"map", count(plan, PlanDecision::map)},
              {"triangles", count(plan, PlanDecision::triangles)},
              {"drop", count(plan, PlanDecision::drop)}}},
            {"one_size", plan.one_size},
            {"not_baked", facts.not_baked},
            {"bake_seconds", facts.bake_seconds},
            {"dropped_triangles", facts.placed.dropped_triangles},
            {"unique_triangles", facts.placed.unique_triangles},
            {"variants",
             {{"triangles", variant_json(facts.triangles)},
              {"one_size", variant_json(facts.one_size)},
              {"plan", variant_json(facts.plan)}}}};
}

Picture plan_sheet(const PlanFacts& facts, std::uint32_t width, std::uint32_t height, double exposure) {
    constexpr std::uint32_t widest_cell = 640;
    SheetScale scale(3);
    scale.cell_width = std::clamp(width, scale.cell_width, widest_cell);
    const auto variants = {
        std::pair{"triangles", &*facts.triangles}, {"one size", &*facts.one_size}, {"plan", &facts.plan}};
    SheetRow pictures{"picture", {}}, indirect{"indirect light", {}},
        differences{"indirect light: difference to triangles", {}};
    for (const auto& [label, variant] : variants) {
        const std::string error = figure_text(variant->to_triangles, "relmse");
        pictures.cells.push_back(
            make_cell(label, tone_map(width, height, variant->picture, exposure), scale));
        indirect.cells.push_back(
            make_cell(label, tone_map(width, height, variant->indirect, exposure), scale));
        differences.cells.push_back(make_cell(
            std::string(label) + (variant->to_triangles ? ", relMSE " + error : ""),
            light_difference(width, height, variant->indirect, facts.triangles->indirect, exposure), scale));
    }
    return lay_out_sheet(facts.placed.plan.path.filename().string(), light_difference_legend(),
                         {pictures, indirect, differences}, scale);
}

std::string plan_text(const PlanFacts& facts, std::size_t label_width) {
    const Plan& plan = facts.placed.plan;
    const std::string indent(label_width, ' ');
    std::string text = pad_right("plan", label_width) + plan.path.string() + ": of " +
                       std::to_string(plan.objects.size()) + " objects " +
                       std::to_string(count(plan, PlanDecision::map)) + " are maps, " +
                       std::to_string(count(plan, PlanDecision::triangles)) + " triangles, " +
                       std::to_string(count(plan, PlanDecision::drop)) + " dropped\n";
    if (facts.one_size) {
        text += indent + "one size is " + std::to_string(plan.one_size) + ", baked in " +
                significant(facts.bake_seconds, 3) + " s; " + std::to_string(facts.placed.unique_triangles) +
                " triangles are no repetition of a mesh\n";
        for (const std::string& sentence : facts.not_baked) text += indent + "not baked: " + sentence + "\n";
    }
    return text + table_text(facts, label_width);
}

} // namespace spa::tools
