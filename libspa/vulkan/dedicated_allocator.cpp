// SPDX-License-Identifier: Apache-2.0
#include "dedicated_allocator.h"

#include "device.h"

#include "../core/error.h"

#include <bit>
#include <cstdint>
#include <optional>

namespace spa::vulkan {
namespace {

// Among the allowed types that have all `needed` properties the one with most of the `wanted`.
std::uint32_t memory_type(const VkPhysicalDeviceMemoryProperties& memory, std::uint32_t allowed,
                          VkMemoryPropertyFlags needed, VkMemoryPropertyFlags wanted,
                          VkMemoryPropertyFlags unwanted) {
    std::optional<std::uint32_t> best;
    int best_score = 0;
    for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
        const VkMemoryPropertyFlags has = memory.memoryTypes[type].propertyFlags;
        if ((allowed >> type & 1U) == 0 || (has & needed) != needed) continue;
        const int score = std::popcount(has & wanted) - std::popcount(has & unwanted);
        if (best && score <= best_score) continue;
        best = type;
        best_score = score;
    }
    if (!best) throw Error(ExitCode::unsupported, "the Vulkan device has no memory type that suits a buffer");
    return *best;
}

} // namespace

Allocation DedicatedAllocator::allocate(const VkMemoryRequirements& requirements, MemoryUse use) {
    constexpr VkMemoryPropertyFlags visible =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    constexpr VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    constexpr VkMemoryPropertyFlags cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    const bool mapped = use != MemoryUse::device;
    VkMemoryAllocateFlagsInfo flags{};
    flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.pNext = &flags;
    info.allocationSize = requirements.size;
    switch (use) {
    case MemoryUse::device:
        info.memoryTypeIndex = memory_type(device_.memory(), requirements.memoryTypeBits, 0, local, visible);
        break;
    case MemoryUse::upload:
        info.memoryTypeIndex =
            memory_type(device_.memory(), requirements.memoryTypeBits, visible, 0, local | cached);
        break;
    case MemoryUse::readback:
        info.memoryTypeIndex =
            memory_type(device_.memory(), requirements.memoryTypeBits, visible, cached, local);
        break;
    }

    Allocation allocation;
    check(device_.call().vkAllocateMemory(device_.handle(), &info, device_.callbacks(), &allocation.memory),
          "vkAllocateMemory");
    if (!mapped) return allocation;
    const VkResult result = device_.call().vkMapMemory(device_.handle(), allocation.memory, 0, VK_WHOLE_SIZE,
                                                       0, &allocation.mapped);
    if (result != VK_SUCCESS) {
        allocation.mapped = nullptr;
        release(allocation);
        check(result, "vkMapMemory");
    }
    return allocation;
}

void DedicatedAllocator::release(const Allocation& allocation) noexcept {
    device_.call().vkFreeMemory(device_.handle(), allocation.memory, device_.callbacks()); // unmaps too
}

} // namespace spa::vulkan
