// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/bake/bake.h"
#include "../../libspa/measure/map_rays.h"
#include "../../libspa/plan/candidate.h"
#include "../../libspa/plan/color_judge.h"
#include "../support/shapes.h"

#include <gtest/gtest.h>

namespace spa::plan {
namespace {

bake::Result bake_of(const Model& model, std::uint32_t cells) {
    bake::Options options;
    options.grid = options.color_grid = grid_of(Mapping::octahedral, cells);
    return bake::bake_model(model, options);
}

Model textured_sphere() {
    Model model = test::empty_model();
    test::add_sphere(model, {}, 1, 24);
    for (const Vec3f& p : model.positions)
        model.uvs.push_back({p.x * 0.5F + 0.5F, p.y * 0.5F + 0.5F}); // smooth over the sphere
    Model donor = test::empty_model();
    test::add_box(donor, {-1, -1, -1}, {1, 1, 1});
    test::add_random_texture(donor, 32, 3);
    model.textures = donor.textures;
    model.materials = donor.materials;
    return model;
}

TEST(ColorJudge, OneColorNeedsNoTexels) {
    Model model = test::empty_model();
    test::add_sphere(model, {}, 1, 24);
    const bake::Result baked = bake_of(model, 8);
    EXPECT_EQ(ColorJudge(model, baked.map.map.parts.front(), 0).error(4), 0);
}

TEST(ColorJudge, PredictsWhatRaysMeet) {
    const Model model = textured_sphere();
    for (const std::uint32_t cells : {16U, 64U}) {
        const bake::Result baked = bake_of(model, cells);
        const Part& part = baked.map.map.parts.front();
        const double predicted = ColorJudge(model, part, 0).error(cells);
        const double measured =
            measure::measure_rays(model, part, {.rays = 9'000, .star_cells = 64}).errors.color.mean;
        EXPECT_GT(measured, 1);
        EXPECT_NEAR(predicted, measured, 0.25 * measured) << cells;
    }
}

TEST(ColorJudge, MoreTexelsAndWiderFootprintsAreBetter) {
    const Model model = textured_sphere();
    const bake::Result baked = bake_of(model, 8);
    const Part& part = baked.map.map.parts.front();
    const ColorJudge sharp(model, part, 0), blurred(model, part, 8);
    EXPECT_LT(sharp.error(128), 0.5 * sharp.error(16));
    EXPECT_LT(blurred.error(32), 0.7 * sharp.error(32));
}

} // namespace
} // namespace spa::plan
