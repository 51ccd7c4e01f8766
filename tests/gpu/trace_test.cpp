// SPDX-License-Identifier: Apache-2.0
// The GPU builds of the tracing text give the results of the C++ build.
#include "agreement.h"
#include "gpu_test.h"
#include "rays.h"
#include "trace_on_cpu.h"

#include "../../libspa/bake/bake.h"
#include "../../libspa/trace/trace_map.h"
#include "../../samples/samples.h"

#include <array>
#include <bit>
#include <iostream>
#include <string>
#include <vector>

namespace spa::test {
namespace {

struct Scene {
    const char* name;
    const char* sample;
    int level;
    Grid grid;
    std::uint32_t layers;
};

struct Trace {
    Scene scene;
    const char* method_name;
    std::uint32_t method;
    std::size_t rays;
};

std::string name_of(const Trace& trace) { return std::string(trace.scene.name) + "_" + trace.method_name; }
void PrintTo(const Trace& trace, std::ostream* out) { *out << name_of(trace); }

constexpr Grid octahedral(std::uint32_t cells) { return {Mapping::octahedral, cells + 1, cells + 1}; }
constexpr Grid latlong(std::uint32_t width, std::uint32_t height) {
    return {Mapping::latlong, width, height};
}

// Named after what is special: solid to the centre everywhere; an opening, steps, thin walls, holes.
constexpr std::array<Scene, 8> scenes = {{
    {"sphere", "sphere", 4, octahedral(64), 1},
    {"boot_1", "boot", 3, octahedral(128), 1},
    {"boot_2", "boot", 3, octahedral(256), 2},
    {"torus_2", "torus", 3, octahedral(64), 2},
    {"concave_3", "concave", 3, octahedral(96), 3},
    {"spiky", "spiky", 2, octahedral(10), 2},
    {"boot_latlong", "boot", 3, latlong(256, 128), 1},
    {"torus_latlong", "torus", 3, latlong(65, 33), 2},
}};

trace::TraceMap make_map(const Scene& scene) {
    bake::Options options;
    options.grid = options.color_grid = scene.grid;
    options.layers = scene.layers;
    const bake::Result result = bake::bake_model(samples::make_sample(scene.sample, scene.level), options);
    return trace::TraceMap(result.map.map.parts.front());
}

// What the shaders take as push constants.
struct Parameters {
    std::uint32_t first_word, count, method;
};

struct Language {
    const char* name;
    const char* shader;
};
constexpr std::array<Language, 2> languages = {{{"GLSL", "trace.comp"}, {"HLSL", "trace.hlsl"}}};

// Every method on every scene that it takes.
std::vector<Trace> traces() {
    std::vector<Trace> all;
    for (const Scene& scene : scenes) {
        if (scene.grid.mapping == Mapping::octahedral)
            all.push_back({scene, "projective", METHOD_PROJECTIVE, 1U << 17});
        all.push_back({scene, "fan", METHOD_FAN, 1U << 15});
        all.push_back({scene, "march", METHOD_MARCH, 1U << 15});
    }
    return all;
}

class TraceOnGpu : public GpuTest, public testing::WithParamInterface<Trace> {};

TEST_P(TraceOnGpu, GivesTheResultsOfTheCpu) {
    // The image lies somewhere in the buffer, among words that no trace of it may use.
    constexpr std::uint32_t first_word = 37;
    constexpr std::uint32_t foreign_word = 0x7FC12345; // a NaN, or an index far outside

    const trace::TraceMap map = make_map(GetParam().scene);
    Buffer image(*device, map.words().size() + 2 * std::size_t(first_word));
    std::fill(image.words().begin(), image.words().end(), foreign_word);
    std::copy(map.words().begin(), map.words().end(), image.words().begin() + first_word);

    const std::uint32_t method = GetParam().method;
    const std::vector<TestRay> rays = make_rays(GetParam().scene.grid, GetParam().rays, method);
    Buffer ray_words(*device, rays.size() * RAY_WORDS);
    write_rays(rays, ray_words.words());
    const std::vector<std::uint32_t> expected = trace_on_cpu(map.map(), ray_words.words(), method);

    for (const Language& language : languages) {
        const Buffer results(*device, expected.size());
        const ComputePipeline pipeline(*device, shader(language.shader), 3, sizeof(Parameters));
        const Parameters parameters{first_word, std::uint32_t(rays.size()), method};
        const std::array<const Buffer*, 3> buffers = {&image, &ray_words, &results};
        pipeline.run(buffers, std::as_bytes(std::span(&parameters, 1)), (parameters.count + 63) / 64);
        const Agreement agreement = agreement_of(rays, expected, results.words());
        std::cout << "  " << language.name << ": " << summary(agreement) << "\n";
        EXPECT_GT(agreement.hits, rays.size() / 10);
        EXPECT_LT(agreement.hits, rays.size());
        EXPECT_LE(agreement.differ, rays.size() / 100'000) << agreement.first_difference;
        EXPECT_LE(agreement.shading_error, 1);
    }
}

INSTANTIATE_TEST_SUITE_P(Traces, TraceOnGpu, testing::ValuesIn(traces()),
                         [](const auto& trace) { return name_of(trace.param); });

} // namespace
} // namespace spa::test
