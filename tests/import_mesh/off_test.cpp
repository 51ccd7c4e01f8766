// SPDX-License-Identifier: Apache-2.0
#include "scratch.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

constexpr const char* square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST(Off, CountsOnTheirOwnLineOrBesideTheKeywordOrWithoutIt) {
    for (const char* head : {"OFF\n4 1 0\n", "OFF 4 1 0\n", "OFF 4 1\n",
                             "# a comment\n\nOFF # more\n\n4 1 0 # end\n", "4 1 0\n"}) {
        const auto result = Scratch().read("t.off", head + std::string(square) + "4 0 1 2 3\n");
        expect_valid(result);
        EXPECT_EQ(result.report.format, "OFF");
        EXPECT_EQ(result.model.triangles.size(), 2U);
        EXPECT_DOUBLE_EQ(area(result.model), 1);
        EXPECT_TRUE(result.report.warnings.empty());
    }
}

TEST(Off, VertexAttributesInTheirOrder) {
    const auto result =
        Scratch().read("t.off", "STCNOFF\n3 1 0\n0 0 0  0 0 2  255 188 0 255  0.25 0.75\n"
                                "1 0 0  0 0 2  0 0 0 255  0 0\n0 1 0  0 0 2  0 0 0 51  0 0\n3 0 1 2\n");
    const auto& v = result.model.triangles[0].vertex;
    EXPECT_FALSE(result.report.computed_normals);
    EXPECT_EQ(result.model.normals[0], (Vec3f{0, 0, 1}));
    EXPECT_NEAR(result.model.colors[v[0]].y, 0.5029, 1e-4);
    EXPECT_FLOAT_EQ(result.model.colors[v[2]].w, 0.2F);
    EXPECT_EQ(result.model.uvs[v[0]], (Vec2f{0.25F, 0.25F}));
    EXPECT_EQ(result.model.materials[0].alpha_mode, AlphaMode::blend);
}

TEST(Off, FaceColors) {
    const auto result = Scratch().read("t.off", "OFF\n4 2 0\n" + std::string(square) +
                                                    "3 0 1 2 1.0 0 0\n3 0 2 3 0 1.0 0 1\n");
    EXPECT_EQ(result.model.colors[result.model.triangles[0].vertex[0]], (Vec4f{1, 0, 0, 1}));
    EXPECT_EQ(result.model.colors[result.model.triangles[1].vertex[0]], (Vec4f{0, 1, 0, 1}));
    const auto bytes = Scratch().read("t.off", "OFF\n4 2 0\n" + std::string(square) +
                                                   "3 0 1 2 255 0 0\n3 0 2 3 0 255 1 255\n");
    EXPECT_EQ(bytes.model.colors[bytes.model.triangles[0].vertex[0]], (Vec4f{1, 0, 0, 1}));
    // An index into a colour table says nothing.
    EXPECT_TRUE(
        Scratch().read("t.off", "OFF\n4 1 0\n" + std::string(square) + "4 0 1 2 3 7\n").model.colors.empty());
}

TEST(Off, ConcavePolygon) {
    const auto result =
        Scratch().read("t.off", "OFF\n5 1 0\n0 0 0\n4 0 0\n4 4 0\n2 1 0\n0 4 0\n5 2 3 4 0 1\n");
    EXPECT_EQ(result.model.triangles.size(), 3U);
    EXPECT_DOUBLE_EQ(area(result.model), 10);
}

TEST(Off, ErrorsNameTheLine) {
    struct Row {
        const char* text;
        const char* message;
    };
    const Row rows[] = {
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 6: the vertex index '3' is out of range"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "line 6: the vertex index '-1' is out of range"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n", "line 6: a face declares 3 vertices, more than"},
        {"OFF\n3 1 0\n0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n", "line 4: expected a coordinate, found 'x'"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0    \n  \n", "the file ends before face 1 of 1"},
        {"OFF\n999999999999 1 0\n0 0 0\n", "line 2: the header declares 999999999999 vertices"},
        {"OFF\n3 999999999999 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "999999999999 faces"},
        {"OFF\n-3 1 0\n", "line 2: expected the number of vertices, found '-3'"},
        {"OFF\n", "the file ends before the counts"},
        {"OFF BINARY\n", "binary OFF is not read"},
        {"4OFF\n1 1 0\n", "other than three dimensions"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "nothing to bake"}};
    const Scratch scratch;
    for (const Row& row : rows) {
        const std::string message = scratch.refusal("t.off", row.text);
        EXPECT_NE(message.find(row.message), std::string::npos) << message;
    }
}

} // namespace
} // namespace spa::test
