// SPDX-License-Identifier: Apache-2.0
// A buffer and its memory.
#pragma once

#include "device.h"

#include <cstddef>
#include <span>

namespace spa::vulkan {

class Buffer {
public:
    Buffer() = default;
    // size > 0. Every buffer can be addressed from shaders (VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT is
    // added to `usage`), upload and readback buffers are mapped. Throws Error.
    Buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, MemoryUse use);
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;

    [[nodiscard]] bool empty() const { return buffer_ == VK_NULL_HANDLE; }
    [[nodiscard]] VkBuffer handle() const { return buffer_; }
    [[nodiscard]] VkDeviceSize size() const { return size_; }
    [[nodiscard]] VkDeviceAddress address() const { return address_; }
    // Of upload and readback buffers; on the way up write in order, and do not read.
    [[nodiscard]] std::span<std::byte> bytes() const {
        return {static_cast<std::byte*>(allocation_.mapped), std::size_t(size_)};
    }

private:
    void destroy() noexcept;

    const Device* device_ = nullptr;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    Allocation allocation_;
    VkDeviceSize size_ = 0;
    VkDeviceAddress address_ = 0;
};

} // namespace spa::vulkan
