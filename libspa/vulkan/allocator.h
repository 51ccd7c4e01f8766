// SPDX-License-Identifier: Apache-2.0
// Where buffers get their memory from. An application that has an allocator of its own (VMA, a ring of
// staging memory) puts it behind this interface; without one every buffer has a VkDeviceMemory of its own, of
// which a map needs two for good and two while it is loaded.
#pragma once

#include "functions.h"

namespace spa::vulkan {

enum class MemoryUse {
    device,   // read and written by the device alone
    upload,   // written by the CPU in order, read by the device
    readback, // written by the device, read by the CPU
};

struct Allocation {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    void* mapped = nullptr; // upload, readback: where the CPU sees it, host-coherent; device: not used
    void* owner = nullptr;  // the allocator's own
};

class Allocator {
public:
    virtual ~Allocator() = default;
    // Memory of a type that `requirements` allow, for a buffer whose address is taken on the device
    // (VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT). Throws Error.
    virtual Allocation allocate(const VkMemoryRequirements& requirements, MemoryUse use) = 0;
    virtual void release(const Allocation& allocation) noexcept = 0;
};

} // namespace spa::vulkan
