// SPDX-License-Identifier: Apache-2.0
#include "hit_group.h"

namespace spa::dxr {

D3D12_HIT_GROUP_DESC hit_group(bool coverage, const wchar_t* closest_hit) {
    D3D12_HIT_GROUP_DESC group{};
    group.HitGroupExport = hit_group_name;
    group.Type = D3D12_HIT_GROUP_TYPE_PROCEDURAL_PRIMITIVE;
    group.AnyHitShaderImport = coverage ? any_hit_name : nullptr;
    group.ClosestHitShaderImport = closest_hit;
    group.IntersectionShaderImport = intersection_name;
    return group;
}

LocalRootSignature::LocalRootSignature() {
    D3D12_ROOT_PARAMETER& image = parameters_[0];
    image.ParameterType = D3D12_ROOT_PARAMETER_TYPE_SRV;
    image.Descriptor.ShaderRegister = 0;
    image.Descriptor.RegisterSpace = register_space;
    image.ShaderVisibility = D3D12_SHADER_VISIBILITY_ALL;
    D3D12_ROOT_PARAMETER& constants = parameters_[1];
    constants.ParameterType = D3D12_ROOT_PARAMETER_TYPE_32BIT_CONSTANTS;
    constants.Constants.ShaderRegister = 0;
    constants.Constants.RegisterSpace = register_space;
    constants.Constants.Num32BitValues = 2;
    constants.ShaderVisibility = D3D12_SHADER_VISIBILITY_ALL;
}

D3D12_ROOT_SIGNATURE_DESC LocalRootSignature::description() const {
    D3D12_ROOT_SIGNATURE_DESC signature{};
    signature.NumParameters = UINT(parameters_.size());
    signature.pParameters = parameters_.data();
    signature.Flags = D3D12_ROOT_SIGNATURE_FLAG_LOCAL_ROOT_SIGNATURE;
    return signature;
}

} // namespace spa::dxr
