// SPDX-License-Identifier: Apache-2.0
// A Vulkan device with one compute queue and no window, watched by the validation layer where that is
// installed.
#pragma once

#include "../../libspa/vulkan/device.h"

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>
#include <vector>

namespace spa::test {

// Throws Error{internal} that names `what` unless the call succeeded.
void check(VkResult result, const char* what);

// What the validation layer said, one message a string. Outlives the device, because the layer speaks of
// leaks when the device goes.
using ValidationLog = std::vector<std::string>;

// A folder with other SPIR-V of all shaders that trace loaded maps, from the environment variable
// SPA_MAP_SHADERS (tools/check_hlsl.sh); or null. It may be of version 1.6 and have 64-bit integers.
const char* other_map_shaders();

class VulkanDevice {
public:
    // Mesa's software device, lavapipe, so that results are the same everywhere; with the environment
    // variable SPA_VULKAN_ANY_DEVICE the first device with a compute queue. It traces rays as asked. Throws
    // Error{unsupported} if there is none, or no Vulkan at all.
    VulkanDevice(ValidationLog& log, vulkan::Tracing tracing);
    ~VulkanDevice();
    VulkanDevice(const VulkanDevice&) = delete;
    VulkanDevice& operator=(const VulkanDevice&) = delete;

    [[nodiscard]] VkInstance instance() const { return instance_; }
    [[nodiscard]] VkPhysicalDevice physical_device() const { return physical_device_; }
    [[nodiscard]] VkDevice handle() const { return device_; }
    [[nodiscard]] VkQueue queue() const { return queue_; }
    [[nodiscard]] std::uint32_t queue_family() const { return queue_family_; }
    [[nodiscard]] const VkPhysicalDeviceLimits& limits() const { return limits_; }
    [[nodiscard]] bool validated() const { return validated_; }
    // Names of device and driver, for reports.
    [[nodiscard]] const std::string& description() const { return description_; }

    // The first memory type among `allowed` (a bit mask) that the CPU can map and need not flush. For storage
    // buffers every device has one.
    [[nodiscard]] std::uint32_t host_memory_type(std::uint32_t allowed) const;

private:
    void create_instance(ValidationLog& log);
    void choose_device(vulkan::Tracing tracing);
    void create_device(vulkan::Tracing tracing);
    void destroy();

    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    std::uint32_t queue_family_ = 0;
    VkPhysicalDeviceLimits limits_{};
    bool validated_ = false;
    std::string description_;
};

// A handle made from a device, destroyed by `destroy`, such as vkDestroyBuffer.
template <class T, auto destroy>
class DeviceHandle {
public:
    explicit DeviceHandle(const VulkanDevice& device) : device_(device.handle()) {}
    ~DeviceHandle() {
        if (handle_ != VK_NULL_HANDLE) destroy(device_, handle_, nullptr);
    }
    DeviceHandle(const DeviceHandle&) = delete;
    DeviceHandle& operator=(const DeviceHandle&) = delete;

    [[nodiscard]] T get() const { return handle_; }
    // Where a vkCreate function puts it; once.
    [[nodiscard]] T* out() { return &handle_; }

private:
    VkDevice device_;
    T handle_ = VK_NULL_HANDLE;
};

} // namespace spa::test
