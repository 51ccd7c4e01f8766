// SPDX-License-Identifier: Apache-2.0
#include "buffer.h"

#include <utility>

namespace spa::vulkan {

Buffer::Buffer(const Device& device, VkDeviceSize size, VkBufferUsageFlags usage, MemoryUse use)
    : device_(&device), size_(size) {
    const DeviceFunctions& call = device.call();
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = size;
    info.usage = usage | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    check(call.vkCreateBuffer(device.handle(), &info, device.callbacks(), &buffer_), "vkCreateBuffer");
    try {
        VkMemoryRequirements requirements{};
        call.vkGetBufferMemoryRequirements(device.handle(), buffer_, &requirements);
        allocation_ = device.allocator().allocate(requirements, use);
        check(call.vkBindBufferMemory(device.handle(), buffer_, allocation_.memory, allocation_.offset),
              "vkBindBufferMemory");
        VkBufferDeviceAddressInfo address{};
        address.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
        address.buffer = buffer_;
        address_ = call.vkGetBufferDeviceAddress(device.handle(), &address);
    } catch (...) {
        destroy();
        throw;
    }
}

Buffer::~Buffer() { destroy(); }

Buffer::Buffer(Buffer&& other) noexcept
    : device_(other.device_), buffer_(std::exchange(other.buffer_, nullptr)),
      allocation_(std::exchange(other.allocation_, {})), size_(std::exchange(other.size_, 0)),
      address_(std::exchange(other.address_, 0)) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    if (this == &other) return *this;
    destroy();
    device_ = other.device_;
    buffer_ = std::exchange(other.buffer_, nullptr);
    allocation_ = std::exchange(other.allocation_, {});
    size_ = std::exchange(other.size_, 0);
    address_ = std::exchange(other.address_, 0);
    return *this;
}

void Buffer::destroy() noexcept {
    if (buffer_ != VK_NULL_HANDLE)
        device_->call().vkDestroyBuffer(device_->handle(), buffer_, device_->callbacks());
    if (allocation_.memory != VK_NULL_HANDLE) device_->allocator().release(allocation_);
}

} // namespace spa::vulkan
