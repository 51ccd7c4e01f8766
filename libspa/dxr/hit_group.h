// SPDX-License-Identifier: Apache-2.0
// How the library shaders/hlsl/spa.hlsl goes into a ray-tracing pipeline.
//
//   1. The DXIL library, by dxc -T lib_6_5 -Gis shaders/hlsl/spa.hlsl.
//   2. hit_group(): a subobject of type D3D12_STATE_SUBOBJECT_TYPE_HIT_GROUP.
//   3. LocalRootSignature::description(), through D3D12SerializeRootSignature and CreateRootSignature: a
//      local root signature, associated with hit_group_name.
//   4. D3D12_RAYTRACING_SHADER_CONFIG{payload_size, attributes_size}, or more where other stages need it.
//
// A record of the shader table is the group's identifier and, behind it, the 16 bytes of
// MapObject::shader_record().
#pragma once

#include "d3d12.h"

#include <array>

namespace spa::dxr {

inline constexpr const wchar_t* intersection_name = L"spa_intersection";
inline constexpr const wchar_t* closest_hit_name = L"spa_closest_hit";
inline constexpr const wchar_t* any_hit_name = L"spa_any_hit";
inline constexpr const wchar_t* hit_group_name = L"spa_hit_group";

inline constexpr UINT payload_size = 60;   // of SpaPayload
inline constexpr UINT attributes_size = 4; // of SpaAttributes
inline constexpr UINT register_space = 83; // SPA_SPACE

// From one record of the shader table to the next, at least: identifier and arguments, aligned.
inline constexpr UINT record_stride = 64;
static_assert(record_stride % D3D12_RAYTRACING_SHADER_RECORD_BYTE_ALIGNMENT == 0);

// coverage: with spa_any_hit, for instances of maps that were loaded with LoadOptions::coverage. closest_hit:
// of the application's own in place of spa_closest_hit; null: none, for pipelines of shadow rays.
D3D12_HIT_GROUP_DESC hit_group(bool coverage = false, const wchar_t* closest_hit = closest_hit_name);

// The arguments in a shader record: the trace image as a root SRV, and two constants.
class LocalRootSignature {
public:
    LocalRootSignature();

    // An application whose hit groups take more arguments puts these two first in a signature of its own.
    [[nodiscard]] const std::array<D3D12_ROOT_PARAMETER, 2>& parameters() const { return parameters_; }
    // Valid while this object lives.
    [[nodiscard]] D3D12_ROOT_SIGNATURE_DESC description() const;

private:
    std::array<D3D12_ROOT_PARAMETER, 2> parameters_{};
};

} // namespace spa::dxr
