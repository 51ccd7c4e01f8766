// SPDX-License-Identifier: Apache-2.0
// GLB chunks, JSON defects, limits on what documents claim; how a file's format is recognised.
#include "gltf_builder.h"

#include "../../libspa/core/error.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

TEST(Container, EveryTruncationIsRefused) {
    const Scratch scratch;
    const std::string bytes = triangle().glb();
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_NE(scratch.refusal("a.glb", bytes.substr(0, size)), "imported") << size;
    const std::string text = triangle().text();
    for (std::size_t size = 0; size < text.size(); ++size)
        EXPECT_NE(scratch.refusal("a.gltf", text.substr(0, size)), "imported") << size;
}

TEST(Container, UnknownChunksAndBytesAfterTheEnd) {
    const Scratch scratch;
    std::string bytes = triangle().glb();
    const std::string chunk("\4\0\0\0ABCD....", 12);
    bytes += chunk;
    bytes[8] = static_cast<char>((bytes.size()) & 0xFFU);
    bytes[9] = static_cast<char>((bytes.size() >> 8U) & 0xFFU);
    EXPECT_TRUE(scratch.read("a.glb", bytes).report.warnings.empty());
    EXPECT_TRUE(
        has_warning(scratch.read("a.glb", triangle().glb() + "tail").report, "4 bytes after the end"));
}

TEST(Container, ByteOrderMark) {
    const Scratch scratch;
    EXPECT_TRUE(
        has_warning(scratch.read("a.gltf", "\xEF\xBB\xBF" + triangle().text()).report, "byte order mark"));
}

TEST(Container, DeepJson) {
    const Scratch scratch;
    std::string text = triangle().text();
    text.back() = ',';
    text += "\"extras\":" + std::string(1000000, '[');
    EXPECT_TRUE(contains(scratch.refusal("a.gltf", text), "nested deeper"));
    // Brackets in strings are no nesting, nor do escaped quotes end one.
    GltfBuilder builder = triangle();
    builder.json["extras"] = std::string(10000, '[') + "\"" + std::string(10000, '{') + "\\";
    EXPECT_EQ(scratch.refusal("a.gltf", builder.text()), "imported");
}

TEST(Container, HugeClaimsAreRefusedBeforeAllocation) {
    const auto refused = [](const char* what, const auto& change) {
        GltfBuilder builder = triangle();
        change(builder.json);
        const std::string message = refusal(builder);
        EXPECT_NE(message, "imported") << what;
        return message;
    };
    constexpr std::uint64_t huge = 4000000000000000ULL;
    refused("count", [&](Json& json) { json["accessors"][0]["count"] = huge; });
    refused("offset", [&](Json& json) { json["accessors"][0]["byteOffset"] = huge; });
    refused("view", [&](Json& json) { json["bufferViews"][0]["byteLength"] = huge; });
    refused("view offset", [&](Json& json) { json["bufferViews"][0]["byteOffset"] = huge; });
    refused("buffer", [&](Json& json) { json["buffers"] = {{{"byteLength", huge}}}; });
    refused("2^64", [&](Json& json) { json["accessors"][0]["count"] = 18446744073709551615ULL; });
    const std::string message = refused("nothing behind it", [&](Json& json) {
        for (Json& accessor : json["accessors"]) {
            accessor.erase("bufferView");
            accessor["count"] = 200000000;
        }
    });
    EXPECT_TRUE(contains(message, "claims 200000000 elements without a bufferView")) << message;
}

TEST(Container, SharedChildrenDoNotMultiplyForEver) {
    GltfBuilder builder = triangle();
    // 60 levels, each node twice below the one above: 2^60 drawings.
    for (int i = 1; i <= 60; ++i) builder.json["nodes"].push_back({{"children", {i - 1, i - 1}}});
    builder.json["scenes"][0]["nodes"] = {60};
    EXPECT_TRUE(contains(refusal(builder), "multiply to more than"));
    // A chain deeper than the limit, and one that is not.
    for (const int depth : {255, 256}) {
        GltfBuilder chain = triangle();
        for (int i = 1; i <= depth; ++i) chain.json["nodes"].push_back({{"children", {i - 1}}});
        chain.json["scenes"][0]["nodes"] = {depth};
        EXPECT_EQ(contains(refusal(chain), "deeper than the limit of 256"), depth == 256);
    }
}

struct Change {
    const char* pointer;
    Json value; // null: erase
    const char* message;
};

