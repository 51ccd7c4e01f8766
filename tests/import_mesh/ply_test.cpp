// SPDX-License-Identifier: Apache-2.0
#include "scratch.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

// Appends a value's bytes in the given order.
template <class T>
void put(std::string& bytes, T value, bool big_endian) {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), &value, sizeof(T));
    if (big_endian != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
}

std::string header(const std::string& format, const std::string& rest) {
    return "ply\nformat " + format + " 1.0\n" + rest + "end_header\n";
}

constexpr const char* xyz = "property float x\nproperty float y\nproperty float z\n";
constexpr const char* faces = "property list uchar int vertex_indices\n";

std::string ascii_triangle(const std::string& vertex_properties, const std::array<std::string, 3>& extra) {
    return header("ascii",
                  "element vertex 3\n" + std::string(xyz) + vertex_properties + "element face 1\n" + faces) +
           "0 0 0 " + extra[0] + "\n1 0 0 " + extra[1] + "\n0 1 0 " + extra[2] + "\n3 0 1 2\n";
}

TEST(Ply, BothEndiansAllTypesAndUnknownElements) {
    for (const bool big : {false, true}) {
        std::string bytes =
            header(big ? "binary_big_endian" : "binary_little_endian",
                   "comment made by hand\n"
                   "element camera 1\nproperty double f\nproperty list ushort int16 ids\n"
                   "element face 1\nproperty uchar flag\nproperty list uint ushort vertex_index\n"
                   "element vertex 4\nproperty short id\nproperty double y\nproperty float x\n"
                   "property int8 z\nproperty list int uint8 other\nproperty ushort red\n"
                   "property ushort green\nproperty ushort blue\n");
        put(bytes, 1.0, big);
        put(bytes, std::uint16_t{2}, big);
        put(bytes, std::int16_t{-5}, big);
        put(bytes, std::int16_t{5}, big);
        put(bytes, std::uint8_t{9}, big);
        put(bytes, std::uint32_t{4}, big);
        for (const int i : {0, 1, 2, 3}) put(bytes, std::uint16_t(i), big);
        for (const auto& [x, y] : {std::pair{0.0F, 0.0}, {2.0F, 0.0}, {2.0F, 1.0}, {0.0F, 1.0}}) {
            put(bytes, std::int16_t{-1}, big);
            put(bytes, y, big);
            put(bytes, x, big);
            put(bytes, std::int8_t{-3}, big);
            put(bytes, std::int32_t{1}, big);
            put(bytes, std::uint8_t{7}, big);
            for (const int c : {65535, 0, 32768}) put(bytes, std::uint16_t(c), big);
        }
        const auto result = Scratch().read("t.ply", bytes);
        expect_valid(result);
        EXPECT_EQ(result.report.format, "PLY");
        EXPECT_EQ(result.model.triangles.size(), 2U);
        EXPECT_DOUBLE_EQ(area(result.model), 2);
        EXPECT_EQ(corners(result.model, 0)[2], (Vec3f{2, 1, -3}));
        EXPECT_EQ(result.model.normals[0], (Vec3f{0, 0, 1}));
        EXPECT_FLOAT_EQ(result.model.colors[0].x, 1);
        EXPECT_FLOAT_EQ(result.model.colors[0].y, 0);
        EXPECT_NEAR(result.model.colors[0].z, 0.21404, 1e-4);
        EXPECT_TRUE(result.report.warnings.empty());
    }
}

TEST(Ply, NormalsAndTextureCoordinates) {
    for (const char* names : {"property float u\nproperty float v\n", "property float s\nproperty float t\n",
                              "property float texture_u\nproperty float texture_v\n"}) {
        const auto result = Scratch().read(
            "t.ply",
            ascii_triangle(std::string("property float nx\nproperty float ny\nproperty float nz\n") + names,
                           {"0 3 0 0.25 0.75", "0 3 0 1 0", "0 3 0 0 1"}));
        EXPECT_FALSE(result.report.computed_normals);
        EXPECT_EQ(result.model.normals[0], (Vec3f{0, 1, 0}));
        EXPECT_EQ(result.model.uvs[result.model.triangles[0].vertex[0]], (Vec2f{0.25F, 0.25F}));
    }
}

