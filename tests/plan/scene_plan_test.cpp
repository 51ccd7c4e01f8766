// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/core/error.h"
#include "../../libspa/plan/scene_plan.h"
#include "../../samples/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace spa;
using namespace spa::plan;

PlanOptions small_options() {
    PlanOptions options;
    options.paths.width = 320;
    options.paths.height = 180;
    options.paths.samples = 16;
    options.paths.most_rays = 4096;
    options.largest_size = 128;
    return options;
}

const Scene& room() {
    static const Scene scene = samples::make_scene("room", 1);
    return scene;
}

ScenePlan plan_room(const PlanOptions& options) {
    return plan_scene(room(), std::span(room().cameras).first(1), options);
}

std::uint64_t bytes_of(const ScenePlan& plan) {
    std::uint64_t bytes = 0;
    for (const ObjectPlan& object : plan.objects)
        bytes += object.decision == Decision::triangles ? object.bytes_triangles : object.expected->bytes;
    return bytes;
}

std::ptrdiff_t count(const ScenePlan& plan, Decision decision) {
    return std::count_if(plan.objects.begin(), plan.objects.end(),
                         [&](const ObjectPlan& object) { return object.decision == decision; });
}

TEST(ScenePlan, MeetsATargetWithFewerBytesThanTriangles) {
    PlanOptions options = small_options();
    options.target_image_error = 2e-3;
    const ScenePlan plan = plan_room(options);
    EXPECT_TRUE(plan.meets_error);
    EXPECT_LE(plan.image_error, 2e-3);
    EXPECT_LT(plan.bytes, plan.bytes_triangles / 2);
    EXPECT_EQ(plan.bytes, bytes_of(plan));
    EXPECT_GT(count(plan, Decision::map), 3);
    EXPECT_GT(count(plan, Decision::triangles), 3);
    double error = 0;
    for (const ObjectPlan& object : plan.objects) {
        SCOPED_TRACE(object.name);
        EXPECT_FALSE(object.why.empty());
        EXPECT_EQ(object.settings.has_value(), object.decision == Decision::map);
        if (object.expected) error += object.expected->image_error;
    }
    EXPECT_GE(plan.errors_together, 1);
    EXPECT_NEAR(error * plan.errors_together, plan.image_error, 1e-9 + plan.image_error * 1e-6);
}

TEST(ScenePlan, SpendsMoreForASmallerError) {
    PlanOptions options = small_options();
    options.target_image_error = 1e-2;
    const ScenePlan rough = plan_room(options);
    options.target_image_error = 1e-4;
    const ScenePlan fine = plan_room(options);
    EXPECT_LT(rough.bytes, fine.bytes);
    EXPECT_LE(fine.image_error, 1e-4);
}

TEST(ScenePlan, KeepsABudget) {
    PlanOptions options = small_options();
    options.budget_bytes = room().model.triangles.size() * 20;
    const ScenePlan plan = plan_room(options);
    EXPECT_TRUE(plan.meets_budget);
    EXPECT_LE(plan.bytes, *options.budget_bytes);
    options.budget_bytes = 100;
    options.drop_below = 0;
    const ScenePlan too_little = plan_room(options);
    EXPECT_FALSE(too_little.meets_budget);
    EXPECT_EQ(count(too_little, Decision::drop), 0);
}

TEST(ScenePlan, DoesNotDependOnThreads) {
    PlanOptions options = small_options();
    options.threads = 1;
    const ScenePlan one = plan_room(options);
    options.threads = 2;
    const ScenePlan two = plan_room(options);
    ASSERT_EQ(one.objects.size(), two.objects.size());
    EXPECT_EQ(one.image_error, two.image_error);
    EXPECT_EQ(one.bytes, two.bytes);
    for (std::size_t i = 0; i < one.objects.size(); ++i) {
        EXPECT_EQ(one.objects[i].why, two.objects[i].why);
        EXPECT_EQ(one.objects[i].decision, two.objects[i].decision);
    }
}

TEST(ScenePlan, InstancesShareAMap) {
    PlanOptions options = small_options();
    options.drop_below = 0;
    options.target_image_error = 1e-2;
    const ScenePlan plan = plan_room(options);
    std::uint32_t owner = no_index;
    std::size_t sharing = 0;
    for (const ObjectPlan& object : plan.objects) {
        if (!object.name.starts_with("pebble")) continue;
        ASSERT_EQ(object.decision, Decision::map) << object.name;
        if (object.same_as == no_index) {
            owner = object.node;
            EXPECT_GT(object.expected->bytes, 0U);
        } else {
            EXPECT_EQ(object.same_as, owner);
            EXPECT_EQ(object.expected->bytes, 0U);
            ++sharing;
        }
    }
    EXPECT_EQ(sharing, 7U);
}

TEST(ScenePlan, OfNothingIsRefused) {
    const Scene scene;
    EXPECT_THROW(plan_scene(scene, {}, small_options()), Error);
}

} // namespace