TEST(Container, EveryDefectIsNamedWithItsPlace) {
    const Change changes[] = {
        {"/asset", nullptr, "asset: is missing"},
        {"/asset/version", 2, "asset.version: must be of type string, but is of type number"},
        {"/asset/version", "two", "asset.version: 'two' is not a version"},
        {"/asset/minVersion", "2.1", "asset.minVersion: is 2.1"},
        {"/accessors/0/bufferView", 7,
         "accessors[0].bufferView: 7 is out of range (the document has 2 bufferViews)"},
        {"/accessors/0/bufferView", -1, "accessors[0].bufferView: -1 is out of range"},
        {"/accessors/0/bufferView", 0.5, "accessors[0].bufferView: must be of type index"},
        {"/accessors/0/componentType", 5124, "accessors[0].componentType: is 5124 instead of one of"},
        {"/accessors/0/componentType", 5125, "attributes.POSITION: has component type 5125"},
        {"/accessors/0/type", "VEC5", "accessors[0].type: is 'VEC5'"},
        {"/accessors/0/type", "VEC2", "accessors[0].min: has 3 elements"},
        {"/accessors/0/count", 4, "accessors[0]: needs bytes 0 to 48 of bufferViews[0], which has 36 bytes"},
        {"/accessors/1/count", 2, "attributes.NORMAL: has 2 elements, the others 3"},
        {"/accessors/0/count", 0, "accessors[0].count: is 0"},
        {"/bufferViews/0/byteStride", 6, "bufferViews[0].byteStride: is 6"},
        {"/bufferViews/0/byteStride", 4, "bufferViews[0].byteStride is 4, smaller than an element"},
        {"/bufferViews/0/buffer", 1, "bufferViews[0].buffer: 1 is out of range"},
        {"/meshes/0/primitives/0/attributes/POSITION", 9, "meshes[0].primitives[0].attributes.POSITION: 9"},
        {"/meshes/0/primitives/0/mode", 7, "meshes[0].primitives[0].mode: is 7"},
        {"/meshes/0/primitives/0/material", 0, "meshes[0].primitives[0].material: 0 is out of range"},
        {"/meshes/0/primitives", Json::array(), "meshes[0].primitives: has 0 elements instead of at least 1"},
        {"/nodes/0/mesh", 1, "nodes[0].mesh: 1 is out of range"},
        {"/nodes/0/children", {0}, "nodes[0].children: node 0 is its own descendant"},
        {"/nodes/0/matrix", {1, 2}, "nodes[0].matrix: has 2 elements instead of 16"},
        {"/nodes/0/rotation", {0, 0, 0, 0}, "nodes[0].rotation: is no quaternion"},
        {"/nodes/0/scale", {1, "1", 1}, "nodes[0].scale[1]: must be of type number"},
        {"/scenes/0/nodes/0", 5, "scenes[0].nodes[0]: 5 is out of range"},
        {"/scene", 1, "scene: 1 is out of range"},
        {"/materials", {{{"alphaMode", "CUTOUT"}}}, "materials[0].alphaMode: is 'CUTOUT'"},
        {"/materials",
         {{{"normalTexture", {{"index", 0}}}}},
         "materials[0].normalTexture.index: 0 is out of range"},
        {"/images", Json::array({Json::object()}), "images[0]: has no uri and no bufferView"},
        {"/samplers", {{{"wrapS", 1}}}, "samplers[0].wrapS: is 1"},
        {"/skins", {{{"joints", Json::array()}}}, "skins[0].joints: has 0 elements"},
        {"/meshes/0/primitives/0/indices", 0, "is not a SCALAR of unsigned integers"},
    };
    for (const Change& change : changes) {
        GltfBuilder builder = triangle();
        const Json::json_pointer pointer(change.pointer);
        if (change.value.is_null())
            builder.json.erase("asset");
        else
            builder.json[pointer] = change.value;
        const std::string message = refusal(builder);
        EXPECT_TRUE(contains(message, change.message)) << change.pointer << ": " << message;
    }
}

TEST(Container, IntegersMayBeWrittenAsFractions) {
    GltfBuilder builder = triangle();
    builder.json["accessors"][0]["count"] = 3.0;
    builder.json["scene"] = 0.0;
    EXPECT_EQ(refusal(builder), "imported");
}

TEST(Container, FormatIsRecognisedByContentFirst) {
    const Scratch scratch;
    EXPECT_EQ(scratch.read("a.obj", triangle().glb()).report.format, "GLB");
    EXPECT_EQ(scratch.read("a.stl", " \n" + triangle().text()).report.format, "glTF");
    EXPECT_EQ(scratch.read("a.glb", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").report.format, "OFF");
    EXPECT_EQ(scratch.read("A.OBJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").report.format, "OBJ");
    EXPECT_TRUE(contains(scratch.refusal("a.xyz", "v 0 0 0\n"), "neither the content nor the extension"));
}

TEST(Container, MissingFilesAreInputErrors) {
    for (const char* path : {"/does/not/exist.glb", "/tmp"}) {
        try {
            (void)import::read_model(path);
            ADD_FAILURE();
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::input_output);
            EXPECT_EQ(std::string_view(error.what()).rfind(path, 0), 0U);
        }
    }
}

} // namespace
} // namespace spa::test
