// SPDX-License-Identifier: Apache-2.0
#include "bake_settings.h"
#include "bench_arguments.h"
#include "verb.h"

#include "../samples/samples.h"

#include <CLI/App.hpp>

#include <memory>

// Text about what only a build with Vulkan has.
#ifdef SPA_HAS_RENDER
#define WITH_RENDER(text) text
#else
#define WITH_RENDER(text)
#endif

namespace spa::tools {

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts{""};
    for (const char c : text) {
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

std::vector<std::uint32_t> parse_numbers(const std::string& option, const std::string& text,
                                         std::uint32_t lowest, std::uint32_t highest) {
    std::vector<std::uint32_t> numbers;
    for (const std::string& number : split(text, ','))
        numbers.push_back(parse_number(option, number, lowest, highest));
    return numbers;
}

std::vector<std::uint32_t> parse_cells(const std::string& option, const std::string& text) {
    std::vector<std::uint32_t> sizes = parse_numbers(option, text, 2, max_side);
    for (const std::uint32_t cells : sizes)
        if (cells % 2 != 0)
            throw Error(ExitCode::usage, option + ": '" + std::to_string(cells) +
                                             "' is odd; the cells a side of an octahedral map are even");
    return sizes;
}

std::vector<int> parse_levels(const std::string& text) {
    const std::size_t dots = text.find("..");
    const std::string last = dots == std::string::npos ? text : text.substr(dots + 2);
    const auto first_level = int(parse_number("--levels", text.substr(0, dots), 0, samples::max_level));
    const auto last_level =
        int(parse_number("--levels", last, std::uint32_t(first_level), samples::max_level));
    std::vector<int> levels;
    for (int level = first_level; level <= last_level; ++level) levels.push_back(level);
    return levels;
}

void refuse(const std::string& what, const char* option, bool given) {
    if (given) throw Error(ExitCode::usage, std::string(option) + " is not for 'spa bench " + what + "'");
}

void refuse_paper_options(const std::string& what, const BenchArguments& given) {
    refuse(what, "--out", !given.out.empty());
    refuse(what, "--device", !given.device.empty());
    refuse(what, "--sponza", !given.sponza.empty());
}

void refuse_layers_options(const std::string& what, const BenchArguments& given) {
    refuse(what, "ASSET", !given.assets.empty());
    refuse(what, "--seed", given.seed.has_value());
    refuse(what, "--center", given.center.has_value());
}

namespace {

CLI::Option* add_optional(CLI::App& app, const std::string& name, const std::string& value_name,
                          const std::string& description, std::optional<std::string>& value) {
    return add_text(app, name, value_name, description, [&value](const std::string& text) { value = text; });
}

void bench(const std::string& what, const BenchArguments& arguments) {
    if (what == "bake") return bench_bake(arguments);
    if (what == "trace") return bench_trace(arguments);
    if (what == "layers") return bench_layers(arguments);
#ifdef SPA_HAS_RENDER
    if (what == "paper") return bench_paper(arguments);
#endif
    throw Error(ExitCode::usage,
                "'" + what + "' is not a benchmark; there are bake, trace, layers" WITH_RENDER(", paper"));
}

} // namespace

Verb bench_verb() {
    return {
        .name = "bench",
        .summary = "measure how fast baking and tracing are",
        .description =
            "'spa bench bake' times on this machine, for a model of growing size (the sample 'boot'), the "
            "ways "
            "to find where the line from the centre along each direction leaves the surface: the radial "
            "baker, "
            "the orbit baker with its views in batches, the orbit baker with one draw of the whole model a "
            "view "
            "('naive'), and Embree (a BVH of the model, then one ray a sample from outside to the centre). "
            "All "
            "start from the same centred model and end with the same crossings. 'hits' is the triangle and "
            "the distance; 'crossings' adds normal and colour, which is the same work for all. The naive "
            "orbit "
            "is timed on a few views, evenly spread, and scaled to all of them; the report says on how many. "
            "Making the OpenGL context is not counted. Memory is the peak of the process during a bake with "
            "two "
            "layers, the model included, without what the process held before; 'peak' is its share of the "
            "model's own size.\n\n"
            "'spa bench trace' sets speed against error: what a ray costs and how wrong its answer is, for "
            "maps "
            "(by the projective tracer, the paper's fan and a march), for the model's triangles in Embree, "
            "for "
            "simplified meshes of it, and for the surface that a map stores as triangles. It says for which "
            "rays, which silhouettes are missed, and where a simplified mesh is the better choice.\n\n"
            "'spa bench layers' says what layers bring, for every ASSET (a file, or a sample as NAME or "
            "NAME:LEVEL): maps of one depth, of intervals with tangent planes, and of intervals with folds, "
            "by size and number of intervals; which rays hit the map alone or the mesh alone, and which of "
            "these pass no silhouette within two texels; how far off the others are, their time, and the "
            "bytes of the file. Then the mean of the closed meshes and the bars that it is held to, and of "
            "every open mesh what is lost and why. --out gets pictures of all meshes and their maps, the "
            "table as layers.csv, report.json, report.txt and plots.\n\n"
            "Everything is timed in turns, and the median of all runs is reported." WITH_RENDER(
                "\n\n'spa bench paper' repeats the experiments of the paper on a Vulkan device: its pictures "
                "of "
                "shadows, colour bleeding and a colonnade, and its Tables 1 to 7, each for triangles, for "
                "the fan "
                "with its numbers of test rays and for the projective trace, with the errors that the paper "
                "does "
                "not give and the paper's printed values beside ours. --out gets contact sheets, tables.csv, "
                "report.json, report.txt and plots."),
        .examples = "$ spa bench bake\n"
                    "$ spa bench bake --levels 6 --only radial,embree --sizes 640x480\n"
                    "$ spa bench trace --plots plots\n"
                    "$ spa bench trace --models boot:6,chair.glb --format json > trace.json\n"
                    "$ spa bench trace --models smooth:6 --only projective,mesh --sets chords\n"
                    "$ spa bench layers bunny.obj torus --out layers\n"
                    "$ spa bench layers staircase.obj --size 128 --layers 1,2,4,8" WITH_RENDER(
                        "\n$ spa bench paper --out paper"),
        .see_also = "spa bake, spa sample",
        .define = [](CLI::App& app) -> std::function<void()> {
            struct State {
                std::string what;
                BenchArguments given;
            };
            const auto state = std::make_shared<State>();
            BenchArguments& given = state->given;
            add_text(app, "WHAT", "WHAT", "What to measure: bake, trace, layers" WITH_RENDER(", paper"),
                     [state](const std::string& text) { state->what = text; })
                ->required();
            app.add_option_function<std::vector<std::string>>(
                   "ASSET", [&given](const std::vector<std::string>& assets) { given.assets = assets; },
                   "layers: files and samples")
                ->type_name("ASSET");
            add_optional(
                app, "--levels", "A..B",
                "bake" WITH_RENDER(", paper") ": levels of subdivision of the boot, 0 to 6; or one alone",
                given.levels)
                ->default_str("0..6");
            add_optional(app, "--models", "M,...",
                         "trace: samples as NAME or NAME:LEVEL, and files, divided by commas", given.models)
                ->default_str("boot:6,smooth:6,torus,spiky,cube");
            add_optional(
                app, "--sizes,--size", "S,...",
                "Maps, divided by commas: N is an octahedral one of N cells a side; bake: WxH is a latlong "
                "one",
                given.sizes)
                ->default_str("640x480,256; trace: 32,64,128,256,512; layers: 64,128,256,512");
            add_optional(app, "--layers", "N,...", "trace, layers: layers of the maps, divided by commas",
                         given.layers)
                ->default_str("1,2; layers: 1,2,3");
            add_optional(app, "--rays", "N", "trace: rays of each set; layers: of a mesh", given.rays)
                ->default_str("100000; layers: 200000");
            add_optional(app, "--seed", "N", "layers: of the rays", given.seed)->default_str("20240501");
            add_choice<bake::Center>(app, "--center", {bake::Center::bounds, bake::Center::captured},
                                     "layers: the centre of the maps, as of 'spa bake'",
                                     [&given](bake::Center center) { given.center = center; })
                ->default_str("bounds");
            add_optional(app, "--sets", "SET,...",
                         "trace: some of primary, bounce, chords, shadow, leaving, divided by commas",
                         given.sets)
                ->default_str("all");
            add_optional(app, "--threads", "N,...",
                         "Numbers of threads, divided by commas; trace: those after the first for chords "
                         "alone; layers: one number, for all but the times, 0 = all cores",
                         given.threads)
                ->default_str("1,2; layers: 0");
            add_optional(app, "--runs", "N", "Times that everything is measured", given.runs)
                ->default_str("5");
            add_optional(
                app, "--only", "METHOD,...",
                "bake: some of radial, embree, orbit, naive; trace: some of fan, march, projective, mesh, "
                "lod, surface; " WITH_RENDER(
                    "paper: some of tables, shadows, bleeding, colonnade; ") "divided by commas",
                given.only)
                ->default_str("all that this machine can");
            add_path(app, "--csv", "F.csv", "trace: also write one line a model, method, set and call",
                     given.csv);
            add_path(app, "--plots", "DIR",
                     "trace: also write the lines and the plots of error against time and bytes, by gnuplot",
                     given.plots);
            add_path(app, "--out", "DIR", "layers" WITH_RENDER(", paper") ": the folder for what it writes",
                     given.out);
#ifdef SPA_HAS_RENDER
            add_text(app, "--device", "NAME",
                     "paper: a Vulkan device by name or index (spa render --list-devices)",
                     [&given](const std::string& text) { given.device = text; });
            add_text(app, "--sponza", "FILE.obj", "paper: also the colonnade's pictures in the Sponza scene",
                     [&given](const std::string& text) { given.sponza = text; });
#endif
            app.add_flag(
                "--quick", given.quick,
                "trace, layers" WITH_RENDER(", paper") ": small models, few rays and sizes, one run");
            add_report_format(app, given.format);
            app.add_flag("-q,--quiet", given.quiet, "No progress on standard error");
            return [state] { bench(state->what, state->given); };
        },
    };
}

} // namespace spa::tools
