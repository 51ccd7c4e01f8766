// SPDX-License-Identifier: Apache-2.0
// A defect planted in a map is found, and named with its place; a map without one has no finding.
#include "../../libspa/measure/findings.h"
#include "../support/shapes.h"
#include "defects.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

namespace spa::measure {
namespace {

using Case = std::tuple<std::string, Mapping, std::uint32_t, bake::Frame>;

bake::Options options_of(const Case& c) {
    const auto& [sample, mapping, layers, frame] = c;
    bake::Options options = test::small_options();
    if (mapping == Mapping::latlong) options.grid = options.color_grid = {mapping, 96, 48};
    options.layers = layers;
    options.frame = frame;
    return options;
}

std::vector<Finding> findings_of(const Model& model, const bake::Result& baked) {
    const Part& part = baked.map.map.parts.front();
    return find_defects(part, measure_map(model, part, {2000, 1, 0}), 0);
}

class CleanMap : public testing::TestWithParam<Case> {};

TEST_P(CleanMap, HasNoFinding) {
    const Model model = test::sample_model(std::get<0>(GetParam()));
    const bake::Result baked = bake::bake_model(model, options_of(GetParam()));
    for (const Finding& finding : findings_of(model, baked)) ADD_FAILURE() << finding.message;
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
    const auto& [sample, mapping, layers, frame] = info.param;
    return sample + "_" + name(mapping) + "_" + std::to_string(layers) +
           (frame == bake::Frame::affine ? "_affine" : "");
}

INSTANTIATE_TEST_SUITE_P(
    Samples, CleanMap,
    testing::Combine(testing::Values("sphere", "cube", "torus", "boot", "spiky", "cliff", "concave"),
                     testing::Values(Mapping::octahedral, Mapping::latlong), testing::Values(1U, 2U),
                     testing::Values(bake::Frame::sphere, bake::Frame::affine)),
    case_name);

class PlantedDefect : public testing::Test {
protected:
    PlantedDefect()
        : model_(test::sample_model("boot")), baked_(bake::bake_model(model_, test::small_options())) {}

    Surface& outer() { return baked_.map.map.parts[0].layers[0].outer; }

    // The one finding that there is.
    Finding only_finding() {
        const std::vector<Finding> findings = findings_of(model_, baked_);
        EXPECT_EQ(findings.size(), 1U);
        for (const Finding& f : findings) SCOPED_TRACE(f.message);
        return findings.empty() ? Finding{"none", "", {}} : findings.front();
    }

    void expect(const std::string& kind, TexelIndex at) {
        const Finding finding = only_finding();
        EXPECT_EQ(finding.kind, kind) << finding.message;
        ASSERT_TRUE(finding.at.has_value());
        EXPECT_EQ(finding.at->texel, at);
        EXPECT_EQ(finding.at->layer, 0U);
        EXPECT_EQ(finding.at->side, Side::outer);
    }

