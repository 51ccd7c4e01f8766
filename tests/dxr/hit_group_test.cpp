// SPDX-License-Identifier: Apache-2.0
// What the loader says of the hit group is what shaders/hlsl/spa.hlsl and the shader record are.
#include "../../libspa/dxr/hit_group.h"
#include "../../libspa/dxr/map_object.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <iterator>
#include <string>

namespace spa::test {
namespace {

TEST(DxrHitGroup, DescribesTheLibrary) {
    const D3D12_HIT_GROUP_DESC group = dxr::hit_group();
    EXPECT_EQ(group.Type, D3D12_HIT_GROUP_TYPE_PROCEDURAL_PRIMITIVE);
    EXPECT_STREQ(group.HitGroupExport, dxr::hit_group_name);
    EXPECT_STREQ(group.IntersectionShaderImport, L"spa_intersection");
    EXPECT_STREQ(group.ClosestHitShaderImport, L"spa_closest_hit");
    EXPECT_EQ(group.AnyHitShaderImport, nullptr);
    EXPECT_STREQ(dxr::hit_group(true).AnyHitShaderImport, L"spa_any_hit");
    EXPECT_EQ(dxr::hit_group(false, nullptr).ClosestHitShaderImport, nullptr);
}

TEST(DxrHitGroup, RootArgumentsAreTheShaderRecord) {
    const dxr::LocalRootSignature local;
    const D3D12_ROOT_SIGNATURE_DESC signature = local.description();
    EXPECT_EQ(signature.Flags, D3D12_ROOT_SIGNATURE_FLAG_LOCAL_ROOT_SIGNATURE);
    EXPECT_EQ(signature.NumStaticSamplers, 0U);
    ASSERT_EQ(signature.NumParameters, 2U);
    const D3D12_ROOT_PARAMETER& image = signature.pParameters[0];
    EXPECT_EQ(image.ParameterType, D3D12_ROOT_PARAMETER_TYPE_SRV);
    const D3D12_ROOT_PARAMETER& constants = signature.pParameters[1];
    EXPECT_EQ(constants.ParameterType, D3D12_ROOT_PARAMETER_TYPE_32BIT_CONSTANTS);
    // Arguments lie one behind the other, addresses on 8 bytes.
    EXPECT_EQ(offsetof(dxr::ShaderRecord, image), 0U);
    EXPECT_EQ(offsetof(dxr::ShaderRecord, flags), 8U);
    EXPECT_EQ(constants.Constants.Num32BitValues * 4 + 8, sizeof(dxr::ShaderRecord));
    EXPECT_EQ(image.Descriptor.ShaderRegister, 0U);
    EXPECT_EQ(image.Descriptor.RegisterSpace, dxr::register_space);
    EXPECT_EQ(constants.Constants.ShaderRegister, 0U);
    EXPECT_EQ(constants.Constants.RegisterSpace, dxr::register_space);
    EXPECT_GE(dxr::record_stride, D3D12_SHADER_IDENTIFIER_SIZE_IN_BYTES + sizeof(dxr::ShaderRecord));
}

// The library is compiled by DXC, which is not at hand here: at least names and numbers are the same.
TEST(DxrHitGroup, NamesAreThoseOfTheHlsl) {
    std::ifstream file(SPA_SOURCE_DIR "/shaders/hlsl/spa.hlsl");
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    for (const wchar_t* name : {dxr::intersection_name, dxr::closest_hit_name, dxr::any_hit_name}) {
        std::string narrow = "void ";
        for (; *name != 0; ++name) narrow += char(*name);
        EXPECT_NE(text.find(narrow + "("), std::string::npos) << narrow;
    }
    EXPECT_NE(text.find("#define SPA_SPACE space" + std::to_string(dxr::register_space)), std::string::npos);
    EXPECT_NE(text.find("// " + std::to_string(dxr::payload_size) + " bytes."), std::string::npos);
}

} // namespace
} // namespace spa::test
