// SPDX-License-Identifier: Apache-2.0
// Vertices, indices and nodes against positions known by hand.
#include "gltf_builder.h"

#include <numbers>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

// The normal that a triangle's winding gives.
Vec3f winding(const Model& model, std::size_t triangle) {
    const auto [a, b, c] = corners(model, triangle);
    return normalize(cross(b - a, c - a));
}

// A 2 x 2 grid of quads in z = 0: vertex (x, y) is 3 y + x.
std::vector<float> grid_positions() {
    std::vector<float> values;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x) values.insert(values.end(), {float(x), float(y), 0});
    return values;
}

TEST(Geometry, PlainTriangle) {
    const import::Result result = import_both(triangle());
    ASSERT_EQ(result.model.triangles.size(), 1U);
    const auto [a, b, c] = corners(result.model, 0);
    EXPECT_EQ(a, (Vec3f{0, 0, 0}));
    EXPECT_EQ(b, (Vec3f{1, 0, 0}));
    EXPECT_EQ(c, (Vec3f{0, 1, 0}));
    EXPECT_EQ(result.model.normals[0], (Vec3f{0, 0, 1}));
    EXPECT_FALSE(result.report.computed_normals);
    EXPECT_TRUE(result.report.warnings.empty());
    EXPECT_TRUE(result.model.uvs.empty());
    EXPECT_TRUE(result.model.colors.empty());
    ASSERT_EQ(result.model.materials.size(), 1U);
    EXPECT_EQ(result.model.materials[0].base_color, (Vec4f{1, 1, 1, 1}));
    ASSERT_EQ(result.report.files.size(), 1U);
    EXPECT_EQ(result.report.files[0].name, "a.glb");
}

template <class T>
void expect_indexed() {
    GltfBuilder builder;
    const int positions = builder.add_accessor(grid_positions(), "VEC3");
    const int indices = builder.add_accessor<T>({0, 1, 4, 0, 4, 3, 4, 5, 8}, "SCALAR");
    builder.add_mesh({{"POSITION", positions}}, indices);
    const import::Result result = import_both(builder);
    ASSERT_EQ(result.model.triangles.size(), 3U);
    EXPECT_EQ(corners(result.model, 2)[0], (Vec3f{1, 1, 0}));
    EXPECT_EQ(corners(result.model, 2)[2], (Vec3f{2, 2, 0}));
    EXPECT_NEAR(area(result.model), 1.5, 1e-6);
    EXPECT_TRUE(result.report.computed_normals);
    EXPECT_EQ(result.model.positions.size(), 9U); // flat shading: no vertex is shared
    for (const Vec3f& normal : result.model.normals) EXPECT_EQ(normal, (Vec3f{0, 0, 1}));
}

TEST(Geometry, IndexTypes) {
    expect_indexed<std::uint8_t>();
    expect_indexed<std::uint16_t>();
    expect_indexed<std::uint32_t>();
}

TEST(Geometry, StripsAndFansKeepTheFront) {
    for (const int mode : {5, 6}) {
        GltfBuilder builder;
        const std::vector<float> strip{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0};
        const std::vector<float> fan{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 1, 0};
        const int positions = builder.add_accessor(mode == 5 ? strip : fan, "VEC3");
        builder.add_mesh({{"POSITION", positions}})["mode"] = mode;
        const import::Result result = import_both(builder);
        ASSERT_EQ(result.model.triangles.size(), 3U);
        for (std::size_t t = 0; t < 3; ++t) expect_near(winding(result.model, t), {0, 0, 1});
        EXPECT_NEAR(area(result.model), 1.5, 1e-6);
    }
}

TEST(Geometry, PointsAndLinesAreCounted) {
    GltfBuilder builder = triangle();
    Json& primitives = builder.json["meshes"][0]["primitives"];
    for (const int mode : {0, 1, 2, 3}) {
        primitives.push_back(primitives[0]);
        primitives.back()["mode"] = mode;
    }
    const import::Result result = import_both(builder);
    EXPECT_EQ(result.model.triangles.size(), 1U);
    EXPECT_EQ(result.report.ignored_primitives, 4U);

    primitives.erase(0);
    EXPECT_NE(refusal(builder).find("nothing to bake: no triangle is left, 4 primitives are points or lines"),
              std::string::npos);
}

