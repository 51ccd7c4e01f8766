// SPDX-License-Identifier: Apache-2.0
// An acceleration structure in a part of a buffer, destroyed with the object.
#pragma once

#include "buffer.h"

namespace spa::vulkan {

class AccelerationStructure {
public:
    AccelerationStructure() = default;
    // In [offset, offset + size) of `buffer`, which outlives it and has the usage
    // VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR. offset: a multiple of 256. Throws Error.
    AccelerationStructure(const Device& device, VkAccelerationStructureTypeKHR type, const Buffer& buffer,
                          VkDeviceSize offset, VkDeviceSize size);
    ~AccelerationStructure();
    AccelerationStructure(AccelerationStructure&& other) noexcept;
    AccelerationStructure& operator=(AccelerationStructure&& other) noexcept;

    [[nodiscard]] VkAccelerationStructureKHR handle() const { return structure_; }
    [[nodiscard]] VkDeviceAddress address() const { return address_; }

private:
    void destroy() noexcept;

    const Device* device_ = nullptr;
    VkAccelerationStructureKHR structure_ = VK_NULL_HANDLE;
    VkDeviceAddress address_ = 0;
};

constexpr VkDeviceSize structure_alignment = 256; // of an acceleration structure in its buffer

} // namespace spa::vulkan
