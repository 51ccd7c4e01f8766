// SPDX-License-Identifier: Apache-2.0
// An application's device, as the loader uses it. Vulkan 1.2 with VK_KHR_acceleration_structure; to trace,
// VK_KHR_ray_tracing_pipeline or VK_KHR_ray_query.
#pragma once

#include "allocator.h"
#include "functions.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace spa::vulkan {

// How an application traces rays.
struct Tracing {
    bool pipelines = false; // VK_KHR_ray_tracing_pipeline
    bool queries = false;   // VK_KHR_ray_query
};

// Names of the device extensions to enable.
std::vector<const char*> device_extensions(Tracing tracing);

// The features to enable: chain() is for VkDeviceCreateInfo::pNext (pEnabledFeatures stays null), after the
// application has added its own.
class DeviceFeatures {
public:
    explicit DeviceFeatures(Tracing tracing);
    DeviceFeatures(const DeviceFeatures&) = delete;
    DeviceFeatures& operator=(const DeviceFeatures&) = delete;

    VkPhysicalDeviceFeatures2* chain() { return &features; }

    VkPhysicalDeviceFeatures2 features{};
    VkPhysicalDeviceVulkan12Features vulkan12{};
    VkPhysicalDeviceAccelerationStructureFeaturesKHR acceleration_structure{};
    VkPhysicalDeviceRayTracingPipelineFeaturesKHR pipeline{}; // in the chain if tracing.pipelines
    VkPhysicalDeviceRayQueryFeaturesKHR query{};              // in the chain if tracing.queries
};

// What a physical device lacks of that, in words ("VK_KHR_ray_query, bufferDeviceAddress"); empty: nothing.
std::string missing(PFN_vkGetInstanceProcAddr get_proc_addr, VkInstance instance,
                    VkPhysicalDevice physical_device, Tracing tracing);

// What the loader takes from the application. All of it outlives what is made with it.
struct DeviceInfo {
    PFN_vkGetInstanceProcAddr get_proc_addr = nullptr; // of the Vulkan loader
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical_device = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    const VkAllocationCallbacks* callbacks = nullptr;
    Allocator* allocator = nullptr; // null: one vkAllocateMemory a buffer
};

// The device with what was asked of it once. Thread-safe as far as the allocator is.
class Device {
public:
    // Throws Error{unsupported} if a function is missing.
    explicit Device(const DeviceInfo& info);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    [[nodiscard]] VkDevice handle() const { return info_.device; }
    [[nodiscard]] const VkAllocationCallbacks* callbacks() const { return info_.callbacks; }
    [[nodiscard]] const DeviceFunctions& call() const { return functions_; }
    [[nodiscard]] Allocator& allocator() const { return *allocator_; }
    [[nodiscard]] const VkPhysicalDeviceMemoryProperties& memory() const { return memory_; }
    // Of scratch memory for builds; at least 256, because some devices understate it.
    [[nodiscard]] VkDeviceSize scratch_alignment() const { return scratch_alignment_; }

private:
    DeviceInfo info_;
    DeviceFunctions functions_;
    VkPhysicalDeviceMemoryProperties memory_{};
    VkDeviceSize scratch_alignment_ = 256;
    std::unique_ptr<Allocator> own_allocator_; // where the application has none
    Allocator* allocator_ = nullptr;
};

// The smallest multiple of alignment, a power of two, >= value.
constexpr VkDeviceSize align(VkDeviceSize value, VkDeviceSize alignment) {
    return (value + alignment - 1) & ~(alignment - 1);
}

} // namespace spa::vulkan
