// SPDX-License-Identifier: Apache-2.0
#include "gltf_builder.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

void put_u32(std::string& out, std::size_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 0xFFU);
}

} // namespace

std::size_t GltfBuilder::components(const std::string& type) {
    if (type == "SCALAR") return 1;
    const auto digit = static_cast<std::size_t>(type.back() - '0');
    return type[0] == 'M' ? digit * digit : digit;
}

int GltfBuilder::add_view(std::string_view bytes, int stride) {
    Json view{{"buffer", 0}, {"byteOffset", bin_.size()}, {"byteLength", bytes.size()}};
    if (stride != 0) view["byteStride"] = stride;
    json["bufferViews"].push_back(view);
    bin_ += bytes;
    while (bin_.size() % 4 != 0) bin_ += '\0';
    return static_cast<int>(json["bufferViews"].size()) - 1;
}

int GltfBuilder::add_accessor(int view, std::size_t offset, int component, std::size_t count,
                              const char* type, bool normalized) {
    Json accessor{{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}};
    if (offset != 0) accessor["byteOffset"] = offset;
    if (normalized) accessor["normalized"] = true;
    json["accessors"].push_back(accessor);
    return static_cast<int>(json["accessors"].size()) - 1;
}

Json& GltfBuilder::add_mesh(const Json& attributes, int indices) {
    Json primitive{{"attributes", attributes}};
    if (indices >= 0) primitive["indices"] = indices;
    json["meshes"].push_back({{"primitives", Json::array({primitive})}});
    json["nodes"].push_back({{"mesh", json["meshes"].size() - 1}});
    json["scene"] = 0;
    json["scenes"][0]["nodes"].push_back(json["nodes"].size() - 1);
    return json["meshes"].back()["primitives"][0];
}

Json GltfBuilder::finished() const {
    Json out = json;
    if (!bin_.empty() && !out.contains("buffers"))
        out["buffers"] = Json::array({{{"byteLength", bin_.size()}}});
    return out;
}

std::string GltfBuilder::text() const {
    Json out = finished();
    if (!bin_.empty() && !out["buffers"][0].contains("uri"))
        out["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(bin_);
    return out.dump();
}

std::string GltfBuilder::glb() const {
    std::string text = finished().dump();
    while (text.size() % 4 != 0) text += ' ';
    std::string out = "glTF";
    put_u32(out, 2);
    put_u32(out, 20 + text.size() + (bin_.empty() ? 0 : 8 + bin_.size()));
    put_u32(out, text.size());
    out += "JSON" + text;
    if (bin_.empty()) return out;
    put_u32(out, bin_.size());
    out += std::string("BIN\0", 4) + bin_;
    return out;
}

GltfBuilder triangle() {
    GltfBuilder builder;
    const int positions = builder.add_accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    const int normals = builder.add_accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    builder.json["accessors"][0]["min"] = {0, 0, 0};
    builder.json["accessors"][0]["max"] = {1, 1, 0};
    builder.add_mesh({{"POSITION", positions}, {"NORMAL", normals}});
    return builder;
}

std::string base64(std::string_view bytes) {
    const char* const alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            out +=
                i + k <= bytes.size() && k <= bytes.size() - i ? alphabet[bits >> (18 - 6 * k) & 63U] : '=';
    }
    return out;
}

Result import_both(const GltfBuilder& builder) {
    const Scratch scratch;
    const import::Result binary = scratch.read("a.glb", builder.glb());
    const import::Result text = scratch.read("a.gltf", builder.text());
    expect_valid(binary);
    EXPECT_EQ(binary.report.format, "GLB");
    EXPECT_EQ(text.report.format, "glTF");
    EXPECT_EQ(binary.model.positions, text.model.positions);
    EXPECT_EQ(binary.model.normals, text.model.normals);
    EXPECT_EQ(binary.model.uvs, text.model.uvs);
    EXPECT_EQ(binary.model.colors, text.model.colors);
    EXPECT_EQ(binary.report.warnings, text.report.warnings);
    return binary;
}

std::string refusal(const GltfBuilder& builder) {
    const Scratch scratch;
    return scratch.refusal("a.glb", builder.glb());
}

void expect_near(Vec3f a, Vec3f b, float tolerance) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

} // namespace spa::test
