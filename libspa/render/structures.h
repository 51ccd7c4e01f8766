// SPDX-License-Identifier: Apache-2.0
// Bottom levels of triangles.
#pragma once

#include "gpu.h"
#include "scene_triangles.h"

#include "../vulkan/acceleration_structure.h"

#include <span>
#include <vector>

namespace spa::render {

struct TriangleStructures {
    vulkan::Buffer storage;
    std::vector<vulkan::AccelerationStructure> structures; // in storage; one a group
};

// Builds one structure a group and waits. positions, indices: of all groups.
TriangleStructures build_triangles(const Gpu& gpu, std::span<const TriangleGroup> groups,
                                   VkDeviceAddress positions, VkDeviceAddress indices);

} // namespace spa::render