TEST(Geometry, Interleaved) {
    GltfBuilder builder;
    std::string bytes;
    for (const float value : {0.F, 0.F, 0.F, 0.F, 0.F, 1.F, 9.F, 2.F, 0.F, 0.F, 0.F,
                              0.F, 1.F, 9.F, 0.F, 3.F, 0.F, 0.F, 0.F, 1.F, 9.F})
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    const int view = builder.add_view(bytes, 28);
    const int positions = builder.add_accessor(view, 0, 5126, 3, "VEC3");
    const int normals = builder.add_accessor(view, 12, 5126, 3, "VEC3");
    builder.add_mesh({{"POSITION", positions}, {"NORMAL", normals}});
    const import::Result result = import_both(builder);
    EXPECT_EQ(corners(result.model, 0)[2], (Vec3f{0, 3, 0}));
    EXPECT_EQ(result.model.normals[2], (Vec3f{0, 0, 1}));
}

TEST(Geometry, NormalizedIntegers) {
    GltfBuilder builder;
    std::vector<std::int16_t> shorts{32767, 0, 0, 0, 0, 32767, 0, 0, -32768, 0, 0, 0};
    const int view = builder.add_view({reinterpret_cast<const char*>(shorts.data()), 24}, 8);
    const int positions = builder.add_accessor(view, 0, 5122, 3, "VEC3", true);
    std::vector<std::int8_t> bytes{0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0};
    const int normal_view = builder.add_view({reinterpret_cast<const char*>(bytes.data()), 12}, 4);
    const int normals = builder.add_accessor(normal_view, 0, 5120, 3, "VEC3", true);
    builder.add_mesh({{"POSITION", positions}, {"NORMAL", normals}});
    builder.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    builder.json["nodes"][0]["scale"] = {2, 2, 2};
    const import::Result result = import_both(builder);
    EXPECT_EQ(corners(result.model, 0)[0], (Vec3f{2, 0, 0}));
    EXPECT_EQ(corners(result.model, 0)[1], (Vec3f{0, 2, 0}));
    EXPECT_EQ(corners(result.model, 0)[2], (Vec3f{-2, 0, 0})); // -32768/32767 is held at -1
}

TEST(Geometry, UnnormalizedIntegers) {
    GltfBuilder builder;
    std::vector<std::uint16_t> shorts{0, 0, 0, 0, 300, 0, 0, 0, 0, 65535, 0, 0};
    const int view = builder.add_view({reinterpret_cast<const char*>(shorts.data()), 24}, 8);
    builder.add_mesh({{"POSITION", builder.add_accessor(view, 0, 5123, 3, "VEC3")}});
    const import::Result result = import_both(builder);
    EXPECT_EQ(corners(result.model, 0)[1], (Vec3f{300, 0, 0}));
    EXPECT_EQ(corners(result.model, 0)[2], (Vec3f{0, 65535, 0}));
}

GltfBuilder sparse_triangle(bool with_base) {
    GltfBuilder builder = triangle();
    const std::vector<std::uint16_t> indices{1, 2};
    const std::vector<float> values{5, 0, 0, 0, 7, 0};
    const int index_view = builder.add_view({reinterpret_cast<const char*>(indices.data()), 4});
    const int value_view = builder.add_view({reinterpret_cast<const char*>(values.data()), 24});
    Json& accessor = builder.json["accessors"][0];
    if (!with_base) accessor.erase("bufferView");
    accessor["sparse"] = {{"count", 2},
                          {"indices", {{"bufferView", index_view}, {"componentType", 5123}}},
                          {"values", {{"bufferView", value_view}}}};
    return builder;
}

TEST(Geometry, SparseAccessors) {
    for (const bool with_base : {true, false}) {
        const import::Result result = import_both(sparse_triangle(with_base));
        EXPECT_EQ(corners(result.model, 0)[0], (Vec3f{0, 0, 0}));
        EXPECT_EQ(corners(result.model, 0)[1], (Vec3f{5, 0, 0}));
        EXPECT_EQ(corners(result.model, 0)[2], (Vec3f{0, 7, 0}));
    }
    GltfBuilder wrong = sparse_triangle(true);
    wrong.json["accessors"][0]["sparse"]["count"] = 4;
    EXPECT_NE(refusal(wrong).find("accessors[0].sparse.count"), std::string::npos);
    wrong = sparse_triangle(true);
    wrong.json["accessors"][0]["sparse"]["indices"]["componentType"] = 5121; // reads indices 1, 0
    EXPECT_NE(refusal(wrong).find("sparse index 0 at position 1"), std::string::npos);
}

