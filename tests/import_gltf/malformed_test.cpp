// SPDX-License-Identifier: Apache-2.0
// The malformed assets: each is refused as invalid data with a message that names the defect, or imported
// where the data has one meaning, with a warning where there is something to say.
#include "../import_mesh/scratch.h"

#include "../../libspa/core/error.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

struct Case {
    const char* path;
    const char* message;       // of the error, or of a warning
    std::size_t triangles = 0; // 0: refused
};

constexpr Case cases[] = {
    {"gltf_assimp/BoxWithInfinites.glb", "12 triangles have corners that are not finite"},
    {"gltf_assimp/IndexOutOfRange.gltf", "index 255 at position 0 is out of range (24 vertices)"},
    {"gltf_assimp/NoScene.gltf", "scene: 0 is out of range (the document has 0 scenes)"},
    {"gltf_assimp/RecursiveNodes.gltf", "nodes[1].children: node 0 is its own descendant"},
    {"gltf_assimp/badArray.gltf", "meshes[0].primitives: must be an array"},
    {"gltf_assimp/badNumber.gltf",
     "materials[0].normalTexture.scale: must be of type number, but is of type string"},
    {"gltf_assimp/badString.gltf", "scenes[0].name: must be of type string, but is of type number"},
    {"gltf_assimp/texcoord_crash.gltf",
     "has no TEXCOORD_0, which the base colour texture of its material needs", 10},
    {"gltf_draco/TexCoord0InvalidTexCoord1Valid.gltf", "", 12},
    {"gltf_magnum/buffer-invalid-short-size.glb",
     "buffers[0].byteLength: is 24, but there are only 12 bytes"},
    {"gltf_magnum/empty.gltf", "nothing to bake: the file has no meshes"},
    {"gltf_magnum/image-invalid-notfound.gltf", "'/nonexistent.png' is an absolute path"},
    {"gltf_magnum/mesh-invalid-empty-primitives.gltf", "meshes[0].primitives[0].attributes: is missing"},
    {"gltf_magnum/mesh-invalid-primitive-attributes-property.gltf",
     "meshes[0].primitives[0].attributes: is missing"},
    {"gltf_magnum/mesh-invalid-primitives-property.gltf", "meshes[0].primitives[0].attributes: is missing"},
    {"gltf_magnum/scene-default-oob.gltf", "scene: 0 is out of range"},
    {"gltf_magnum/scene-invalid-children-property.gltf", "nodes[1].children: must be an array"},
    {"gltf_magnum/scene-invalid-extras-property.gltf", "JSON: parse error at line 9"},
    {"gltf_magnum/scene-invalid-node-oob.gltf",
     "scenes[0].nodes[0]: 7 is out of range (the document has 7 nodes)"},
    {"gltf_magnum/version-unsupported-min.gltf", "asset.minVersion: is 2.1"},
    {"gltf_misc/donut_broken_json.gltf", "JSON: parse error at line 1, column 716530"},
    {"gltf_tinygltf/invalid-buffer-index.gltf", "bufferViews[1].buffer: 1 is out of range"},
    {"gltf_tinygltf/invalid-primitive-indices.gltf", "bufferViews[0].buffer: 0 is out of range"},
    {"gltf_tinygltf/issue-492.glb", "nothing to bake: the file has no meshes"},
    {"gltf_tinygltf/unassigned-skeleton.gltf", "matrix 0 is not affine", 8},
    {"gltf_trimesh/empty_nodes.glb", "nothing to bake: the file has no meshes"},
    {"gltf_validator/accessor/alignment.gltf",
     "accessors[2]: needs bytes 32 to 44 of bufferViews[0], which has 16"},
    {"gltf_validator/accessor/float_normalized.gltf",
     "accessors[0].normalized: is true for component type 5126"},
    {"gltf_validator/accessor/unresolved_bufferviews.gltf", "accessors[0].bufferView: 0 is out of range"},
    {"gltf_validator/accessor_data/out_of_range_elements_sint16.gltf",
     "accessors[0].max: is not the maximum"},
    {"gltf_validator/animation_data/invalid_input_values.gltf",
     "animations[0].samplers[0].input: has a negative time"},
    {"gltf_validator/asset/1_0_version.gltf", "asset.version: is 1.0"},
    {"gltf_validator/buffer/empty_array.gltf", "buffers: is an empty array"},
    {"gltf_validator/buffer/invalid_uri_data.glb", "buffers[0].uri: is a malformed data: URI"},
    {"gltf_validator/buffer/no_bin_chunk.glb", "buffers[0]: has no uri, and the GLB has no BIN chunk"},
    {"gltf_validator/buffer/wrong_bytelength.glb",
     "buffers[0].byteLength: is 17, but there are only 16 bytes"},
    {"gltf_validator/buffer_view/invalid_stride_too_big.gltf", "bufferViews[0].byteStride: is greater than"},
    {"gltf_validator/buffer_view/zero_bytelength.gltf", "bufferViews[0].byteLength: is 0"},
    {"gltf_validator/glb/empty_json_object.glb", "asset: is missing"},
    {"gltf_validator/glb/invalid_magic.glb", "neither with the GLB magic"},
    {"gltf_validator/glb/no_header.glb", "neither with the GLB magic"},
    {"gltf_validator/glb/truncated_chunk_data.glb", "length is 48, but the file has only 47 bytes"},
    {"gltf_validator/glb/two_valid_json_chunks.glb", "GLB chunk[1]: a second JSON chunk"},
    {"gltf_validator/glb/zero_length.glb", "GLB header: length is 0"},
    {"gltf_validator/image/invalid_image_data.gltf", "images[0]: is a damaged image"},
    {"gltf_validator/image/missing_mime_type_buffer_view.gltf",
     "images[0]: has a bufferView but no mimeType"},
    {"gltf_validator/json/bom.gltf", "byte order mark"},
    {"gltf_validator/json/invalid_syntax.gltf", "JSON: parse error at line 1, column 2"},
    {"gltf_validator/material/unresolved_normal.gltf", "materials[0].normalTexture.index: 0 is out of range"},
    {"gltf_validator/mesh/accessor_unaligned.gltf", "attributes.COLOR_0: is not aligned to 4 bytes"},
    {"gltf_validator/mesh/indices_bytestride.gltf", "has a byteStride, which indices must not have"},
    {"gltf_validator/mesh/invalid_indexed_attribute.gltf",
     "attributes.INVALID_: is not an attribute that glTF knows"},
    {"gltf_validator/mesh/morph_position_accessor_no_bounds.gltf",
     "accessors[1]: holds POSITION but has no min"},
    {"gltf_validator/mesh/position_accessor_no_bounds.gltf", "accessors[0]: holds POSITION but has no min"},
    {"gltf_validator/mesh/unresolved_material.gltf", "meshes[0].primitives[0].material: 0 is out of range"},
    {"gltf_validator/mesh_data/colors_non_clamped.gltf",
     "accessors[1]: holds COLOR_0 with values outside [0, 1]"},
    {"gltf_validator/node/empty_array.gltf", "nodes: is an empty array"},
    {"gltf_validator/node/matrix_indecomposable.gltf", "nodes[0].matrix: is not affine"},
    {"gltf_validator/node/node_skin_without_skinned_mesh.gltf",
     "nodes[0]: has a skin, but its mesh has no JOINTS_0"},
    {"gltf_validator/node/skin_with_no_mesh.gltf", "nodes[0]: has a skin but no mesh"},
    {"gltf_validator/root/invalid_array_elements.gltf",
     "samplers[0]: must be of type object, but is of type string"},
    {"gltf_validator/scene/empty_nodes_array.gltf", "scenes[0].nodes: is an empty array"},
    {"gltf_validator/skin/buffer_view_bytestride.gltf",
     "has a byteStride, which these matrices must not have"},
    {"gltf_validator/skin/ibm_invalid_count.gltf",
     "skins[2].inverseBindMatrices: accessors[0] has 2 matrices for 3"},
    {"gltf_validator/skin/unresolved_skeleton.gltf", "skins[0].skeleton: 1 is out of range"},
    {"gltf_validator/texture/unresolved_sampler.gltf", "textures[0].sampler: 0 is out of range"},
};

TEST(MalformedGltf, EveryFileIsNamedOrImported) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS";
    for (const Case& expected : cases) {
        SCOPED_TRACE(expected.path);
        const std::filesystem::path path = assets() / "malformed" / expected.path;
        if (expected.triangles == 0) {
            const std::string message = refusal_of(path);
            EXPECT_NE(message.find(expected.message), std::string::npos) << message;
            continue;
        }
        const import::Result result = import::read_model(path);
        expect_valid(result);
        EXPECT_EQ(result.model.triangles.size(), expected.triangles);
        const std::string_view warning = expected.message;
        EXPECT_TRUE(warning.empty() ? result.report.warnings.empty() : has_warning(result.report, warning));
    }
}

TEST(MalformedGltf, NoFileIsForgotten) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS";
    std::set<std::string> known;
    for (const Case& expected : cases) known.insert(expected.path);
    for (const auto& entry : std::filesystem::recursive_directory_iterator(assets() / "malformed")) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".gltf" && extension != ".glb") continue;
        EXPECT_EQ(known.count(std::filesystem::relative(entry.path(), assets() / "malformed").string()), 1U)
            << entry.path();
    }
}

} // namespace
} // namespace spa::test
