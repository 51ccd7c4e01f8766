// SPDX-License-Identifier: Apache-2.0
#include "scratch.h"

#include "../../libspa/core/error.h"

#include <cmath>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

constexpr const char* triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(Obj, PositionsUvsNormalsAndTheirOrientation) {
    const auto result =
        Scratch().read("t.obj", std::string(triangle) + "vt 0.25 0.75\nvt 1\nvt 0 1 0.5\nvn 0 0 2\n"
                                                        "f 1/1/1 2/2/1 3/3/1\n");
    expect_valid(result);
    const Model& model = result.model;
    EXPECT_EQ(result.report.format, "OBJ");
    EXPECT_FALSE(result.report.computed_normals);
    ASSERT_EQ(model.positions.size(), 3U);
    const auto& v = model.triangles[0].vertex;
    EXPECT_EQ(model.positions[v[1]], (Vec3f{1, 0, 0}));
    EXPECT_EQ(model.uvs[v[0]], (Vec2f{0.25F, 0.25F})); // v turned over
    EXPECT_EQ(model.uvs[v[1]], (Vec2f{1, 1}));
    EXPECT_EQ(model.uvs[v[2]], (Vec2f{0, 0}));
    EXPECT_EQ(model.normals[v[0]], (Vec3f{0, 0, 1}));
}

TEST(Obj, CornersThatDifferInOneIndexAreVerticesOfTheirOwn) {
    const auto result =
        Scratch().read("t.obj", std::string(triangle) + "v 1 1 0\nvt 0 0\nvt 0.5 0\nvn 0 0 1\nvn 0 1 0\n"
                                                        "f 1/1/1 2/1/1 3/1/1\nf 2/2/1 4/1/1 3/1/2\n");
    const Model& model = result.model;
    EXPECT_EQ(model.positions.size(), 6U);
    EXPECT_EQ(model.uvs[model.triangles[0].vertex[1]], (Vec2f{0, 1}));
    EXPECT_EQ(model.uvs[model.triangles[1].vertex[0]], (Vec2f{0.5F, 1}));
    EXPECT_EQ(model.normals[model.triangles[0].vertex[2]], (Vec3f{0, 0, 1}));
    EXPECT_EQ(model.normals[model.triangles[1].vertex[2]], (Vec3f{0, 1, 0}));
}

TEST(Obj, RelativeIndicesCountBackFromTheirLine) {
    const auto result =
        Scratch().read("t.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf -4 -3 -2\n");
    ASSERT_EQ(result.model.triangles.size(), 2U);
    EXPECT_EQ(corners(result.model, 0), corners(result.model, 1));
    EXPECT_EQ(corners(result.model, 0)[0], (Vec3f{0, 0, 0}));
}

TEST(Obj, ConcavePolygonIsCoveredOnce) {
    const auto result = Scratch().read("t.obj", "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 3 4 5 1 2\n");
    EXPECT_EQ(result.model.triangles.size(), 3U);
    EXPECT_DOUBLE_EQ(area(result.model), 10);
    for (std::size_t t = 0; t < 3; ++t) {
        const auto [a, b, c] = corners(result.model, t);
        EXPECT_GT(cross(b - a, c - a).z, 0);
    }
}

TEST(Obj, FacesMayComeBeforeTheirVertices) {
    EXPECT_EQ(Scratch().read("t.obj", "f 1 2 3\n" + std::string(triangle)).model.triangles.size(), 1U);
}

TEST(Obj, LineContinuationsCommentsBlanksAndLineEnds) {
    const auto result =
        Scratch().read("t.obj", "\xEF\xBB\xBF# comment\r\n  v 0 0 \\\r\n 0\r\n\r\nv\t1 0 0 # here\r\n"
                                "v 0 1 0\r\nf 1 \\\r\n 2 \\\r\n 3");
    EXPECT_EQ(result.model.triangles.size(), 1U);
    EXPECT_TRUE(result.report.warnings.empty());
}

TEST(Obj, VertexColorsAreDisplayValues) {
    const auto result = Scratch().read("t.obj", "v 0 0 0 1 0.5 0\nv 1 0 0 1 1 1 1\nv 0 1 0\nf 1 2 3\n");
    const Model& model = result.model;
    ASSERT_EQ(model.colors.size(), model.positions.size());
    const auto& v = model.triangles[0].vertex;
    EXPECT_FLOAT_EQ(model.colors[v[0]].x, 1);
    EXPECT_NEAR(model.colors[v[0]].y, 0.21404, 1e-5); // sRGB 0.5
    EXPECT_FLOAT_EQ(model.colors[v[0]].z, 0);
    EXPECT_EQ(model.colors[v[2]], (Vec4f{1, 1, 1, 1})); // none given
}

