// SPDX-License-Identifier: Apache-2.0
// Two maps compared: what was changed by hand is what is found.
#include "../../libspa/measure/compare.h"
#include "defects.h"

#include <gtest/gtest.h>

namespace spa::measure {
namespace {

TEST(Compare, EqualMapsDoNotDiffer) {
    const bake::Result a = test::bake_sample("torus", test::small_options());
    const bake::Result b = test::bake_sample("torus", test::small_options());
    const MapDifference difference = compare(a.map.map, b.map.map);
    ASSERT_FALSE(difference.structure.has_value());
    for (const SurfaceDifference& s : difference.surfaces) {
        EXPECT_EQ(s.coverage_differs, 0U);
        EXPECT_EQ(s.depth_max, 0);
        EXPECT_EQ(s.normal_max, 0);
        EXPECT_EQ(s.color_max, 0U);
        EXPECT_EQ(s.alpha_mean, 0);
    }
    ASSERT_EQ(difference.parts.size(), 1U);
    EXPECT_EQ(difference.parts[0].radius, 0);
}

TEST(Compare, FindsWhatWasChanged) {
    const bake::Result a = test::bake_sample("sphere", test::small_options());
    bake::Result b = test::bake_sample("sphere", test::small_options());
    const Surface& surface = b.map.map.parts[0].layers[0].outer;
    test::move_depth(b.map, surface.depth, {20, 21}, 10);
    test::move_depth(b.map, surface.depth, {22, 21}, 1);
    test::clear_depth(b.map, surface.depth, {30, 31});
    test::add_to_color(b.map, surface.color, {10, 11}, 7);
    const MapDifference difference = compare(a.map.map, b.map.map);
    const SurfaceDifference& s = difference.surfaces.at(0);
    EXPECT_EQ(s.coverage_differs, 1U);
    EXPECT_EQ(s.both, s.samples - 1);
    EXPECT_EQ(s.depth_differs, 1U) << "one code is within two";
    EXPECT_NEAR(s.depth_max, 10.0 / 65535, 1e-7);
    EXPECT_EQ(s.color_max, 7U);
    EXPECT_NEAR(s.color_mean * 3 * double(s.samples), 7, 0.01);
}

TEST(Compare, SeesPlacement) {
    const bake::Result a = test::bake_sample("sphere", test::small_options());
    bake::Result b = test::bake_sample("sphere", test::small_options());
    Part& part = b.map.map.parts[0];
    part.radius *= 1.25;
    part.center.x += 0.5 * a.map.map.parts[0].radius;
    part.frame.row[1].z = 0.75;
    const PartDifference d = compare(a.map.map, b.map.map).parts.at(0);
    EXPECT_NEAR(d.radius, 0.25, 1e-12);
    EXPECT_NEAR(d.center, 0.5, 1e-12);
    EXPECT_NEAR(d.frame, 0.75, 1e-12);
}

TEST(Compare, NamesWhatCannotBeCompared) {
    bake::Options options = test::small_options();
    const bake::Result a = test::bake_sample("sphere", options);
    options.grid = options.color_grid = {Mapping::latlong, 64, 32};
    const bake::Result b = test::bake_sample("sphere", options);
    options.grid = options.color_grid = {Mapping::latlong, 32, 16};
    const bake::Result c = test::bake_sample("sphere", options);
    EXPECT_EQ(compare(a.map.map, b.map.map).structure,
              "part 0 has mapping octahedral in one map and latlong in the other");
    EXPECT_EQ(compare(b.map.map, c.map.map).structure, "the images of part 0, layer 0 differ in size");
}

} // namespace
} // namespace spa::measure
