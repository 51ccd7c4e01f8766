// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/mesh/normals.h"

#include "../../libspa/mesh/weld.h"
#include "../support/shapes.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace spa {
namespace {

void add_triangle(Model& model, Vec3f a, Vec3f b, Vec3f c) {
    const auto first = std::uint32_t(model.positions.size());
    for (const Vec3f& p : {a, b, c}) model.positions.push_back(p);
    model.triangles.push_back({{first, first + 1, first + 2}});
    model.triangle_materials.push_back(0);
}

// Two squares that share the z axis; the second is turned by `degrees` out of the plane of the first. The
// vertices are shared.
Model hinge(double degrees) {
    Model model;
    const double angle = degrees * std::numbers::pi / 180;
    const auto x = float(std::cos(angle));
    const auto y = float(std::sin(angle));
    model.positions = {{0, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {-1, 0, 1}, {x, y, 0}, {x, y, 1}};
    model.triangles = {{{2, 3, 1}}, {{2, 1, 0}}, {{0, 1, 5}}, {{0, 5, 4}}};
    model.triangle_materials.assign(4, 0);
    return model;
}

double degrees_between(Vec3f a, Vec3f b) {
    return std::atan2(length(cross(to_double(a), to_double(b))), dot(to_double(a), to_double(b))) * 180 /
           std::numbers::pi;
}

Vec3f normal_of(const Model& model, std::size_t triangle, unsigned k) {
    return model.normals[model.triangles[triangle].vertex[k]];
}

TEST(Normals, SmoothHingeSharesTheBisectorAndSharpOneSplits) {
    Model smooth = hinge(30);
    compute_normals(smooth);
    EXPECT_EQ(smooth.positions.size(), 6U);
    // Both squares have 90 degrees at the shared vertices, however they are cut.
    const Vec3f bisector{float(-std::sin(std::numbers::pi / 12)), float(std::cos(std::numbers::pi / 12)), 0};
    EXPECT_LT(degrees_between(smooth.normals[0], bisector), 1e-3);
    EXPECT_LT(degrees_between(smooth.normals[1], bisector), 1e-3);
    EXPECT_LT(degrees_between(smooth.normals[2], {0, 1, 0}), 1e-3);

    Model sharp = hinge(50);
    compute_normals(sharp);
    EXPECT_EQ(sharp.positions.size(), 8U);
    for (unsigned k = 0; k < 3; ++k) {
        EXPECT_LT(degrees_between(normal_of(sharp, 0, k), {0, 1, 0}), 1e-3);
        EXPECT_LT(degrees_between(normal_of(sharp, 1, k), {0, 1, 0}), 1e-3);
    }
    EXPECT_LT(degrees_between(normal_of(sharp, 2, 0), normal_of(sharp, 3, 1)), 1e-3);
    EXPECT_NEAR(degrees_between(normal_of(sharp, 0, 0), normal_of(sharp, 2, 0)), 50, 1e-3);

    Model asked = hinge(50);
    compute_normals(asked, 60);
    EXPECT_EQ(asked.positions.size(), 6U);
}

// A corner of a cube has one square cut into one triangle and two cut into two at it, or any other way:
// weights by angle do not see the difference, weights by area or by count do.
TEST(Normals, DoNotDependOnHowAFaceIsCut) {
    Model box = test::empty_model();
    test::add_box(box, {0, 0, 0}, {1, 1, 1});
    box.normals.clear();
    compute_normals(box, 180);
    for (std::size_t v = 0; v < box.positions.size(); ++v) {
        const Vec3f p = box.positions[v];
        EXPECT_LT(degrees_between(box.normals[v], {p.x - 0.5F, p.y - 0.5F, p.z - 0.5F}), 1e-3);
    }
}

TEST(Normals, BoxIsFlat) {
    Model box = test::empty_model();
    test::add_box(box, {0, 0, 0}, {1, 2, 3});
    const Model expected = box;
    box.normals.clear();
    compute_normals(box);
    EXPECT_EQ(box.positions.size(), expected.positions.size());
    for (std::size_t v = 0; v < box.positions.size(); ++v)
        EXPECT_LT(degrees_between(box.normals[v], expected.normals[v]), 1e-3);
}

TEST(Normals, SphereOfSeparateTrianglesIsSmooth) {
    Model sphere = test::empty_model();
    test::add_sphere(sphere, {0, 0, 0}, 2, 40);
    Model soup = test::empty_model();
    for (const Triangle& t : sphere.triangles)
        add_triangle(soup, sphere.positions[t.vertex[0]], sphere.positions[t.vertex[1]],
                     sphere.positions[t.vertex[2]]);
    compute_normals(soup);
    double worst = 0;
    for (std::size_t v = 0; v < soup.positions.size(); ++v)
        worst = std::max(worst, degrees_between(soup.normals[v], soup.positions[v]));
    EXPECT_LT(worst, 1);
}

TEST(Normals, FacesThatOnlyTouchAtAPointDoNotShare) {
    Model model;
    add_triangle(model, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    add_triangle(model, {0, 0, 0}, {-1, 0, 0.2F}, {0, -1, 0.2F});
    compute_normals(model);
    EXPECT_GT(degrees_between(model.normals[0], model.normals[3]), 5);
}

// Both sides of a leaf, as many plants are modelled: four triangles at the middle edge.
TEST(Normals, TwoSidedSheetKeepsItsSides) {
    Model model = hinge(20);
    const auto front = model.triangles;
    for (const Triangle& t : front) model.triangles.push_back({{t.vertex[0], t.vertex[2], t.vertex[1]}});
    model.triangle_materials.assign(8, 0);
    compute_normals(model);
    EXPECT_EQ(model.positions.size(), 12U);
    EXPECT_LT(degrees_between(normal_of(model, 1, 2), normal_of(model, 2, 0)), 1e-3);
    EXPECT_LT(degrees_between(normal_of(model, 5, 1), normal_of(model, 6, 0)), 1e-3);
    EXPECT_GT(degrees_between(normal_of(model, 1, 2), normal_of(model, 5, 1)), 179);
}

TEST(Normals, GivenOnesStayAndAttributesAreCopied) {
    Model model = hinge(50);
    model.normals.assign(6, Vec3f{});
    model.normals[0] = {1, 0, 0};
    for (int i = 0; i < 6; ++i) {
        model.uvs.push_back({float(i), 1});
        model.colors.push_back({float(i), 0, 0, 1});
    }
    compute_normals(model);
    ASSERT_EQ(model.positions.size(), 7U); // vertex 1 is split, vertex 0 is not
    EXPECT_EQ(model.normals[0], (Vec3f{1, 0, 0}));
    EXPECT_EQ(model.positions[6], model.positions[1]);
    EXPECT_EQ(model.uvs[6], model.uvs[1]);
    EXPECT_EQ(model.colors[6], model.colors[1]);
}

TEST(Normals, DegenerateTrianglesAndLooseVerticesGetSome) {
    Model model;
    add_triangle(model, {1, 1, 1}, {1, 1, 1}, {2, 1, 1});
    model.positions.push_back({0, 0, 0});
    compute_normals(model);
    for (const Vec3f& normal : model.normals) EXPECT_EQ(normal, (Vec3f{0, 0, 1}));
}

// All triangles at one edge: comparing each pair would take n^2.
TEST(Normals, BookOfManyPagesEnds) {
    Model model;
    constexpr int pages = 200'000;
    for (int i = 0; i < pages; ++i) {
        const double angle = 2 * std::numbers::pi * i / pages;
        add_triangle(model, {0, 0, 0}, {0, 0, 1}, {float(std::cos(angle)), float(std::sin(angle)), 0});
    }
    compute_normals(model);
    EXPECT_GE(model.positions.size(), 3U * pages);
}

TEST(Weld, EqualPositionsAndNothingElse) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<Vec3f> positions{{1, 2, 3},       {1, 2, 4},   {0, 0, 0},   {1, 2, 3},
                                       {-0.F, 0, -0.F}, {nan, 0, 0}, {nan, 0, 0}, {1, 2, 4}};
    EXPECT_EQ(weld_positions(positions), (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 5, 5, 1}));
}

} // namespace
} // namespace spa