TEST(Ply, ColorsByTypeAndAlpha) {
    const auto bytes = Scratch().read(
        "t.ply", ascii_triangle(
                     "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n",
                     {"255 188 0 255", "0 0 0 255", "0 0 0 51"}));
    const auto& v = bytes.model.triangles[0].vertex;
    EXPECT_NEAR(bytes.model.colors[v[0]].y, 0.5029, 1e-4); // sRGB code 188
    EXPECT_FLOAT_EQ(bytes.model.colors[v[2]].w, 0.2F);
    EXPECT_EQ(bytes.model.materials[0].alpha_mode, AlphaMode::blend);
    const auto floats = Scratch().read(
        "t.ply", ascii_triangle("property float red\nproperty float green\nproperty float blue\n",
                                {"1 0.5 0", "0 0 0", "0 0 0"}));
    EXPECT_NEAR(floats.model.colors[floats.model.triangles[0].vertex[0]].y, 0.21404, 1e-5);
    EXPECT_EQ(floats.model.materials[0].alpha_mode, AlphaMode::opaque);
    const auto zero = Scratch().read(
        "t.ply", ascii_triangle(
                     "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n",
                     {"255 0 0 0", "0 0 0 0", "0 0 0 0"}));
    EXPECT_TRUE(has_warning(zero.report, "alpha of all colours is 0"));
    EXPECT_EQ(zero.model.colors[0].w, 1);
}

TEST(Ply, FaceColorsTextureAndTextureCoordinatesOfCorners) {
    const Scratch scratch;
    const std::string text =
        header("ascii", "comment TextureFile my tex.tga\nelement vertex 4\n" + std::string(xyz) +
                            "element face 2\n" + faces +
                            "property list uchar float texcoord\nproperty uchar red\nproperty uchar green\n"
                            "property uchar blue\n") +
        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 6 0 0 1 0 1 1 255 0 0\n3 0 2 3 6 0 0 1 1 0 0.5 0 255 0\n";
    const auto plain = scratch.read("t.ply", text);
    EXPECT_TRUE(has_warning(plain.report, "'my tex.tga' is missing"));
    ASSERT_EQ(plain.model.colors.size(), plain.model.positions.size());
    EXPECT_EQ(plain.model.colors[plain.model.triangles[0].vertex[0]], (Vec4f{1, 0, 0, 1}));
    EXPECT_EQ(plain.model.colors[plain.model.triangles[1].vertex[0]], (Vec4f{0, 1, 0, 1}));
    scratch.write_tga("my tex.tga", 1, {{1, 2, 3, 255}});
    const auto textured = scratch.read("t.ply", text);
    EXPECT_TRUE(textured.model.colors.empty());
    EXPECT_EQ(textured.model.materials[0].texture, 0U);
    EXPECT_EQ(textured.model.positions.size(), 4U); // equal corners became one
    EXPECT_EQ(textured.model.uvs[textured.model.triangles[1].vertex[2]], (Vec2f{0, 0.5F}));
}

TEST(Ply, StripsAlternate) {
    const auto result = Scratch().read(
        "t.ply", header("ascii", "element vertex 5\n" + std::string(xyz) +
                                     "element tristrips 1\nproperty list int int vertex_indices\n") +
                     "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n9 0 1 2 3 4 -1 0 1 2\n");
    ASSERT_EQ(result.model.triangles.size(), 4U);
    for (std::size_t t = 0; t < 4; ++t) {
        const auto [a, b, c] = corners(result.model, t);
        EXPECT_GT(cross(b - a, c - a).z, 0);
    }
}