TEST(Obj, SomeFacesWithoutNormalsGetThemComputed) {
    const auto result =
        Scratch().read("t.obj", std::string(triangle) + "vn 1 0 0\nf 1//1 2//1 3//1\nf 1 2 3\n");
    EXPECT_TRUE(result.report.computed_normals);
    ASSERT_EQ(result.model.triangles.size(), 2U);
    EXPECT_EQ(result.model.normals[result.model.triangles[0].vertex[0]], (Vec3f{1, 0, 0}));
    EXPECT_EQ(result.model.normals[result.model.triangles[1].vertex[0]], (Vec3f{0, 0, 1}));
}

TEST(Obj, NonManifoldAndDuplicateTrianglesStay) {
    const auto result = Scratch().read(
        "t.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 2 3\nf 3 2 1\n");
    EXPECT_EQ(result.model.triangles.size(), 5U);
}

TEST(Obj, DegenerateAndNonFiniteTrianglesAreCounted) {
    const auto result = Scratch().read("t.obj", std::string(triangle) +
                                                    "v nan 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\nf 1 2 5\nf 1 2 4\n"
                                                    "f 1 2 3 4\n");
    EXPECT_EQ(result.model.triangles.size(), 1U);
    EXPECT_EQ(result.report.dropped_degenerate, 2U);
    EXPECT_EQ(result.report.dropped_non_finite, 3U);
    EXPECT_TRUE(has_warning(result.report, "Dropped 3 triangles"));
}

TEST(Obj, UnreadableNumbersAndUnknownStatementsAreReported) {
    const auto result = Scratch().read("t.obj", std::string(triangle) + "v 1 x 0\nvw 1\nf 1 2 3\nf 1 2 4\n");
    EXPECT_EQ(result.model.triangles.size(), 1U);
    EXPECT_EQ(result.report.dropped_non_finite, 1U);
    EXPECT_TRUE(has_warning(result.report, "line 4: 'x' is not a number"));
    EXPECT_TRUE(has_warning(result.report, "line 5: 'vw' is an unknown statement"));
}

TEST(Obj, PointsAndLinesAreCountedAndAloneRefused) {
    const Scratch scratch;
    EXPECT_EQ(
        scratch.read("t.obj", std::string(triangle) + "f 1 2 3\nl 1 2\np 1\n").report.ignored_primitives, 2U);
    EXPECT_NE(scratch.refusal("l.obj", std::string(triangle) + "l 1 2 3\n").find("nothing to bake"),
              std::string::npos);
}

TEST(Obj, ErrorsNameTheLine) {
    struct Row {
        const char* face;
        const char* message;
    };
    const Row rows[] = {{"f 1 2 4\n", "line 4: the vertex index 4 is out of range; there are 3"},
                        {"f 0 1 2\n", "line 4: the vertex index 0 is out of range"},
                        {"f -4 1 2\n", "line 4: the vertex index -4 is out of range"},
                        {"f 1 2\n", "line 4: a face needs at least three vertices"},
                        {"f 1 2 x\n", "line 4: 'x' is not the index of a vertex"},
                        {"f 1 2 /3\n", "line 4: '/3' is no vertex of a face"},
                        {"f 1/1/1/1 2 3\n", "line 4: '1/1/1/1' has more than three indices"},
                        {"f 1 2 99999999999\n", "line 4: the vertex index 99999999999 is out of range"},
                        {"vt 0 0\nf 1/2 2/1 3/1\n", "line 5: the texture vertex index 2 is out of range"},
                        {"vn 0 0 1\nf 1//2 2//1 3//1\n", "line 5: the normal index 2 is out of range"},
                        {"v 1 2\n", "line 4: a vertex needs three coordinates, here are 2"},
                        {"vn 1 2\n", "line 4: a normal needs three components"}};
    const Scratch scratch;
    for (const Row& row : rows) {
        const std::string message = scratch.refusal("t.obj", std::string(triangle) + row.face);
        EXPECT_NE(message.find(row.message), std::string::npos) << message;
    }
}

TEST(Obj, LimitsHold) {
    const Scratch scratch;
    const auto path = scratch.write("t.obj", std::string(triangle) + "f 1 2 3\nf 1 2 3\n");
    import::Limits limits;
    limits.triangles = 1;
    EXPECT_THROW(import::read_model(path, limits), Error);
    limits.triangles = 2;
    limits.vertices = 2;
    EXPECT_THROW(import::read_model(path, limits), Error);
    limits.vertices = 3;
    EXPECT_NO_THROW(import::read_model(path, limits));
}

TEST(Obj, SameBytesSameModel) {
    const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nf 1 2 3\nf 2 4 3\nf 4 1 2\nf 1 4 3\n";
    const auto a = Scratch().read("t.obj", text);
    const auto b = Scratch().read("t.obj", text);
    EXPECT_EQ(a.model.positions, b.model.positions);
    EXPECT_EQ(a.model.normals, b.model.normals);
    EXPECT_EQ(a.report.files[0].xxh3, b.report.files[0].xxh3);
    EXPECT_EQ(a.report.files[0].name, "t.obj");
    EXPECT_EQ(a.report.files[0].bytes, text.size());
}

} // namespace
} // namespace spa::test
