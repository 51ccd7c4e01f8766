// SPDX-License-Identifier: Apache-2.0
#include "structures.h"

#include "../vulkan/build.h"
#include "../vulkan/submit.h"

#include <algorithm>

namespace spa::render {
namespace {

VkAccelerationStructureGeometryKHR geometry_of(const TriangleGroup& group, VkDeviceAddress positions,
                                               VkDeviceAddress indices) {
    VkAccelerationStructureGeometryKHR geometry{};
    geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
    geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
    geometry.flags =
        group.alpha ? VK_GEOMETRY_NO_DUPLICATE_ANY_HIT_INVOCATION_BIT_KHR : VK_GEOMETRY_OPAQUE_BIT_KHR;
    VkAccelerationStructureGeometryTrianglesDataKHR& triangles = geometry.geometry.triangles;
    triangles.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR;
    triangles.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
    triangles.vertexData.deviceAddress = positions;
    triangles.vertexStride = sizeof(Vec3f);
    triangles.maxVertex = group.first_vertex + group.vertex_count - 1;
    triangles.indexType = VK_INDEX_TYPE_UINT32;
    triangles.indexData.deviceAddress = indices + group.first_triangle * sizeof(Triangle);
    return geometry;
}

} // namespace

TriangleStructures build_triangles(const Gpu& gpu, std::span<const TriangleGroup> groups,
                                   VkDeviceAddress positions, VkDeviceAddress indices) {
    TriangleStructures result;
    if (groups.empty()) return result;
    const vulkan::Device& device = gpu.device();
    std::vector<VkAccelerationStructureGeometryKHR> geometries;
    for (const TriangleGroup& group : groups) geometries.push_back(geometry_of(group, positions, indices));
    std::vector<VkAccelerationStructureBuildGeometryInfoKHR> builds;
    std::vector<VkDeviceSize> offsets;
    std::vector<VkDeviceSize> sizes;
    VkDeviceSize storage = 0;
    VkDeviceSize scratch = 0; // of the largest: they are built one after the other
    for (std::size_t i = 0; i < groups.size(); ++i) {
        builds.push_back(vulkan::build_info(VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, geometries[i]));
        const VkAccelerationStructureBuildSizesInfoKHR needed =
            vulkan::build_sizes(device, builds[i], groups[i].triangle_count);
        offsets.push_back(storage);
        sizes.push_back(needed.accelerationStructureSize);
        storage = vulkan::align(storage + needed.accelerationStructureSize, vulkan::structure_alignment);
        scratch = std::max(scratch, needed.buildScratchSize);
    }
    result.storage = vulkan::Buffer(device, storage, VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR,
                                    vulkan::MemoryUse::device);
    const vulkan::Buffer scratch_buffer(device, scratch + device.scratch_alignment(),
                                        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, vulkan::MemoryUse::device);
    for (std::size_t i = 0; i < groups.size(); ++i) {
        result.structures.emplace_back(device, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR,
                                       result.storage, offsets[i], sizes[i]);
        builds[i].dstAccelerationStructure = result.structures[i].handle();
        builds[i].scratchData.deviceAddress =
            vulkan::align(scratch_buffer.address(), device.scratch_alignment());
    }
    // A submission each: large ones take their time.
    for (std::size_t i = 0; i < groups.size(); ++i) {
        vulkan::submit_and_wait(device, gpu.queue(), gpu.queue_family(), [&](VkCommandBuffer commands) {
            const VkAccelerationStructureBuildRangeInfoKHR range{groups[i].triangle_count, 0, 0, 0};
            const VkAccelerationStructureBuildRangeInfoKHR* const ranges = &range;
            device.call().vkCmdBuildAccelerationStructuresKHR(commands, 1, &builds[i], &ranges);
            vulkan::build_barrier(device.call(), commands);
        });
    }
    return result;
}

} // namespace spa::render
