// SPDX-License-Identifier: Apache-2.0
// Base colours, textures and what chooses between them.
#include "gltf_builder.h"

#include "../../libspa/core/error.h"

#include <numbers>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

// A grey PNG of one pixel, level 0x80: made by hand, stored without compression.
const std::string& png() {
    static const std::string bytes = [] {
        const unsigned char raw[] = {0x89, 'P',  'N',  'G',  0x0D, 0x0A, 0x1A, 0x0A, 0x00, 0x00, 0x00, 0x0D,
                                     'I',  'H',  'D',  'R',  0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01,
                                     0x08, 0x00, 0x00, 0x00, 0x00, 0x3A, 0x7E, 0x9B, 0x55, 0x00, 0x00, 0x00,
                                     0x0D, 'I',  'D',  'A',  'T',  0x78, 0x01, 0x01, 0x02, 0x00, 0xFD, 0xFF,
                                     0x00, 0x80, 0x00, 0x82, 0x00, 0x81, 0xC3, 0x6E, 0x25, 0xE0, 0x00, 0x00,
                                     0x00, 0x00, 'I',  'E',  'N',  'D',  0xAE, 0x42, 0x60, 0x82};
        return std::string(reinterpret_cast<const char*>(raw), sizeof raw);
    }();
    return bytes;
}

