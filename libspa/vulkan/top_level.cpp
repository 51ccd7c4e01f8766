// SPDX-License-Identifier: Apache-2.0
#include "top_level.h"

#include "build.h"

#include <algorithm>
#include <cstring>

namespace spa::vulkan {

TopLevel::TopLevel(const Device& device, std::span<const VkAccelerationStructureInstanceKHR> instances)
    : device_(&device), count_(std::uint32_t(instances.size())),
      instances_(device, instances.size_bytes(),
                 VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR, MemoryUse::upload) {
    set_instances(instances);
    const VkAccelerationStructureGeometryKHR instances_of = geometry();
    const VkAccelerationStructureBuildSizesInfoKHR sizes =
        build_sizes(device, build_info(VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, instances_of), count_);
    storage_ = Buffer(device, sizes.accelerationStructureSize,
                      VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR, MemoryUse::device);
    scratch_ = Buffer(device, sizes.buildScratchSize + device.scratch_alignment(),
                      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryUse::device);
    structure_ = AccelerationStructure(device, VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, storage_, 0,
                                       sizes.accelerationStructureSize);
}

VkAccelerationStructureGeometryKHR TopLevel::geometry() const {
    VkAccelerationStructureGeometryKHR geometry{};
    geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
    geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
    VkAccelerationStructureGeometryInstancesDataKHR& instances = geometry.geometry.instances;
    instances.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR;
    instances.data.deviceAddress = instances_.address();
    return geometry;
}

void TopLevel::record(VkCommandBuffer commands) {
    const VkAccelerationStructureGeometryKHR instances_of = geometry();
    VkAccelerationStructureBuildGeometryInfoKHR info =
        build_info(VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, instances_of);
    info.dstAccelerationStructure = structure_.handle();
    info.scratchData.deviceAddress = align(scratch_.address(), device_->scratch_alignment());
    const VkAccelerationStructureBuildRangeInfoKHR range{count_, 0, 0, 0};
    const VkAccelerationStructureBuildRangeInfoKHR* const ranges = &range;
    device_->call().vkCmdBuildAccelerationStructuresKHR(commands, 1, &info, &ranges);
    build_barrier(device_->call(), commands);
}

void TopLevel::set_instances(std::span<const VkAccelerationStructureInstanceKHR> instances) {
    std::memcpy(instances_.bytes().data(), instances.data(),
                std::min(instances.size_bytes(), instances_.bytes().size()));
}

} // namespace spa::vulkan
