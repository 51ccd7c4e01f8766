// SPDX-License-Identifier: Apache-2.0
#include "acceleration_structure.h"

#include <utility>

namespace spa::vulkan {

AccelerationStructure::AccelerationStructure(const Device& device, VkAccelerationStructureTypeKHR type,
                                             const Buffer& buffer, VkDeviceSize offset, VkDeviceSize size)
    : device_(&device) {
    VkAccelerationStructureCreateInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR;
    info.buffer = buffer.handle();
    info.offset = offset;
    info.size = size;
    info.type = type;
    check(device.call().vkCreateAccelerationStructureKHR(device.handle(), &info, device.callbacks(),
                                                         &structure_),
          "vkCreateAccelerationStructureKHR");
    VkAccelerationStructureDeviceAddressInfoKHR address{};
    address.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR;
    address.accelerationStructure = structure_;
    address_ = device.call().vkGetAccelerationStructureDeviceAddressKHR(device.handle(), &address);
}

AccelerationStructure::~AccelerationStructure() { destroy(); }

AccelerationStructure::AccelerationStructure(AccelerationStructure&& other) noexcept
    : device_(other.device_), structure_(std::exchange(other.structure_, nullptr)),
      address_(std::exchange(other.address_, 0)) {}

AccelerationStructure& AccelerationStructure::operator=(AccelerationStructure&& other) noexcept {
    if (this == &other) return *this;
    destroy();
    device_ = other.device_;
    structure_ = std::exchange(other.structure_, nullptr);
    address_ = std::exchange(other.address_, 0);
    return *this;
}

void AccelerationStructure::destroy() noexcept {
    if (structure_ != VK_NULL_HANDLE)
        device_->call().vkDestroyAccelerationStructureKHR(device_->handle(), structure_,
                                                          device_->callbacks());
}

} // namespace spa::vulkan
