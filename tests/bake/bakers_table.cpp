// SPDX-License-Identifier: Apache-2.0
// Prints how far the radial and the orbit baker agree on the assets named on the command line: one line for
// each asset and number of layers, exit code 6 if one misses the bar. tools/compare_bakers.sh runs it over a
// folder.
#include "../../formats/import/import.h"
#include "../../libspa/bake/bake.h"
#include "../../libspa/core/error.h"
#include "../../libspa/measure/compare.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>

namespace {

using namespace spa;

struct Row {
    double coverage = 0; // share of samples with a surface in one map alone
    double depth = 0;    // share of common samples whose depths differ by more than two codes of u16
    double color = 0;    // mean difference in codes of 255
    [[nodiscard]] bool agrees() const { return coverage <= 0.001 && depth <= 0.001 && color <= 1.0; }
};

// The worst surface counts; surfaces of a few samples are weighed against the whole map.
Row compare_bakers(const Model& model, std::uint32_t layers) {
    bake::Options options;
    options.grid = options.color_grid = {Mapping::octahedral, 129, 129};
    options.layers = layers;
    const bake::Result radial = bake::bake_model(model, options);
    options.baker = bake::Baker::orbit;
    const bake::Result orbit = bake::bake_model(model, options);
    const measure::MapDifference difference = measure::compare(radial.map.map, orbit.map.map);
    Row row;
    for (const measure::SurfaceDifference& s : difference.surfaces) {
        const double samples = double(s.samples);
        row.coverage = std::max(row.coverage, double(s.coverage_differs) / samples);
        row.depth = std::max(row.depth, double(s.depth_differs) / samples);
        row.color = std::max(row.color, s.color_mean * double(s.both) / samples);
    }
    return row;
}

} // namespace

int main(int argc, char** argv) {
    int missed = 0;
    int failed = 0;
    std::printf("%-60s %6s %10s %10s %8s\n", "asset", "layers", "coverage %", "depth %", "colour");
    for (int i = 1; i < argc; ++i) {
        try {
            const Model model = import::read_model(argv[i]).model;
            for (const std::uint32_t layers : {1U, 2U}) {
                const Row row = compare_bakers(model, layers);
                std::printf("%-60s %6u %10.3f %10.3f %8.3f%s\n", argv[i], layers, row.coverage * 100,
                            row.depth * 100, row.color, row.agrees() ? "" : "  MISSES");
                if (!row.agrees()) ++missed;
            }
        } catch (const std::exception& error) {
            std::printf("%-60s %s\n", argv[i], error.what());
            ++failed;
        }
        std::fflush(stdout);
    }
    std::printf("%d assets, %d figures miss the bar, %d assets could not be baked\n", argc - 1, missed,
                failed);
    if (failed > 0) return int(ExitCode::invalid_data);
    return missed > 0 ? int(ExitCode::limits) : 0;
}
