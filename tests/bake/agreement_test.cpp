// SPDX-License-Identifier: Apache-2.0
// Three casters, one definition: the radial baker, the orbit baker by both ways to OpenGL, and Embree's rays
// agree on every sample, for one and two layers and both mappings.
#include "agreement.h"

#include "../../formats/import/import.h"
#include "../../libspa/bake/orbit.h"
#include "../../libspa/bake/radial.h"
#include "../../libspa/core/error.h"
#include "../../libspa/measure/cast_embree.h"
#include "../../samples/samples.h"
#include "../support/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace spa::bake {
namespace {

using test::Agreement;

Options options_for(Mapping mapping, std::uint32_t layers) {
    Options options;
    options.grid = mapping == Mapping::octahedral ? Grid{mapping, 129, 129} : Grid{mapping, 160, 120};
    options.color_grid = options.grid;
    options.layers = layers;
    return options;
}

bool has_gl(GlApi api) {
    try {
        make_gl_context(api);
        return true;
    } catch (const Error&) {
        return false;
    }
}

void expect_agreement(const Agreement& a, const std::string& what) {
    EXPECT_TRUE(test::agrees(a)) << what << ": coverage " << a.coverage << ", depth " << a.depth
                                 << ", colour " << a.color;
    EXPECT_EQ(a.unexplained, 0U) << what << ", of " << a.differing;
    EXPECT_LE(a.normal, 0.01) << what;
    EXPECT_EQ(a.mixed, 0U) << what;
}

// With Embree and with every OpenGL there is, one layer and two.
void expect_all_agree(const Model& model, Mapping mapping) {
    for (const std::uint32_t layers : {1U, 2U}) {
        const std::string with = std::to_string(layers) + " layers, ";
        const Options options = options_for(mapping, layers);
        const test::Comparison comparison(model, options);
        expect_agreement(comparison.of_embree(), with + "Embree");
        if (has_gl(GlApi::egl)) expect_agreement(comparison.of_orbit(GlApi::egl), with + "EGL");
        if (has_gl(GlApi::osmesa)) expect_agreement(comparison.of_orbit(GlApi::osmesa), with + "OSMesa");
    }
}

using Case = std::tuple<std::string, Mapping>;
class AgreementOf : public testing::TestWithParam<Case> {};

TEST_P(AgreementOf, Sample) {
    const auto& [sample, mapping] = GetParam();
    expect_all_agree(samples::make_sample(sample, samples::find_sample(sample)->default_level), mapping);
}

std::vector<std::string> sample_names() {
    std::vector<std::string> names;
    for (const samples::Sample& sample : samples::list()) names.emplace_back(sample.name);
    return names;
}

INSTANTIATE_TEST_SUITE_P(Samples, AgreementOf,
                         testing::Combine(testing::ValuesIn(sample_names()),
                                          testing::Values(Mapping::octahedral, Mapping::latlong)),
                         [](const testing::TestParamInfo<Case>& info) {
                             return std::get<0>(info.param) + "_" + name(std::get<1>(info.param));
                         });

// A square sheet with its four borders exactly on rays of the octahedral grid.
Model sheet() {
    Model model = test::empty_model();
    test::add_quad(model, {-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}); // faces +Y
    return model;
}

// The slices of a cake: closed prisms that meet in the axis through the centre, faces on faces.
Model slices() {
    Model model = test::empty_model();
    constexpr unsigned count = 6;
    const auto rim = [&](unsigned k, float y) {
        const float angle = 2 * std::numbers::pi_v<float> * float(k) / count;
        return Vec3f{std::cos(angle), y, -std::sin(angle)};
    };
    for (unsigned k = 0; k < count; ++k) {
        const Vec3f low{0, -0.3F, 0};
        const Vec3f high{0, 0.3F, 0};
        const Vec3f a = rim(k, -0.3F);
        const Vec3f b = rim(k + 1, -0.3F);
        const Vec3f c = rim(k + 1, 0.3F);
        const Vec3f d = rim(k, 0.3F);
        test::add_quad(model, a, b, c, d);
        test::add_quad(model, low, a, d, high);
        test::add_quad(model, b, low, high, c);
        test::add_quad(model, high, d, c, high); // the second triangle has no area
        test::add_quad(model, low, b, a, low);
    }
    return model;
}

TEST(Agreement, OfASheetWithItsBordersOnSamples) {
    expect_all_agree(sheet(), Mapping::octahedral);
    expect_all_agree(sheet(), Mapping::latlong);
}

TEST(Agreement, OfCubesThatTouchAndCoincide) {
    Model model = test::empty_model();
    test::add_box(model, {-1, -1, -1}, {0.5F, 0.5F, 0.5F});
    test::add_box(model, {0.5F, -1, -1}, {1, 1, 1});
    test::add_box(model, {-1, -1, -1}, {0.5F, 0.5F, 0.5F});
    expect_all_agree(model, Mapping::octahedral);
}

TEST(Agreement, OfSlicesAroundTheCentre) { expect_all_agree(slices(), Mapping::octahedral); }

TEST(Agreement, WithTheCentreOnTheSurface) {
    Model model = test::empty_model();
    test::add_box(model, {-1, -1, -1}, {1, 1, 1});
    test::add_quad(model, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
    expect_all_agree(model, Mapping::octahedral);
}

// Half of a sphere seen from the middle of its rim: its winding number there is one half.
TEST(Agreement, OfAHalfSphere) {
    Model model = test::empty_model();
    test::add_sphere(model, {}, 1, 32);
    std::erase_if(model.triangles, [&](const Triangle& t) {
        float y = 0;
        for (const std::uint32_t v : t.vertex) y += model.positions[v].y;
        return y < 0;
    });
    model.triangle_materials.resize(model.triangles.size());
    // Pulls the middle of the bounding box to the origin.
    test::add_quad(model, {0, -1, 0}, {1e-3F, -1, 0}, {1e-3F, -1, 1e-3F}, {0, -1, 1e-3F});
    expect_all_agree(model, Mapping::octahedral);
}

std::vector<std::pair<std::string, CrossingGrid>> cast_by_all(const CenteredModel& scene, const Grid& grid) {
    const trace::TriangleScene triangles(scene.positions, scene.model->triangles);
    std::vector<std::pair<std::string, CrossingGrid>> casts;
    casts.emplace_back("radial", cast_radial(scene, grid, {}));
    casts.emplace_back("Embree", measure::cast_embree(scene, triangles, grid, {}));
    for (const GlApi api : {GlApi::egl, GlApi::osmesa}) {
        if (!has_gl(api)) continue;
        casts.emplace_back("orbit", cast_orbit(*make_gl_context(api), scene, grid, false, {}));
        casts.emplace_back("naive orbit", cast_orbit(*make_gl_context(api), scene, grid, true, {}));
    }
    return casts;
}

// The rule itself, in exact arithmetic: coordinates of rays and sheets are multiples of powers of two. Rays
// on the border belong to the sheet, and not to one that is smaller by a millionth.
TEST(Agreement, BordersBelongToTheSurface) {
    const Model model = sheet();
    const Grid grid{Mapping::octahedral, 65, 65};
    for (const double half : {0.5, 0.5 - std::exp2(-21), 0.5 + std::exp2(-21)}) {
        CenteredModel scene;
        scene.model = &model;
        scene.normals = model.normals;
        for (const Vec3f p : model.positions)
            scene.positions.push_back({p.x * float(half), 0.25F, p.z * float(half)});
        std::size_t on_border = 0;
        for (const auto& [caster, cast] : cast_by_all(scene, grid)) {
            for (std::size_t s = 0; s < std::size_t(grid.width) * grid.height; ++s) {
                const Vec3d g =
                    sample_direction(grid, {std::uint32_t(s % grid.width), std::uint32_t(s / grid.width)});
                const double reach = std::max(std::abs(g.x), std::abs(g.z)) * 0.25;
                on_border += g.y > 0 && reach == 0.5 * g.y ? 1 : 0;
                ASSERT_EQ(cast.first[s + 1] - cast.first[s], g.y > 0 && reach <= half * g.y ? 1U : 0U)
                    << caster << " half " << half << " sample " << s;
            }
        }
        EXPECT_GT(on_border, 20U);
    }
}

// Tilted by so little that a camera in the sheet's middle plane sees it thinner than the rasteriser's grid.
TEST(Agreement, ASheetSeenEdgeOnIsStillThere) {
    Model model = test::empty_model();
    const float tilt = std::exp2(-40.0F);
    test::add_quad(model, {0.25F, -0.5F, -tilt}, {0.75F, -0.5F, tilt}, {0.75F, 0.5F, tilt},
                   {0.25F, 0.5F, -tilt});
    CenteredModel scene;
    scene.model = &model;
    scene.positions = model.positions;
    scene.normals = model.normals;
    const Grid grid{Mapping::octahedral, 65, 65};
    for (const auto& [caster, cast] : cast_by_all(scene, grid)) {
        for (std::size_t s = 0; s < std::size_t(grid.width) * grid.height; ++s) {
            const Vec3d g =
                sample_direction(grid, {std::uint32_t(s % grid.width), std::uint32_t(s / grid.width)});
            const bool met = g.z == 0 && g.x > 0 && std::abs(g.y) <= g.x;
            ASSERT_EQ(cast.first[s + 1] - cast.first[s], met ? 1U : 0U) << caster << " sample " << s;
            if (met) {
                EXPECT_NEAR(double(cast.crossings[cast.first[s]].radius), 0.5 * length(g) / g.x, 1e-6)
                    << caster;
            }
        }
    }
}

class AgreementOfAsset : public testing::TestWithParam<const char*> {};

TEST_P(AgreementOfAsset, WithTwoLayers) {
    const char* const variable = std::getenv("SPA_ASSETS");
    const std::filesystem::path folder = variable != nullptr ? variable : SPA_ASSETS_DIR;
    const std::filesystem::path file = folder / GetParam();
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no assets: set SPA_ASSETS to their folder";
    expect_all_agree(import::read_model(file).model, Mapping::octahedral);
}

INSTANTIATE_TEST_SUITE_P(Assets, AgreementOfAsset,
                         testing::Values("gltf/CakeBirthday/cakeBirthday.glb",
                                         "gltf/CubeScaledInstances/cube_att.gltf",
                                         "gltf/SimpleMeshes/SimpleMeshes.gltf",
                                         "gltf/TransmissionRoughnessTest/TransmissionRoughnessTest.glb",
                                         "ply/plane.ply", "obj/spider_plant/spider_plant.obj"),
                         [](const testing::TestParamInfo<const char*>& info) {
                             return std::filesystem::path(info.param).stem().string();
                         });

} // namespace
} // namespace spa::bake
