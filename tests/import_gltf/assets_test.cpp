// SPDX-License-Identifier: Apache-2.0
// Real assets: how many triangles each gives. The numbers are those of the assets' own list (each instance
// counted, triangles without area not), or, where a list counts a mesh once, that times its instances.
#include "../import_mesh/scratch.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

struct Asset {
    const char* path;
    std::size_t triangles; // before degenerate ones are dropped
    std::size_t textures;
    const char* warning = nullptr; // exactly this one, or none
};

constexpr Asset asset_table[] = {
    {"gltf/AnimatedMorphSphere/AnimatedMorphSphere.glb", 960, 0},
    {"gltf/Avocado/Avocado.gltf", 682, 1},
    {"gltf/BoxInterleaved/BoxInterleaved.gltf", 12, 0},
    {"gltf/BoxTextured/BoxTextured.gltf", 12, 1},
    {"gltf/BoxVertexColors/BoxVertexColors.glb", 12, 0},
    {"gltf/CakeBirthday/cakeBirthday.glb", 1332, 0, "node 1 is not a root"},
    {"gltf/CesiumMan/CesiumMan.glb", 4672, 1},
    {"gltf/ClearCoatTest/ClearCoatTest.glb", 37116, 1},
    {"gltf/CubeImageUriSpaces/CubeImageUriSpaces.gltf", 12, 1},
    {"gltf/CubeScaledInstances/cube_att.gltf", 4 * 12, 0, "nodes[5]: has more than one parent"},
    {"gltf/FlightHelmet/FlightHelmet.gltf", 94722, 5},
    {"gltf/Fox/Fox.glb", 576, 1},
    {"gltf/MirrorTriangle/one_face_123_mirror.gltf", 1, 0},
    {"gltf/PalmTree/PalmTree.gltf", 10124, 1},
    {"gltf/PrimitiveModes/gltf_primitives.glb", 12, 0},
    {"gltf/RetroUFO/retroufo.gltf", 16428, 0},
    {"gltf/RiggedSimple/RiggedSimple.gltf", 188, 0},
    {"gltf/SheenChairRoom/MixedLightingExample.gltf", 40898, 3},
    {"gltf/SheenCloth/SheenCloth.glb", 115200, 1},
    {"gltf/SimpleMeshes/SimpleMeshes.gltf", 2, 0},
    {"gltf/SimpleMorph/SimpleMorph.gltf", 1, 0},
    {"gltf/SimpleSparseAccessor/SimpleSparseAccessor.gltf", 12, 0},
    {"gltf/Suzanne/Suzanne.gltf", 3936, 1},
    {"gltf/TextureCoordinateTest/TextureCoordinateTest.gltf", 10, 1},
    {"gltf/TextureSettingsTest/TextureSettingsTest.glb", 72, 3},
    {"gltf/TextureTransformTest/TextureTransformTest.gltf", 24, 5},
    {"gltf/Torus/torus.gltf", 3072, 0},
    {"gltf/TransmissionRoughnessTest/TransmissionRoughnessTest.glb", 77792, 3},
    {"gltf/TriangleWithoutIndices/TriangleWithoutIndices.gltf", 1, 0},
    {"gltf/VertexColorTest/VertexColorTest.gltf", 36, 2},
    {"gltf/bio_01_alpha_mask/01_alpha_mask.gltf", 2, 1},
    {"gltf/bio_01_vertex_count_16bit/01_vertex_count_16bit.gltf", 130378, 0},
    {"gltf/bio_22_vertex_color/22_vertex_color.gltf", 5, 0},
    {"gltf/love/love.glb", 46552, 0},
    {"gltf/low-poly-tree/low-poly-tree.glb", 1126, 1},
    {"gltf/van_mirrored_wheels/van.glb", 1944, 0},
    {"gltf/xr_generic-hand/left.glb", 2314, 0},
    {"gltf/xr_htc-vive/none.glb", 17344, 1},
    {"unsupported/draco_bunny/model.gltf", 58754, 0},
    {"unsupported/draco_heart/heart_draco.glb", 180, 0},
    {"unsupported/meshopt_pirate/pirate.glb", 5010, 0},
    {"unsupported/quantized_fox/Fox_quantized.glb", 576, 1},
    {"big/cave_595k/cave_595k.glb", 595410, 0},
    {"big/cave_draco/cave.glb", 595410, 0},
};