TEST(Ply, LineEndsInHeaderAndData) {
    std::string text = ascii_triangle("", {"", "", ""});
    std::string windows;
    for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    std::string mac = text;
    std::replace(mac.begin(), mac.end(), '\n', '\r');
    EXPECT_EQ(Scratch().read("t.ply", windows).model.triangles.size(), 1U);
    EXPECT_EQ(Scratch().read("t.ply", mac).model.triangles.size(), 1U);

    // Binary data that begins with the byte of a line feed belongs to the data.
    std::string binary = header("binary_little_endian", "element face 1\nproperty uchar skip\n" +
                                                            std::string(faces) + "element vertex 3\n" + xyz);
    std::replace(binary.begin(), binary.end(), '\n', '\r');
    binary += "\n\3";
    for (const std::int32_t i : {0, 1, 2}) put(binary, i, false);
    for (const float value : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) put(binary, value, false);
    EXPECT_EQ(Scratch().read("t.ply", binary).model.triangles.size(), 1U);
}

TEST(Ply, DataErrorsSayWhere) {
    struct Row {
        const char* data;
        const char* message;
    };
    const Row rows[] = {
        {"0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 13: the vertex index 3 is out of range; there are 3"},
        {"0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "line 13: the vertex index -1 is out of range"},
        {"0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n", "line 11: 'x' is not a number"},
        {"0 0 0\n1 0 0 7\n0 1 0\n3 0 1 2\n", "line 11: unexpected '7' after the last value"},
        {"0 0 0\n1 0 0\n0 1 0\n3 0 1", "a list declares 3 items, more than the rest of the file holds"},
        {"0 0 0\n1 0 0\n0        \n", "the file ends in the middle of the 'vertex' elements"},
        {"0 0 0\n1 0 0\n0 1 0\n200 0 1 2\n", "a list declares 200 items, more than"},
        {"0 0 0\n1 0 0\n0 1 0\n300 0 1 2\n", "'300' is not a whole number of the declared type"},
        {"0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n", "'1.5' is not a whole number of the declared type"}};
    const Scratch scratch;
    const std::string head =
        header("ascii", "element vertex 3\n" + std::string(xyz) + "element face 1\n" + faces);
    for (const Row& row : rows) {
        const std::string message = scratch.refusal("t.ply", head + row.data);
        EXPECT_NE(message.find(row.message), std::string::npos) << message;
    }
}

TEST(Ply, ClaimedSizesAreCheckedFirst) {
    const Scratch scratch;
    for (const char* format : {"ascii", "binary_little_endian"}) {
        for (const char* count : {"4000000000", "9000000000000000000", "1000"}) {
            const std::string head = header(format, "element vertex " + std::string(count) + "\n" + xyz +
                                                        "element face 1\n" + faces);
            const std::string message = scratch.refusal("t.ply", head + "0 0 0\n1 0 0\n");
            EXPECT_TRUE(message.find("more than") != std::string::npos) << message;
        }
    }
    // Rows without values are no data, however many.
    const auto result =
        scratch.read("t.ply", header("ascii", "element nothing 9000000000000000000\nelement vertex 3\n" +
                                                  std::string(xyz) + "element face 1\n" + faces) +
                                  "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    EXPECT_EQ(result.model.triangles.size(), 1U);
}

TEST(Ply, HeaderErrors) {
    struct Row {
        const char* header;
        const char* message;
    };
    const Row rows[] = {
        {"ply\nformat ascii 1.0\nelement vertex 1\nelement vertex 2\nend_header\n",
         "'vertex' is declared twice"},
        {"ply\nformat ascii 1.0\nproperty float x\nend_header\n", "line 3: a property comes before"},
        {"ply\nformat ascii 1.0\nelement vertex -1\nend_header\n", "line 3: the element count '-1'"},
        {"ply\nformat ascii 2.0\nend_header\n", "line 2: unknown version '2.0'"},
        {"ply\nelement face 0\nproperty list float int vertex_index\n", "must be of an integer type"},
        {"ply\nend_header\n", "no format line"},
        {"ply\nformat ascii 1.0\nformat ascii 1.0\nend_header\n", "declared twice"},
        {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float x\n",
         "'x' is declared twice"}};
    const Scratch scratch;
    for (const Row& row : rows) {
        const std::string message = scratch.refusal("t.ply", row.header);
        EXPECT_NE(message.find(row.message), std::string::npos) << message;
    }
}

} // namespace
} // namespace spa::test