// A textured triangle: uv set 0 is (u, v) = (x, y), set 1 is (0.5, 0.25) everywhere.
GltfBuilder textured() {
    GltfBuilder builder = triangle();
    const int image = builder.add_view(png());
    const int uv0 = builder.add_accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2");
    const int uv1 =
        builder.add_accessor<std::uint8_t>({51, 204, 0, 0, 51, 204, 0, 0, 51, 204, 0, 0}, "VEC2", true);
    builder.json["accessors"][std::size_t(uv1)]["count"] = 3;
    builder.json["bufferViews"].back()["byteStride"] = 4;
    Json& primitive = builder.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = uv0;
    primitive["attributes"]["TEXCOORD_1"] = uv1;
    primitive["material"] = 0;
    builder.json["images"] = {{{"bufferView", image}, {"mimeType", "image/png"}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    return builder;
}

Json& base_texture(GltfBuilder& builder) {
    return builder.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
}

TEST(Material, Properties) {
    GltfBuilder builder = textured();
    Json& material = builder.json["materials"][0];
    material["name"] = "paint";
    material["alphaMode"] = "MASK";
    material["alphaCutoff"] = 0.25;
    material["doubleSided"] = true;
    material["pbrMetallicRoughness"]["baseColorFactor"] = {0.5, 0.25, 1, 0.75};
    builder.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    builder.json["textures"][0]["sampler"] = 0;
    const import::Result result = import_both(builder);
    const Material& out = result.model.materials[0];
    EXPECT_EQ(out.name, "paint");
    EXPECT_EQ(out.alpha_mode, AlphaMode::mask);
    EXPECT_EQ(out.alpha_cutoff, 0.25F);
    EXPECT_TRUE(out.double_sided);
    EXPECT_EQ(out.base_color, (Vec4f{0.5F, 0.25F, 1, 0.75F}));
    EXPECT_EQ(out.wrap_u, Wrap::clamp_to_edge);
    EXPECT_EQ(out.wrap_v, Wrap::mirrored_repeat);
    EXPECT_TRUE(out.nearest);
    ASSERT_EQ(out.texture, 0U);
    const Image& image = result.model.textures[0].mips[0];
    EXPECT_EQ(image.width, 1U);
    EXPECT_EQ(image.pixels[0], (std::array<std::uint8_t, 4>{0x80, 0x80, 0x80, 255}));
    EXPECT_EQ(result.model.uvs[1], (Vec2f{1, 0}));
    EXPECT_TRUE(result.report.warnings.empty());
}

TEST(Material, Defaults) {
    const Material out = import_both(textured()).model.materials[0];
    EXPECT_EQ(out.base_color, (Vec4f{1, 1, 1, 1}));
    EXPECT_EQ(out.alpha_mode, AlphaMode::opaque);
    EXPECT_EQ(out.alpha_cutoff, 0.5F);
    EXPECT_EQ(out.wrap_u, Wrap::repeat);
    EXPECT_FALSE(out.nearest);
    EXPECT_FALSE(out.double_sided);
}

TEST(Material, SecondUvSet) {
    GltfBuilder builder = textured();
    base_texture(builder)["texCoord"] = 1;
    EXPECT_EQ(import_both(builder).model.uvs[0], (Vec2f{0.2F, 0.8F}));
}

TEST(Material, TextureTransform) {
    GltfBuilder builder = textured();
    Json& transform = base_texture(builder)["extensions"]["KHR_texture_transform"];
    transform = {{"offset", {0.5, 0.25}}, {"scale", {2, 3}}, {"rotation", std::numbers::pi / 2}};
    builder.json["extensionsRequired"] = {"KHR_texture_transform"};
    const Model model = import_both(builder).model;
    // uv (1, 0) is scaled to (2, 0) and turned to (0, -2); (0, 1) to (0, 3) and to (3, 0).
    EXPECT_NEAR(model.uvs[1].x, 0.5, 1e-6);
    EXPECT_NEAR(model.uvs[1].y, -1.75, 1e-6);
    EXPECT_NEAR(model.uvs[2].x, 3.5, 1e-6);
    EXPECT_NEAR(model.uvs[2].y, 0.25, 1e-6);
    transform = {{"texCoord", 1}};
    EXPECT_EQ(import_both(builder).model.uvs[0], (Vec2f{0.2F, 0.8F}));
}

struct TexturedTriangle {
    std::string texture;
    Vec3f center;
    std::size_t index = 0;
};

std::vector<TexturedTriangle> textured_triangles(const Model& model) {
    std::vector<TexturedTriangle> out;
    for (std::size_t t = 0; t < model.triangles.size(); ++t) {
        const Material& material = model.materials[model.triangle_materials[t]];
        const auto [a, b, c] = corners(model, t);
        out.push_back({model.textures[material.texture].name, (a + b + c) * (1.0F / 3), t});
    }
    return out;
}

// The uv that the plane of a triangle has at a point, by its edges.
Vec2f uv_at(const Model& model, std::size_t triangle, Vec3f point) {
    const auto [a, b, c] = corners(model, triangle);
    const Vec3f ab = b - a, ac = c - a, ap = point - a;
    const float det = ab.x * ac.y - ab.y * ac.x;
    const float s = (ap.x * ac.y - ap.y * ac.x) / det, t = (ab.x * ap.y - ab.y * ap.x) / det;
    const auto& v = model.triangles[triangle].vertex;
    const Vec2f ua = model.uvs[v[0]];
    return ua + (model.uvs[v[1]] - ua) * s + (model.uvs[v[2]] - ua) * t;
}

// In this asset an arrow along u = v must point to the green markers and not to the red ones.
TEST(Material, TextureTransformTestPointsTheArrowsRight) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS";
    const Model model =
        import::read_model(assets() / "gltf/TextureTransformTest/TextureTransformTest.gltf").model;
    const std::vector<TexturedTriangle> triangles = textured_triangles(model);
    std::size_t right = 0, wrong = 0;
    for (const TexturedTriangle& marker : triangles) {
        if (marker.texture != "Correct.png" && marker.texture != "Error.png") continue;
        const TexturedTriangle* nearest = nullptr;
        for (const TexturedTriangle& arrow : triangles) {
            if (arrow.texture != "Arrow.png") continue;
            if (nearest == nullptr ||
                length(arrow.center - marker.center) < length(nearest->center - marker.center))
                nearest = &arrow;
        }
        ASSERT_NE(nearest, nullptr);
        const Vec2f uv = uv_at(model, nearest->index, marker.center);
        if (marker.texture == "Correct.png") {
            EXPECT_NEAR(uv.x, uv.y, 0.1F);
            ++right;
        } else {
            EXPECT_GT(std::abs(uv.x - uv.y), 0.3F);
            ++wrong;
        }
    }
    EXPECT_EQ(right, 6U); // two triangles a marker
    EXPECT_EQ(wrong, 2U);
}

TEST(Material, MissingUvSetIsDrawnWithoutTexture) {
    GltfBuilder builder = textured();
    base_texture(builder)["texCoord"] = 7;
    const import::Result result = import_both(builder);
    EXPECT_EQ(result.model.materials[result.model.triangle_materials[0]].texture, no_index);
    EXPECT_TRUE(has_warning(result.report, "has no TEXCOORD_7"));
}

TEST(Material, SpecularGlossinessBeatsMetallicRoughness) {
    GltfBuilder builder = textured();
    builder.json["materials"][0]["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
        {"diffuseFactor", {0.1, 0.2, 0.3, 0.4}}, {"diffuseTexture", {{"index", 0}, {"texCoord", 1}}}};
    builder.json["materials"][0]["pbrMetallicRoughness"] = Json::object();
    const import::Result result = import_both(builder);
    EXPECT_EQ(result.model.materials[0].base_color, (Vec4f{0.1F, 0.2F, 0.3F, 0.4F}));
    EXPECT_EQ(result.model.materials[0].texture, 0U);
    EXPECT_EQ(result.model.uvs[0], (Vec2f{0.2F, 0.8F}));
}

TEST(Material, VertexColors) {
    GltfBuilder builder = triangle();
    Json& attributes = builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["COLOR_0"] = builder.add_accessor<float>({1, 0.5, 0, 0, 1, 0.25, 0, 0, 1}, "VEC3");
    EXPECT_EQ(import_both(builder).model.colors[0], (Vec4f{1, 0.5F, 0, 1}));
    attributes["COLOR_0"] =
        builder.add_accessor<std::uint8_t>({255, 0, 51, 102, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4", true);
    EXPECT_EQ(import_both(builder).model.colors[0], (Vec4f{1, 0, 0.2F, 0.4F}));
    attributes["COLOR_0"] =
        builder.add_accessor<std::uint16_t>({65535, 0, 13107, 26214, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4", true);
    EXPECT_EQ(import_both(builder).model.colors[0], (Vec4f{1, 0, 0.2F, 0.4F}));
    attributes["COLOR_0"] = builder.add_accessor<float>({2, -1, 0.5, 0, 0, 0, 0, 0, 0}, "VEC3");
    const import::Result clamped = import_both(builder);
    EXPECT_EQ(clamped.model.colors[0], (Vec4f{1, 0, 0.5F, 1}));
    EXPECT_TRUE(has_warning(clamped.report, "values outside [0, 1]"));
}

TEST(Material, ColorsOfSomePrimitivesOnly) {
    GltfBuilder builder = triangle();
    Json& primitives = builder.json["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);
    primitives.push_back(primitives[0]);
    primitives[1]["attributes"]["COLOR_0"] = builder.add_accessor<float>({0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3");
    const Model model = import_both(builder).model;
    ASSERT_EQ(model.colors.size(), 9U);
    EXPECT_EQ(model.colors[0], (Vec4f{1, 1, 1, 1}));
    EXPECT_EQ(model.colors[3], (Vec4f{0, 1, 0, 1}));
    EXPECT_EQ(model.colors[8], (Vec4f{1, 1, 1, 1}));
}

TEST(Material, SharedImagesAreDecodedOnce) {
    GltfBuilder builder = textured();
    builder.json["textures"].push_back({{"source", 0}});
    builder.json["materials"].push_back(builder.json["materials"][0]);
    builder.json["materials"][1]["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 1;
    Json& primitives = builder.json["meshes"][0]["primitives"];
    primitives.push_back(primitives[0]);
    primitives[1]["material"] = 1;
    const Model model = import_both(builder).model;
    EXPECT_EQ(model.textures.size(), 1U);
    EXPECT_EQ(model.materials[1].texture, 0U);
}

TEST(Material, ImageFiles) {
    const Scratch scratch;
    scratch.write("maps/my paint.png", png());
    GltfBuilder builder = textured();
    builder.json["images"] = {{{"uri", "maps/my%20paint.png"}}};
    const import::Result result = scratch.read("a.glb", builder.glb());
    ASSERT_EQ(result.report.files.size(), 2U);
    EXPECT_EQ(result.report.files[1].name, "maps/my paint.png");
    EXPECT_EQ(result.report.files[1].bytes, png().size());
    EXPECT_NE(result.report.files[1].xxh3, 0U);

    builder.json["images"] = {{{"uri", "maps/none.png"}}};
    EXPECT_NE(scratch.refusal("a.glb", builder.glb())
                  .find("images[0].uri: the file 'maps/none.png' does not exist"),
              std::string::npos);
    scratch.write("maps/none.png", "this is no picture at all");
    EXPECT_NE(scratch.refusal("a.glb", builder.glb()).find("maps/none.png: cannot be decoded"),
              std::string::npos);

    // Where no base colour needs the image, it is worth a warning.
    builder.json["images"] = {{{"uri", "maps/other.png"}}};
    builder.json["materials"][0] = {{"normalTexture", {{"index", 0}}}};
    const import::Result other = scratch.read("a.glb", builder.glb());
    EXPECT_TRUE(has_warning(other.report, "the file 'maps/other.png' does not exist"));
    EXPECT_TRUE(other.model.textures.empty());
}

TEST(Material, DataUriImage) {
    GltfBuilder builder = textured();
    builder.json["images"] = {{{"uri", "data:image/png;base64," + base64(png())}}};
    EXPECT_EQ(import_both(builder).model.textures.size(), 1U);
}

ExitCode code_of(const GltfBuilder& builder, std::string& message) {
    const Scratch scratch;
    try {
        (void)scratch.read("a.glb", builder.glb());
    } catch (const Error& error) {
        message = error.what();
        return error.code();
    }
    return ExitCode::ok;
}

TEST(Material, Extensions) {
    GltfBuilder builder = textured();
    std::string message;
    for (const char* name :
         {"KHR_materials_unlit", "KHR_materials_sheen", "KHR_lights_punctual", "KHR_xmp_json_ld"}) {
        builder.json["extensionsRequired"] = {name};
        EXPECT_EQ(code_of(builder, message), ExitCode::ok) << name;
    }
    for (const char* name : {"KHR_texture_basisu", "VENDOR_anything", "KHR_gaussian_splatting"}) {
        builder.json["extensionsRequired"] = {name};
        EXPECT_EQ(code_of(builder, message), ExitCode::unsupported) << name;
        EXPECT_NE(message.find(name), std::string::npos);
    }
    // Not required, but the texture has nothing else.
    builder = textured();
    builder.json["textures"][0] = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
    EXPECT_EQ(code_of(builder, message), ExitCode::unsupported);
    EXPECT_NE(message.find("KHR_texture_basisu"), std::string::npos);
}

} // namespace
} // namespace spa::test
