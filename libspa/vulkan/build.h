// SPDX-License-Identifier: Apache-2.0
// What builds of acceleration structures share.
#pragma once

#include "device.h"

namespace spa::vulkan {

// A build of one geometry, for fast tracing. geometry: outlives the result.
VkAccelerationStructureBuildGeometryInfoKHR build_info(VkAccelerationStructureTypeKHR type,
                                                       const VkAccelerationStructureGeometryKHR& geometry);

// primitives: boxes, triangles or instances.
VkAccelerationStructureBuildSizesInfoKHR build_sizes(const Device& device,
                                                     const VkAccelerationStructureBuildGeometryInfoKHR& info,
                                                     std::uint32_t primitives);

// What is written by `from` in this stage is seen by `to` of every later command.
void memory_barrier(const DeviceFunctions& call, VkCommandBuffer commands, VkPipelineStageFlags stage,
                    VkAccessFlags from, VkAccessFlags to);
// After builds: later builds and traces read what they made.
void build_barrier(const DeviceFunctions& call, VkCommandBuffer commands);

} // namespace spa::vulkan
