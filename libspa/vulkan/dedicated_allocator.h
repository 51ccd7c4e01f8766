// SPDX-License-Identifier: Apache-2.0
// A VkDeviceMemory for every buffer: for applications without an allocator of their own.
#pragma once

#include "allocator.h"

namespace spa::vulkan {

class Device;

class DedicatedAllocator : public Allocator {
public:
    explicit DedicatedAllocator(const Device& device) : device_(device) {}
    Allocation allocate(const VkMemoryRequirements& requirements, MemoryUse use) override;
    void release(const Allocation& allocation) noexcept override;

private:
    const Device& device_;
};

} // namespace spa::vulkan
