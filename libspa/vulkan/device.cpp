// SPDX-License-Identifier: Apache-2.0
#include "device.h"

#include "dedicated_allocator.h"

#include <algorithm>
#include <cstring>

namespace spa::vulkan {
namespace {

std::vector<std::string> extensions_of(const InstanceFunctions& call, VkPhysicalDevice device) {
    std::uint32_t count = 0;
    check(call.vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr),
          "vkEnumerateDeviceExtensionProperties");
    std::vector<VkExtensionProperties> properties(count);
    check(call.vkEnumerateDeviceExtensionProperties(device, nullptr, &count, properties.data()),
          "vkEnumerateDeviceExtensionProperties");
    std::vector<std::string> names;
    names.reserve(properties.size());
    for (const VkExtensionProperties& extension : properties) names.emplace_back(extension.extensionName);
    return names;
}

void add(std::string& list, const char* name) {
    if (!list.empty()) list += ", ";
    list += name;
}

} // namespace

std::vector<const char*> device_extensions(Tracing tracing) {
    std::vector<const char*> names{VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                   VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};
    if (tracing.pipelines) names.push_back(VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME);
    if (tracing.queries) names.push_back(VK_KHR_RAY_QUERY_EXTENSION_NAME);
    return names;
}

DeviceFeatures::DeviceFeatures(Tracing tracing) {
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.pNext = &vulkan12;
    vulkan12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    vulkan12.bufferDeviceAddress = VK_TRUE;
    vulkan12.scalarBlockLayout = VK_TRUE;
    vulkan12.pNext = &acceleration_structure;
    acceleration_structure.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR;
    acceleration_structure.accelerationStructure = VK_TRUE;
    pipeline.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR;
    pipeline.rayTracingPipeline = VK_TRUE;
    query.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR;
    query.rayQuery = VK_TRUE;
    void** last = &acceleration_structure.pNext;
    if (tracing.pipelines) {
        *last = &pipeline;
        last = &pipeline.pNext;
    }
    if (tracing.queries) *last = &query;
}

std::string missing(PFN_vkGetInstanceProcAddr get_proc_addr, VkInstance instance,
                    VkPhysicalDevice physical_device, Tracing tracing) {
    const InstanceFunctions call = load_functions(get_proc_addr, instance);
    std::string list;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    call.vkGetPhysicalDeviceProperties2(physical_device, &properties);
    if (properties.properties.apiVersion < VK_API_VERSION_1_2) {
        add(list, "Vulkan 1.2");
        return list;
    }
    const std::vector<std::string> there = extensions_of(call, physical_device);
    for (const char* name : device_extensions(tracing))
        if (std::find(there.begin(), there.end(), name) == there.end()) add(list, name);
    if (!list.empty()) return list; // features of extensions that are not there may not be asked for

    DeviceFeatures has(tracing);
    call.vkGetPhysicalDeviceFeatures2(physical_device, has.chain());
    if (has.vulkan12.bufferDeviceAddress == VK_FALSE) add(list, "bufferDeviceAddress");
    if (has.vulkan12.scalarBlockLayout == VK_FALSE) add(list, "scalarBlockLayout");
    if (has.acceleration_structure.accelerationStructure == VK_FALSE) add(list, "accelerationStructure");
    if (tracing.pipelines && has.pipeline.rayTracingPipeline == VK_FALSE) add(list, "rayTracingPipeline");
    if (tracing.queries && has.query.rayQuery == VK_FALSE) add(list, "rayQuery");
    return list;
}

Device::Device(const DeviceInfo& info) : info_(info) {
    const InstanceFunctions instance = load_functions(info.get_proc_addr, info.instance);
    functions_ = load_functions(instance.vkGetDeviceProcAddr, info.device);
    instance.vkGetPhysicalDeviceMemoryProperties(info.physical_device, &memory_);

    VkPhysicalDeviceAccelerationStructurePropertiesKHR structure{};
    structure.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_PROPERTIES_KHR;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &structure;
    instance.vkGetPhysicalDeviceProperties2(info.physical_device, &properties);
    scratch_alignment_ =
        std::max(scratch_alignment_, VkDeviceSize(structure.minAccelerationStructureScratchOffsetAlignment));

    if (info.allocator == nullptr) own_allocator_ = std::make_unique<DedicatedAllocator>(*this);
    allocator_ = info.allocator == nullptr ? own_allocator_.get() : info.allocator;
}

Device::~Device() = default;

} // namespace spa::vulkan
