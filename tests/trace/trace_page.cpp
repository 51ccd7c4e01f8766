// SPDX-License-Identifier: Apache-2.0
// What ../../shaders/README.md shows of real maps and rays:
//
//   trace_page memory        its table of bytes and loads, as it stands there
//   trace_page walk FOLDER   the data of its picture (../../docs/images/projective-trace.gp)
#include "noted_walk.h"
#include "random.h"

#include "../../libspa/bake/bake.h"
#include "../../libspa/trace/trace_map.h"
#include "../../samples/samples.h"

#include <cstdio>
#include <exception>
#include <fstream>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>

namespace spa::test {
namespace {

trace::TraceMap baked(const char* sample, std::uint32_t cells, std::uint32_t layers) {
    bake::Options options;
    options.grid = options.color_grid = {Mapping::octahedral, cells + 1, cells + 1};
    options.layers = layers;
    const bake::Result result = bake::bake_model(samples::make_sample(sample, 4), options);
    return trace::TraceMap(result.map.map.parts.front());
}

// Between two random points of a sphere.
trace::Ray random_chord(Random& random) {
    const Vec3d from = random.direction();
    const Vec3d to = random.direction();
    return {to_float(from), 0, to_float(to - from)};
}

// KiB of the image from the first of these places of its header to the next that is there; 0: the first is
// not.
double kib(const trace::TraceMap& map, std::uint32_t first, std::initializer_list<std::uint32_t> next) {
    const std::uint32_t from = map.words()[first];
    if (from == 0) return 0;
    for (const std::uint32_t place : next)
        if (const std::uint32_t to = map.words()[place]; to != 0) return double(to - from) * 4 / 1024;
    return 0;
}

void print_memory(const char* sample, std::uint32_t cells, std::uint32_t layers) {
    const trace::TraceMap map = baked(sample, cells, layers);
    constexpr int rays = 20000;
    Random random(1);
    NotedLoads sum;
    for (int i = 0; i < rays; ++i) {
        const NotedLoads loads = note_loads(map.words(), random_chord(random));
        sum.nodes += loads.nodes;
        sum.cores += loads.cores;
        sum.samples += loads.samples;
        sum.cells += loads.cells;
        sum.prisms += loads.prisms;
    }
    const auto each = [&](std::size_t words) { return double(words) / rays; };
    std::printf(
        "| %s, %u layer%s | %u | %.1f | %.1f | %.1f | %.1f | %.1f | **%.0f** | %.1f | %.1f | %.1f |\n",
        sample, layers, layers == 1 ? "" : "s", cells,
        kib(map, SPA_HEADER_NODES, {SPA_HEADER_CORES, SPA_HEADER_SAMPLES}),
        kib(map, SPA_HEADER_CORES, {SPA_HEADER_SAMPLES}),
        kib(map, SPA_HEADER_SAMPLES, {SPA_HEADER_CELLS, SPA_HEADER_DEPTHS}),
        kib(map, SPA_HEADER_CELLS, {SPA_HEADER_PRISMS}), kib(map, SPA_HEADER_PRISMS, {SPA_HEADER_DEPTHS}),
        double(map.projective_bytes()) / 1024, each(sum.nodes + sum.cores), each(sum.samples),
        each(sum.cells + sum.prisms));
}

void print_memory() {
    for (const std::uint32_t cells : {64U, 128U, 256U}) print_memory("smooth", cells, 1);
    for (const std::uint32_t layers : {1U, 2U})
        for (const std::uint32_t cells : {64U, 128U, 256U}) print_memory("boot", cells, layers);
}

// Of the picture: the ray passes two octants of one quadrant and hits.
constexpr const char* shown_sample = "boot";
constexpr std::uint32_t shown_cells = 64;
constexpr trace::Ray shown_ray{{-0.0117F, 0.91F, 0.415F}, 0, {0.39F, -1.6F, -1.03F}};

void write_walk(const std::string& folder) {
    const trace::TraceMap map = baked(shown_sample, shown_cells, 1);
    const NotedWalk walk = note_walk(map.words(), shown_ray);
    if (!walk.hit || walk.stretches.size() != 2)
        throw std::runtime_error(
            "the ray of the picture does not hit in its second octant any more; take another");
    // Blocks of one stretch each, two empty lines between them; sigma goes on from one to the next.
    std::ofstream ray(folder + "/ray.dat");
    std::ofstream nodes(folder + "/nodes.dat");
    std::ofstream hit(folder + "/hit.dat");
    for (std::size_t i = 0; i < walk.stretches.size(); ++i) {
        for (const NotedPlace& p : walk.stretches[i].places)
            ray << double(i) + p.sigma << ' ' << p.x << ' ' << p.y << ' ' << p.w << ' ' << p.surface << '\n';
        for (const NotedNode& n : walk.stretches[i].nodes)
            nodes << int(n.visit) << ' ' << n.x0 << ' ' << n.y0 << ' ' << n.x1 << ' ' << n.y1 << ' '
                  << double(i) + n.sigma0 << ' ' << double(i) + n.sigma1 << ' ' << n.w << '\n';
        ray << "\n\n";
        nodes << "\n\n";
    }
    hit << 1 + walk.at.sigma << ' ' << walk.at.x << ' ' << walk.at.y << ' ' << walk.at.w << '\n';
    for (std::ofstream* const file : {&ray, &nodes, &hit})
        if (!file->flush())
            throw std::runtime_error(folder + ": the data cannot be written; is the folder there?");
}

int run(int argc, char** argv) {
    const std::string_view verb = argc > 1 ? argv[1] : "";
    if (verb == "memory" && argc == 2) {
        print_memory();
        return 0;
    }
    if (verb == "walk" && argc == 3) {
        write_walk(argv[2]);
        return 0;
    }
    (void)std::fputs("trace_page memory | trace_page walk FOLDER\n", stderr);
    return 1;
}

} // namespace
} // namespace spa::test

int main(int argc, char** argv) {
    try {
        return spa::test::run(argc, argv);
    } catch (const std::exception& error) {
        (void)std::fprintf(stderr, "trace_page: %s\n", error.what());
        return 1;
    }
}
