// SPDX-License-Identifier: Apache-2.0
// The hit group that traces maps in a ray-tracing pipeline: SPIR-V of shaders/spa.rint, spa.rchit and
// spa.rahit, entry point "main".
//
// A procedural hit group (VK_RAY_TRACING_SHADER_GROUP_TYPE_PROCEDURAL_HIT_GROUP_KHR) needs the intersection
// shader; the closest-hit shader may be an application's own, with its own payload (spa.rchit's is
// shaders/spa_payload.glsl); the any-hit shader is for maps with SPA_RECORD_COVERAGE alone. A shader record
// is the group's handle and ShaderRecord (map_object.h).
#pragma once

#include "functions.h"

#include <cstdint>
#include <span>

namespace spa::vulkan {

enum class HitStage { intersection, closest_hit, any_hit };

// Words of SPIR-V 1.4, for VkShaderModuleCreateInfo. Static.
std::span<const std::uint32_t> hit_stage_spirv(HitStage stage);
VkShaderStageFlagBits stage_bit(HitStage stage);

// Specialisation constants of all stages, and of a shader that includes spa_ray_query.glsl: ids 0, 1, ... in
// this order. The same for all stages of a group.
struct TraceConstants {
    std::uint32_t tracer = 0;     // SPA_PROJECTIVE, SPA_FAN, SPA_MARCH (shaders/spa_method.h)
    std::uint32_t count = 10;     // test rays of the fan, steps of the march
    std::uint32_t count_rule = 0; // SPA_FAN_FIXED, SPA_FAN_BY_DISTANCE
    float hole_threshold = 0.5F;  // of coverage, for records with SPA_RECORD_COVERAGE
    std::uint32_t fan_start = 0;  // SPA_FAN_START_HITS, SPA_FAN_START_LEAVES
};

// For VkPipelineShaderStageCreateInfo::pSpecializationInfo; refers to `constants`, which outlives its use.
VkSpecializationInfo specialization(const TraceConstants& constants);

} // namespace spa::vulkan