TEST(Geometry, NodeHierarchy) {
    GltfBuilder builder = triangle();
    const double half = std::numbers::sqrt2 / 2;
    // Parent: turn by 90 degrees about z and move; child: scale, column-major matrix.
    builder.json["nodes"] = {
        {{"mesh", 0}, {"matrix", {2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 0, 0, 1, 1}}},
        {{"children", {0}}, {"rotation", {0, 0, half, half}}, {"translation", {10, 0, 0}}}};
    builder.json["scenes"][0]["nodes"] = {1};
    const import::Result result = import_both(builder);
    const auto [a, b, c] = corners(result.model, 0);
    expect_near(a, {10, 0, 1});
    expect_near(b, {10, 2, 1});
    expect_near(c, {7, 0, 1});
    expect_near(result.model.normals[0], {0, 0, 1});
}

TEST(Geometry, MirroredNodesKeepTheFront) {
    for (const Json& scale : {Json{-1, 1, 1}, Json{1, 1, -1}, Json{-2, -3, -4}, Json{-1, -1, 1}}) {
        GltfBuilder builder = triangle();
        builder.json["nodes"][0]["scale"] = scale;
        const import::Result result = import_both(builder);
        // The front was at +z; a mirror in z turns it.
        const float side = scale[2].get<float>() < 0 ? -1.0F : 1.0F;
        expect_near(winding(result.model, 0), {0, 0, side});
        expect_near(result.model.normals[0], {0, 0, side});
    }
}

TEST(Geometry, NonUniformScaleAndShearBendNormals) {
    GltfBuilder builder;
    // A plane x + y = 1.
    const int positions = builder.add_accessor<float>({1, 0, 0, 0, 1, 0, 1, 0, 1}, "VEC3");
    const float r = std::numbers::sqrt2_v<float> / 2;
    const int normals = builder.add_accessor<float>({r, r, 0, r, r, 0, r, r, 0}, "VEC3");
    builder.add_mesh({{"POSITION", positions}, {"NORMAL", normals}});
    builder.json["nodes"][0]["matrix"] = {4, 0, 0, 0, 1, 2, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1};
    const import::Result result = import_both(builder);
    const auto [a, b, c] = corners(result.model, 0);
    const Vec3f normal = result.model.normals[0];
    EXPECT_NEAR(dot(normal, b - a), 0, 1e-6F);
    EXPECT_NEAR(dot(normal, c - a), 0, 1e-6F);
    EXPECT_GT(normal.x, 0);
}

TEST(Geometry, InstancedMesh) {
    GltfBuilder builder = triangle();
    builder.json["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 5}}});
    builder.json["scenes"][0]["nodes"] = {0, 1};
    const import::Result result = import_both(builder);
    ASSERT_EQ(result.model.triangles.size(), 2U);
    EXPECT_EQ(corners(result.model, 0)[0], (Vec3f{0, 0, 0}));
    EXPECT_EQ(corners(result.model, 1)[0], (Vec3f{0, 0, 5}));
}

TEST(Geometry, GpuInstancing) {
    GltfBuilder builder = triangle();
    const int translations = builder.add_accessor<float>({1, 0, 0, 2, 0, 0}, "VEC3");
    const int rotations = builder.add_accessor<std::int8_t>({0, 0, 0, 127, 0, 0, 127, 0}, "VEC4", true);
    const int scales = builder.add_accessor<float>({1, 1, 1, 2, 2, 2}, "VEC3");
    builder.json["nodes"][0]["translation"] = {0, 100, 0};
    builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", translations}, {"ROTATION", rotations}, {"SCALE", scales}};
    builder.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const import::Result result = import_both(builder);
    ASSERT_EQ(result.model.triangles.size(), 2U);
    expect_near(corners(result.model, 0)[1], {2, 100, 0});
    expect_near(corners(result.model, 1)[1], {0, 100, 0}, 1e-5F); // turned by 180 degrees, twice as large
    expect_near(corners(result.model, 1)[2], {2, 98, 0}, 1e-5F);
}

TEST(Geometry, Scenes) {
    GltfBuilder builder = triangle();
    builder.json["nodes"] = {{{"mesh", 0}},
                             {{"mesh", 0}, {"translation", {0, 0, 1}}, {"children", {2}}},
                             {{"mesh", 0}, {"translation", {0, 0, 1}}}};
    builder.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
    const auto count = [&] { return import_both(builder).model.triangles.size(); };
    builder.json["scene"] = 1;
    EXPECT_EQ(count(), 2U);
    builder.json.erase("scene"); // the first one
    EXPECT_EQ(count(), 1U);
    builder.json.erase("scenes"); // all roots
    EXPECT_EQ(count(), 3U);
    // A child that the scene lists too is drawn once, where its parent puts it.
    builder.json["scenes"] = {{{"nodes", {2, 1}}}};
    const import::Result listed = import_both(builder);
    ASSERT_EQ(listed.model.triangles.size(), 2U);
    EXPECT_EQ(corners(listed.model, 1)[0].z, 2);
    EXPECT_TRUE(has_warning(listed.report, "node 2 is not a root"));
    // Two parents: drawn below each.
    builder.json["nodes"][0]["children"] = {2};
    builder.json["scenes"] = {{{"nodes", {0, 1}}}};
    const import::Result shared = import_both(builder);
    EXPECT_EQ(shared.model.triangles.size(), 4U);
    EXPECT_TRUE(has_warning(shared.report, "nodes[2]: has more than one parent"));
}

TEST(Geometry, NotFiniteAndDegenerateTrianglesAreCounted) {
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    GltfBuilder builder;
    const int positions =
        builder.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, inf, 0, 0, 0, nan, 0, 2, 0, 0}, "VEC3");
    const int normals =
        builder.add_accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    const int indices =
        builder.add_accessor<std::uint8_t>({0, 1, 2, 0, 1, 3, 0, 1, 4, 0, 0, 1, 0, 1, 5}, "SCALAR");
    builder.add_mesh({{"POSITION", positions}, {"NORMAL", normals}}, indices);
    const import::Result result = import_both(builder);
    EXPECT_EQ(result.model.triangles.size(), 1U);
    EXPECT_EQ(result.model.positions.size(), 3U); // what is not used goes, so that bounds are right
    EXPECT_EQ(result.report.dropped_non_finite, 2U);
    EXPECT_EQ(result.report.dropped_degenerate, 2U);
    EXPECT_TRUE(has_warning(result.report, "2 triangles have corners that are not finite"));
}