class GltfAssets : public testing::TestWithParam<Asset> {};

TEST_P(GltfAssets, Import) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS";
    const Asset& asset = GetParam();
    const import::Result result = import::read_model(assets() / asset.path);
    expect_valid(result);
    EXPECT_EQ(result.model.triangles.size() + result.report.dropped_degenerate, asset.triangles);
    EXPECT_EQ(result.report.dropped_non_finite, 0U);
    EXPECT_EQ(result.model.textures.size(), asset.textures);
    if (asset.warning == nullptr) {
        EXPECT_TRUE(result.report.warnings.empty()) << result.report.warnings[0];
    } else {
        EXPECT_EQ(result.report.warnings.size(), 1U);
        EXPECT_TRUE(has_warning(result.report, asset.warning));
    }
    EXPECT_GT(area(result.model), 0.0);
}

INSTANTIATE_TEST_SUITE_P(All, GltfAssets, testing::ValuesIn(asset_table), [](const auto& info) {
    std::string name = std::filesystem::path(info.param.path).parent_path().filename().string();
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return name;
});

import::Result read(const char* path){return import::read_model(assets() / path);
} // namespace

// Two encodings of one mesh.
TEST(GltfAssetPairs, DracoGivesTheSameCave) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS";
    const import::Result plain = read("big/cave_595k/cave_595k.glb"), draco = read("big/cave_draco/cave.glb");
    EXPECT_EQ(plain.report.dropped_degenerate, draco.report.dropped_degenerate);
    EXPECT_NEAR(area(plain.model), area(draco.model), 1e-6 * area(plain.model));
    EXPECT_NEAR(volume(plain.model), volume(draco.model), 1e-6 * std::abs(volume(plain.model)));
}

TEST(GltfAssetPairs, QuantizedFoxIsTheFox) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS";
    const import::Result plain = read("gltf/Fox/Fox.glb"),
                         small = read("unsupported/quantized_fox/Fox_quantized.glb");
    EXPECT_NEAR(area(plain.model), area(small.model), 1e-3 * area(plain.model));
    EXPECT_NEAR(volume(plain.model), volume(small.model), 1e-3 * std::abs(volume(plain.model)));
}

// Closed outside is closed outside: mirrored nodes and skins turn nothing inside out.
TEST(GltfAssetPairs, ClosedMeshesFaceOutwards) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS";
    for (const char* path :
         {"gltf/Fox/Fox.glb", "gltf/CesiumMan/CesiumMan.glb", "gltf/RiggedSimple/RiggedSimple.gltf",
          "gltf/xr_generic-hand/left.glb", "unsupported/draco_bunny/model.gltf",
          "gltf/BoxTextured/BoxTextured.gltf", "gltf/AnimatedMorphSphere/AnimatedMorphSphere.glb"}) {
        const import::Result result = read(path);
        EXPECT_GT(volume(result.model), 0.0) << path;
        double agree = 0, all = 0;
        for (std::size_t t = 0; t < result.model.triangles.size(); ++t) {
            const auto [a, b, c] = corners(result.model, t);
            const Vec3f face = cross(b - a, c - a);
            for (const std::uint32_t v : result.model.triangles[t].vertex) {
                all += double(length(face));
                if (dot(face, result.model.normals[v]) > 0) agree += double(length(face));
            }
        }
        EXPECT_GT(agree / all, 0.97) << path;
    }
}

TEST(GltfAssetPairs, GpuInstances) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS";
    import::Limits limits;
    limits.triangles = 1000000; // it has 7.6 million: two meshes some thousand times
    EXPECT_THROW(
        (void)import::read_model(assets() / "gltf/bio_24_gpu_instancing/24_gpu_instancing.gltf", limits),
        std::exception);
}

} // namespace spa::test
} // namespace spa::test
