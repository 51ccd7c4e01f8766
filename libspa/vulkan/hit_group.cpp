// SPDX-License-Identifier: Apache-2.0
#include "hit_group.h"

#include <spirv/spa.rahit.h>
#include <spirv/spa.rchit.h>
#include <spirv/spa.rint.h>

#include <array>
#include <cstddef>

namespace spa::vulkan {

std::span<const std::uint32_t> hit_stage_spirv(HitStage stage) {
    switch (stage) {
    case HitStage::intersection: return spa_rint;
    case HitStage::closest_hit: return spa_rchit;
    case HitStage::any_hit: return spa_rahit;
    }
    return {};
}

VkShaderStageFlagBits stage_bit(HitStage stage) {
    switch (stage) {
    case HitStage::closest_hit: return VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR;
    case HitStage::any_hit: return VK_SHADER_STAGE_ANY_HIT_BIT_KHR;
    case HitStage::intersection: break;
    }
    return VK_SHADER_STAGE_INTERSECTION_BIT_KHR;
}

VkSpecializationInfo specialization(const TraceConstants& constants) {
    static constexpr std::array<VkSpecializationMapEntry, 5> entries{{
        {0, offsetof(TraceConstants, tracer), sizeof(std::uint32_t)},
        {1, offsetof(TraceConstants, count), sizeof(std::uint32_t)},
        {2, offsetof(TraceConstants, count_rule), sizeof(std::uint32_t)},
        {3, offsetof(TraceConstants, hole_threshold), sizeof(float)},
        {4, offsetof(TraceConstants, fan_start), sizeof(std::uint32_t)},
    }};
    return {std::uint32_t(entries.size()), entries.data(), sizeof constants, &constants};
}

} // namespace spa::vulkan
