// SPDX-License-Identifier: Apache-2.0
// Random triangles with every kind of material against the reference of reference.h.
#include "fixture.h"

#include <tuple>

namespace spa::test {
namespace {

using bake::GlApi;

class OrbitReference : public testing::TestWithParam<std::tuple<GlApi, bool, Grid>> {};

TEST_P(OrbitReference, RandomSoup) {
    const auto [api, layers, grid] = GetParam();
    const auto context = open_context(api);
    if (!context) GTEST_SKIP() << "this OpenGL is not here";
    for (const std::uint32_t count : {12U, 150U}) {
        const Model model = random_textured_soup(count, 40 + count);
        bake::CenteredModel centered = normalized(model);
        centered.mirrored = count == 12;
        bake::CastOptions options;
        options.outermost_only = !layers;
        const auto crossings = bake::cast_orbit(*context, centered, grid, false, options);
        const Comparison result = compare_with_reference(crossings, centered, layers);
        EXPECT_EQ(result.wrong, 0U);
        EXPECT_LT(result.undecided, sample_count(grid) / 8) << "too little was compared";
        EXPECT_LT(result.radius, 1e-6);
        EXPECT_LT(result.normal, 1e-5);
        EXPECT_LE(result.color, 1);
    }
}

std::string case_name(const testing::TestParamInfo<OrbitReference::ParamType>& info) {
    const auto& [api, layers, grid] = info.param;
    return std::string(api == GlApi::egl ? "egl" : "osmesa") + (layers ? "_layers_" : "_outermost_") +
           name(grid.mapping);
}

INSTANTIATE_TEST_SUITE_P(All, OrbitReference,
                         testing::Combine(testing::Values(GlApi::egl, GlApi::osmesa), testing::Bool(),
                                          testing::Values(octahedral(48), latlong(70, 40))),
                         case_name);

} // namespace
} // namespace spa::test
