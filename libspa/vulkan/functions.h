// SPDX-License-Identifier: Apache-2.0
// The Vulkan functions that the loader calls, by pointer: nothing here links a Vulkan library.
#pragma once

#include <vulkan/vulkan_core.h>

namespace spa::vulkan {

#define SPA_VULKAN_INSTANCE_FUNCTIONS(X)                                                                     \
    X(vkEnumerateDeviceExtensionProperties)                                                                  \
    X(vkGetDeviceProcAddr)                                                                                   \
    X(vkGetPhysicalDeviceFeatures2)                                                                          \
    X(vkGetPhysicalDeviceMemoryProperties)                                                                   \
    X(vkGetPhysicalDeviceProperties2)

#define SPA_VULKAN_DEVICE_FUNCTIONS(X)                                                                       \
    X(vkAllocateCommandBuffers)                                                                              \
    X(vkAllocateMemory)                                                                                      \
    X(vkBeginCommandBuffer)                                                                                  \
    X(vkBindBufferMemory)                                                                                    \
    X(vkCmdBuildAccelerationStructuresKHR)                                                                   \
    X(vkCmdCopyBuffer)                                                                                       \
    X(vkCmdPipelineBarrier)                                                                                  \
    X(vkCreateAccelerationStructureKHR)                                                                      \
    X(vkCreateBuffer)                                                                                        \
    X(vkCreateCommandPool)                                                                                   \
    X(vkCreateFence)                                                                                         \
    X(vkDestroyAccelerationStructureKHR)                                                                     \
    X(vkDestroyBuffer)                                                                                       \
    X(vkDestroyCommandPool)                                                                                  \
    X(vkDestroyFence)                                                                                        \
    X(vkEndCommandBuffer)                                                                                    \
    X(vkFreeMemory)                                                                                          \
    X(vkGetAccelerationStructureBuildSizesKHR)                                                               \
    X(vkGetAccelerationStructureDeviceAddressKHR)                                                            \
    X(vkGetBufferDeviceAddress)                                                                              \
    X(vkGetBufferMemoryRequirements)                                                                         \
    X(vkMapMemory)                                                                                           \
    X(vkQueueSubmit)                                                                                         \
    X(vkUnmapMemory)                                                                                         \
    X(vkWaitForFences)

#define SPA_VULKAN_MEMBER(name) PFN_##name name = nullptr;
struct InstanceFunctions {
    SPA_VULKAN_INSTANCE_FUNCTIONS(SPA_VULKAN_MEMBER)
};
struct DeviceFunctions {
    SPA_VULKAN_DEVICE_FUNCTIONS(SPA_VULKAN_MEMBER)
};
#undef SPA_VULKAN_MEMBER

// Throw Error{unsupported} that names a function which the instance or the device lacks.
InstanceFunctions load_functions(PFN_vkGetInstanceProcAddr get_proc_addr, VkInstance instance);
DeviceFunctions load_functions(PFN_vkGetDeviceProcAddr get_proc_addr, VkDevice device);

// Throws Error unless result is VK_SUCCESS: unsupported where memory ran out, else internal. what: the
// function that was called.
void check(VkResult result, const char* what);

} // namespace spa::vulkan
