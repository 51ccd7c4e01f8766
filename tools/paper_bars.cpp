// SPDX-License-Identifier: Apache-2.0
#include "paper_report.h"

namespace spa::tools {
namespace {

constexpr std::uint32_t judged_samples = 256;

const PaperCell* cell_of(const PaperTables& tables, int level, const char* method) {
    if (const PaperCell* cell = tables.find(level, method, judged_samples)) return cell;
    const PaperCell* last = nullptr; // the most samples that there are
    for (const PaperCell& cell : tables.cells)
        if (cell.level == level && cell.method == method) last = &cell;
    return last;
}

double rays_a_second(const PaperCell& cell) { return double(cell.secondary_rays) / cell.secondary_seconds; }

const PaperCosts* costs_of(const PaperTables& tables, int level) {
    for (const PaperCosts& costs : tables.costs)
        if (costs.level == level) return &costs;
    return nullptr;
}

void rates(const PaperTables& tables, int level, double limit, std::vector<PaperBar>& bars) {
    const PaperCell* const map = cell_of(tables, level, "projective");
    const PaperCell* const triangles = cell_of(tables, level, triangles_name);
    if (map == nullptr || triangles == nullptr) return;
    bars.push_back({"secondary rays a second, projective over triangles, level " + std::to_string(level),
                    rays_a_second(*map) / rays_a_second(*triangles), limit, true});
}

void against_lod(const PaperTables& tables, int level, std::vector<PaperBar>& bars) {
    const PaperCell* const map = cell_of(tables, level, "projective");
    const PaperCosts* const costs = costs_of(tables, level);
    if (map == nullptr || costs == nullptr) return;
    const auto add = [&](const char* what, const std::optional<PaperCosts::LodRates>& lod) {
        if (lod)
            bars.push_back(
                {std::string("secondary rays a second, projective over simplified mesh of equal ") + what +
                     " |dt|, level " + std::to_string(level),
                 rays_a_second(*map) / lod->rays_a_second, 2, true});
    };
    add("mean", costs->lod_by_mean);
    add("median", costs->lod_by_median);
}

void errors(const PaperTables& tables, std::vector<PaperBar>& bars) {
    // The worst level.
    double worst = 0;
    for (const PaperCosts& costs : tables.costs) {
        const PaperCell* const map = cell_of(tables, costs.level, "projective");
        const PaperCell* const fan = cell_of(tables, costs.level, "fan 10");
        if (map == nullptr || fan == nullptr || fan->relmse_equal_seeds == 0) continue;
        worst = std::max(worst, map->relmse_equal_seeds / fan->relmse_equal_seeds);
    }
    if (worst > 0)
        bars.push_back(
            {"relMSE of the indirect light, projective over fan 10, the worst level", worst, 0.1, false});
}

} // namespace

std::vector<PaperBar> paper_bars(const PaperTables& tables) {
    std::vector<PaperBar> bars;
    rates(tables, 6, 10, bars);
    rates(tables, 2, 2, bars);
    against_lod(tables, 6, bars);
    if (const PaperCosts* const costs = costs_of(tables, 6)) {
        const double map = double(costs->map_bytes + costs->map_structure_bytes);
        bars.push_back({"memory, triangles over map, level 6",
                        double(costs->triangle_bytes + costs->triangle_structure_bytes) / map, 50, true});
        bars.push_back({"acceleration structure of triangles over map and structure, level 6",
                        double(costs->triangle_structure_bytes) / map, 50, true});
        bars.push_back({"from the file to the first frame, map over triangles, level 6",
                        costs->map_first_frame / costs->triangle_first_frame, 0.1, false});
    }
    errors(tables, bars);
    return bars;
}

} // namespace spa::tools