    static constexpr TexelIndex at_{20, 30}; // well inside the boot's surface
    Model model_;
    bake::Result baked_;
};

TEST_F(PlantedDefect, OneTexelMoved) {
    test::move_depth(baked_.map, outer().depth, at_, 40);
    expect("depth", at_);
    const Measurement m = measure_map(model_, baked_.map.map.parts[0], {2000, 1, 0});
    EXPECT_EQ(m.quantization.above, 1U);
    EXPECT_FALSE(m.quantization.holds());
    EXPECT_NEAR(m.quantization.error.max, 40.0 / 65535, 1e-5);
    ASSERT_TRUE(m.worst_distance.has_value());
    EXPECT_EQ(m.worst_distance->texel, at_);
    EXPECT_GT(m.texel_distance.max, 5.0 / 65535);
}

TEST_F(PlantedDefect, OneTexelMovedByTheLeastThatShows) {
    test::move_depth(baked_.map, outer().depth, at_, 2);
    expect("depth", at_);
}

TEST_F(PlantedDefect, AHole) {
    for (std::uint32_t y = 30; y < 33; ++y)
        for (std::uint32_t x = 20; x < 23; ++x) test::clear_depth(baked_.map, outer().depth, {x, y});
    expect("missing", at_);
    const Measurement m = measure_map(model_, baked_.map.map.parts[0], {2000, 1, 0});
    EXPECT_EQ(m.coverage.missing, 9U);
    EXPECT_DOUBLE_EQ(m.coverage.share(), 1 - 9.0 / double(m.coverage.texels));
}

TEST_F(PlantedDefect, ASurfaceWhereThereIsNone) {
    // The boot's shaft is open: no surface straight up.
    const TexelIndex up{32, 0};
    std::uint16_t code = 0;
    std::memcpy(&code, test::texel(baked_.map, outer().depth, up), 2);
    ASSERT_EQ(code, 0);
    test::move_depth(baked_.map, outer().depth, up, 30000);
    expect("extra", up);
}

TEST_F(PlantedDefect, ARotatedNormal) {
    std::byte* const code = test::texel(baked_.map, outer().normal, at_);
    const Vec3d n = to_double(decode_normal(ElementFormat::oct16, code));
    const Vec3d side = normalize(cross(n, Vec3d{0.3, 0.5, 0.8}));
    const double angle = 2.0 * 3.14159265358979 / 180;
    encode_normal(ElementFormat::oct16, n * std::cos(angle) + side * std::sin(angle), code);
    expect("normal", at_);
    EXPECT_NEAR(only_finding().at->value, 2, 0.01);
}

TEST_F(PlantedDefect, AColorOffByOne) {
    test::add_to_color(baked_.map, outer().color, at_, 1);
    expect("color", at_);
    EXPECT_EQ(only_finding().at->value, 1);
}

TEST_F(PlantedDefect, CoverageThatIsGone) {
    test::texel(baked_.map, outer().color, at_)[3] = std::byte{0};
    expect("alpha", at_);
    EXPECT_EQ(only_finding().at->value, 255);
}

TEST_F(PlantedDefect, FiguresThatLie) {
    Part& part = baked_.map.map.parts[0];
    part.errors = error_figures(measure_map(model_, part, {2000, 1, 0}));
    EXPECT_TRUE(findings_of(model_, baked_).empty());
    part.errors.surface_distance_max /= 2;
    EXPECT_STREQ(only_finding().kind, "figures");
}

TEST_F(PlantedDefect, AWrongRadius) {
    baked_.map.map.parts[0].radius *= 1.01;
    const std::vector<Finding> findings = findings_of(model_, baked_);
    ASSERT_FALSE(findings.empty());
    EXPECT_STREQ(findings.front().kind, "radius");
    EXPECT_NE(findings.front().message.find("scaled by 1.01"), std::string::npos) << findings.front().message;
    const Measurement m = measure_map(model_, baked_.map.map.parts[0], {2000, 1, 0});
    EXPECT_GT(m.texel_distance.max, 0.009);
    EXPECT_LT(m.texel_distance.max, 0.0101);
}

TEST_F(PlantedDefect, AWrongCenter) {
    Part& part = baked_.map.map.parts[0];
    part.center.x += 0.01 * part.radius;
    const Measurement m = measure_map(model_, part, {2000, 1, 0});
    EXPECT_NEAR(m.texel_distance.max, 0.01, 0.001);
    EXPECT_FALSE(find_defects(part, m, 0).empty());
}

// Other programs may leave out images, or give them sizes of their own (SPA.md, sections 7 and 8).
TEST(OtherWriters, ImagesThatAreAbsentOrOfAnotherSize) {
    const Model model = test::sample_model("torus");
    const bake::Result baked = bake::bake_model(model, test::small_options());
    bake::Options small = test::small_options();
    small.grid = small.color_grid = {Mapping::octahedral, 17, 17};
    const bake::Result other = bake::bake_model(model, small);
    const ImageView small_normal = other.map.map.parts[0].layers[0].inner.normal;
    for (const ImageView& normal : {ImageView{}, small_normal}) {
        SphericalMap map = baked.map.map;
        map.parts[0].layers[0].inner.normal = normal;
        map.parts[0].layers[0].inner.color = {};
        const Measurement m = measure_map(model, map.parts[0], {100, 1, 0});
        EXPECT_TRUE(find_defects(map.parts[0], m, 0).empty());
        const MapDifference same = compare(map, map);
        ASSERT_EQ(same.surfaces.size(), 2U);
        EXPECT_EQ(same.surfaces[1].normal_max, 0);
    }
    SphericalMap absent = baked.map.map;
    absent.parts[0].layers[0].inner.normal = {};
    EXPECT_EQ(compare(absent, baked.map.map).surfaces.at(1).normal_max, 0);
}

// On an edge either surface is right: that is a tie, not a defect.
TEST(Tie, TheNormalOfTheOtherFace) {
    Model model = test::empty_model();
    test::add_box(model, {-1, -1, -1}, {1, 1, 1});
    bake::Result baked = bake::bake_model(model, test::small_options());
    const Part& part = baked.map.map.parts[0];
    const TexelIndex edge{48, 32}; // g = (0.5, 0, 0.5)
    std::byte* const code = test::texel(baked.map, part.layers[0].outer.normal, edge);
    const Vec3f normal = decode_normal(ElementFormat::oct16, code);
    const Vec3d other = normal.x > 0.5F ? Vec3d{0, 0, 1} : Vec3d{1, 0, 0};
    encode_normal(ElementFormat::oct16, other, code);
    const Measurement m = measure_map(model, part, {100, 1, 0});
    EXPECT_TRUE(find_defects(part, m, 0).empty());
    EXPECT_EQ(m.coverage.ties, 1U);
    EXPECT_LT(m.normal_angle.max, 0.01);
    encode_normal(ElementFormat::oct16, {0, 1, 0}, code);
    const Measurement wrong = measure_map(model, part, {100, 1, 0});
    EXPECT_EQ(wrong.coverage.ties, 0U);
    EXPECT_EQ(wrong.normals_above, 1U);
}

TEST(Tie, TheBorderOfASheet) {
    Model model = test::empty_model();
    test::add_quad(model, {-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2});
    bake::Options options;
    options.grid = options.color_grid = {Mapping::octahedral, 49, 49};
    options.layers = 1;
    bake::Result baked = bake::bake_model(model, options);
    const Part& part = baked.map.map.parts[0];
    // The centre of a flat object lies half of its half size behind it, so the border is where x = 2 z: 16 of
    // 24 cells from the middle.
    ASSERT_EQ(part.center, (Vec3d{0, 0, 1.5}));
    const ImageView& depth = part.layers[0].outer.depth;
    ASSERT_GT(decode_depth(depth.format, depth.at(40, 24)), 0);
    ASSERT_EQ(decode_depth(depth.format, depth.at(41, 24)), 0);
    ASSERT_EQ(measure_map(model, part, {100, 1, 0}).coverage.ties, 0U);
    test::clear_depth(baked.map, depth, {40, 24});
    const Measurement border = measure_map(model, part, {100, 1, 0});
    EXPECT_EQ(border.coverage.ties, 1U);
    EXPECT_EQ(border.coverage.missing, 0U);
    test::clear_depth(baked.map, depth, {39, 24});
    EXPECT_EQ(measure_map(model, part, {100, 1, 0}).coverage.missing, 1U);
}

} // namespace
} // namespace spa::measure
