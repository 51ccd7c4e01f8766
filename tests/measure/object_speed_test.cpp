// SPDX-License-Identifier: Apache-2.0
// Times say nothing about right and wrong; what is traced does.
#include "../../libspa/measure/object_speed.h"

#include "../../libspa/bake/bake.h"
#include "../../libspa/core/error.h"
#include "../../libspa/trace/trace_map.h"
#include "../support/shapes.h"

#include <gtest/gtest.h>

namespace spa::measure {
namespace {

constexpr SpeedOptions few{.rays = 1000, .runs = 2};

Model torus() {
    Model model = test::empty_model();
    test::add_torus(model, 1, 0.35F, 24);
    return model;
}

bake::Result baked(const Model& model, Mapping mapping = Mapping::octahedral) {
    bake::Options options;
    options.grid = options.color_grid =
        mapping == Mapping::octahedral ? Grid{mapping, 17, 17} : Grid{mapping, 32, 16};
    return bake::bake_model(model, options);
}

TEST(ObjectSpeed, TakesTheBytesThatTracingTouches) {
    const Model model = torus();
    const bake::Result result = baked(model);
    const SphericalMap& map = result.map.map;
    const RaySpeed speed = map_speed(map, few);
    EXPECT_GT(speed.ns, 0);
    EXPECT_LT(speed.ns, 1e9);
    EXPECT_EQ(speed.bytes, trace::TraceMap(map.parts.front()).projective_bytes());
    const RaySpeed triangles = triangle_speed(model, map, few);
    EXPECT_GT(triangles.ns, 0);
    EXPECT_LT(triangles.ns, 1e9);
    EXPECT_GT(triangles.bytes, model.triangles.size() * sizeof(Triangle));
}

TEST(ObjectSpeed, AddsUpParts) {
    const Model model = torus();
    const bake::Result result = baked(model);
    SphericalMap two = result.map.map;
    two.parts.push_back(two.parts.front());
    two.parts.back().center.x += 5;
    const RaySpeed speed = map_speed(two, few);
    EXPECT_GT(speed.ns, 0);
    EXPECT_EQ(speed.bytes, 2 * map_speed(result.map.map, few).bytes);
    EXPECT_GT(triangle_speed(model, two, few).ns, 0);
}

TEST(ObjectSpeed, RefusesMapsThatCannotBeTraced) {
    const bake::Result result = baked(torus(), Mapping::latlong);
    try {
        map_speed(result.map.map, few);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unsupported);
    }
}

} // namespace
} // namespace spa::measure
