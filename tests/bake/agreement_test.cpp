// SPDX-License-Identifier: Apache-2.0
// Two bakers, one definition: the radial and the orbit baker agree on every sample, for one and two layers,
// both mappings and both ways to OpenGL.
#include "../../libspa/bake/bake.h"
#include "../../libspa/bake/orbit.h"
#include "../../libspa/core/error.h"
#include "../../libspa/measure/compare.h"
#include "../../samples/samples.h"

#include <gtest/gtest.h>

#include <string>
#include <tuple>

namespace spa::bake {
namespace {

using Case = std::tuple<std::string, Mapping, std::uint32_t, GlApi>;

class Agreement : public testing::TestWithParam<Case> {};

TEST_P(Agreement, OfRadialAndOrbit) {
    const auto& [sample, mapping, layers, gl] = GetParam();
    try {
        make_gl_context(gl);
    } catch (const Error& error) {
        GTEST_SKIP() << error.what();
    }
    const Model model = samples::make_sample(sample, samples::find_sample(sample)->default_level);
    Options options;
    options.grid = mapping == Mapping::octahedral ? Grid{mapping, 129, 129} : Grid{mapping, 160, 120};
    options.color_grid = options.grid;
    options.layers = layers;
    options.gl = gl;
    const Result radial = bake_model(model, options);
    options.baker = Baker::orbit;
    const Result orbit = bake_model(model, options);

    const measure::MapDifference difference = measure::compare(radial.map.map, orbit.map.map);
    ASSERT_FALSE(difference.structure.has_value()) << *difference.structure;
    ASSERT_FALSE(difference.surfaces.empty());
    for (const measure::SurfaceDifference& s : difference.surfaces) {
        const std::string where =
            "layer " + std::to_string(s.layer) + (s.side == measure::Side::outer ? " outer" : " inner");
        EXPECT_LE(double(s.coverage_differs), 0.001 * double(s.samples)) << where;
        EXPECT_LE(double(s.depth_differs), 0.001 * double(s.both)) << where << ", max " << s.depth_max;
        EXPECT_LE(s.color_mean, 1.0) << where << ", max " << s.color_max;
        // The median: where a sample's direction meets an edge exactly (the cube's, on the octahedral grid),
        // either face is right and their normals differ by a right angle.
        EXPECT_LE(s.normal_median, 0.01) << where << ", mean " << s.normal_mean;
    }
    EXPECT_GT(difference.surfaces.front().both, difference.surfaces.front().samples / 4);
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
    const auto& [sample, mapping, layers, gl] = info.param;
    return sample + "_" + name(mapping) + "_" + std::to_string(layers) +
           (gl == GlApi::egl ? "_egl" : "_osmesa");
}

std::vector<std::string> sample_names() {
    std::vector<std::string> names;
    for (const samples::Sample& sample : samples::list()) names.emplace_back(sample.name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Samples, Agreement,
                         testing::Combine(testing::ValuesIn(sample_names()),
                                          testing::Values(Mapping::octahedral, Mapping::latlong),
                                          testing::Values(1U, 2U),
                                          testing::Values(GlApi::egl, GlApi::osmesa)),
                         case_name);

} // namespace
} // namespace spa::bake