TEST(Geometry, BadNormalsAreComputed) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    GltfBuilder builder;
    const int positions = builder.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    const int normals = builder.add_accessor<float>({0, 0, 0, nan, 0, 1, 0, 0, 5}, "VEC3");
    builder.add_mesh({{"POSITION", positions}, {"NORMAL", normals}});
    const import::Result result = import_both(builder);
    for (const Vec3f& normal : result.model.normals) EXPECT_EQ(normal, (Vec3f{0, 0, 1}));
    EXPECT_TRUE(has_warning(result.report, "2 normals have no direction"));
}

TEST(Geometry, FewTrianglesOfAManyVertexBuffer) {
    GltfBuilder builder;
    std::vector<float> values;
    for (int i = 0; i < 1000; ++i) values.insert(values.end(), {float(i), float(i * i % 7), float(i % 3)});
    const int positions = builder.add_accessor(values, "VEC3");
    const std::vector<float> up(values.size(), 1);
    const int normals = builder.add_accessor(up, "VEC3");
    const int indices = builder.add_accessor<std::uint16_t>({999, 3, 500}, "SCALAR");
    builder.add_mesh({{"POSITION", positions}, {"NORMAL", normals}}, indices);
    const import::Result result = import_both(builder);
    EXPECT_EQ(result.model.positions.size(), 3U);
    EXPECT_EQ(corners(result.model, 0)[0].x, 999);
    EXPECT_EQ(corners(result.model, 0)[1].x, 3);
    EXPECT_EQ(corners(result.model, 0)[2].x, 500);
}

TEST(Geometry, IndexOutOfRange) {
    GltfBuilder builder = triangle();
    const int indices = builder.add_accessor<std::uint16_t>({0, 1, 3}, "SCALAR");
    builder.json["meshes"][0]["primitives"][0]["indices"] = indices;
    EXPECT_NE(refusal(builder).find("index 3 at position 2 is out of range (3 vertices)"), std::string::npos);
}

TEST(Geometry, Limits) {
    const Scratch scratch;
    const std::filesystem::path path = scratch.write("a.glb", triangle().glb());
    import::Limits limits;
    limits.triangles = 0;
    EXPECT_THROW(import::read_model(path, limits), std::exception);
    limits = {};
    limits.vertices = 2;
    EXPECT_THROW(import::read_model(path, limits), std::exception);
    limits = {};
    limits.file_bytes = 10;
    EXPECT_THROW(import::read_model(path, limits), std::exception);
}

} // namespace
} // namespace spa::test
