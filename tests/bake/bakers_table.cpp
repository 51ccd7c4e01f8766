// SPDX-License-Identifier: Apache-2.0
// Prints how far three casters agree on the assets named on the command line: the radial baker with the orbit
// baker and with Embree's rays, one line for each asset and number of layers. Exit code 6 if one misses the
// bar, 4 if a caster fails; files without a surface are named and passed over. tools/compare_bakers.sh runs
// it over folders.
#include "../../formats/import/import.h"
#include "../../libspa/bake/bake.h"
#include "../../libspa/core/error.h"
#include "agreement.h"

#include <charconv>
#include <cstdio>
#include <exception>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace {

using namespace spa;

struct Settings {
    bake::Options options;
    std::vector<std::string> assets;
};

bool parse(std::span<char*> arguments, Settings& settings) {
    bool latlong = false;
    std::uint32_t size = 129;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string_view word = arguments[i];
        const std::string_view value = i + 1 < arguments.size() ? arguments[i + 1] : "";
        if (!word.starts_with("--")) {
            settings.assets.emplace_back(word);
            continue;
        }
        if (word == "--gl" && (value == "egl" || value == "osmesa")) {
            settings.options.gl = value == "egl" ? bake::GlApi::egl : bake::GlApi::osmesa;
        } else if (word == "--mapping" && (value == "octahedral" || value == "latlong")) {
            latlong = value == "latlong";
        } else if (word != "--size" ||
                   std::from_chars(value.data(), value.data() + value.size(), size).ec != std::errc{}) {
            return false;
        }
        ++i;
    }
    settings.options.grid =
        latlong ? Grid{Mapping::latlong, size, size * 3 / 4} : Grid{Mapping::octahedral, size, size};
    settings.options.color_grid = settings.options.grid;
    return is_valid(settings.options.grid);
}

void print(const test::Agreement& a) {
    std::printf(" | %8.3f %8.3f %7.3f %4u %6llu %6llu %6llu", a.coverage * 100, a.depth * 100, a.color,
                a.color_max, static_cast<unsigned long long>(a.differing),
                static_cast<unsigned long long>(a.ties), static_cast<unsigned long long>(a.unexplained));
}

} // namespace

int main(int argc, char** argv) {
    Settings settings;
    if (!parse({argv + 1, argv + argc}, settings)) {
        std::fprintf(stderr,
                     "usage: bakers_table [--gl egl|osmesa] [--size N] [--mapping octahedral|latlong] "
                     "MESH...\n");
        return int(ExitCode::usage);
    }
    int missed = 0;
    int refused = 0;
    int failed = 0;
    std::printf("%-55s %6s | %-50s | %-50s\n", "", "", "radial and orbit", "radial and Embree");
    std::printf("%-55s %6s", "asset", "layers");
    for (int k = 0; k < 2; ++k)
        std::printf(" | %8s %8s %7s %4s %6s %6s %6s", "cover %", "depth %", "colour", "max", "differ", "ties",
                    "other");
    std::printf("\n");
    for (const std::string& asset : settings.assets) {
        try {
            const Model model = import::read_model(asset).model;
            for (const std::uint32_t layers : {1U, 2U}) {
                settings.options.layers = layers;
                const test::Comparison comparison(model, settings.options);
                const test::Agreement orbit = comparison.of_orbit(settings.options.gl);
                const test::Agreement embree = comparison.of_embree();
                std::printf("%-55s %6u", asset.c_str(), layers);
                print(orbit);
                print(embree);
                const bool agree = test::agrees(orbit) && test::agrees(embree);
                std::printf("%s\n", agree ? "" : "  MISSES");
                if (!agree) ++missed;
                std::fflush(stdout);
            }
        } catch (const Error& error) {
            std::printf("%s\n", error.what());
            ++(error.code() == ExitCode::invalid_data ? refused : failed);
        } catch (const std::exception& error) {
            std::printf("%s: %s\n", asset.c_str(), error.what());
            ++failed;
        }
        std::fflush(stdout);
    }
    std::printf("%zu assets: %d without a surface, %d failed; %d lines miss the bar\n",
                settings.assets.size(), refused, failed, missed);
    if (failed > 0) return int(ExitCode::internal);
    return missed > 0 ? int(ExitCode::limits) : 0;
}
