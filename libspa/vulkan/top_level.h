// SPDX-License-Identifier: Apache-2.0
// A top-level acceleration structure of instances: for applications that do not build one already.
#pragma once

#include "acceleration_structure.h"

#include <cstdint>
#include <span>

namespace spa::vulkan {

class TopLevel {
public:
    // instances: at least one; of MapObject::instance, or of triangles. Throws Error.
    TopLevel(const Device& device, std::span<const VkAccelerationStructureInstanceKHR> instances);

    // Build it, after the bottom levels in the same queue. Later commands of the queue may trace without a
    // barrier of their own. Again after set_instances.
    void record(VkCommandBuffer commands);
    // Other transforms, as many instances as before. Not while submitted work builds from the old ones.
    void set_instances(std::span<const VkAccelerationStructureInstanceKHR> instances);

    [[nodiscard]] const AccelerationStructure& structure() const { return structure_; }
    [[nodiscard]] VkDeviceSize bytes() const { return storage_.size(); } // of the structure

private:
    [[nodiscard]] VkAccelerationStructureGeometryKHR geometry() const;

    const Device* device_;
    std::uint32_t count_;
    Buffer instances_, scratch_, storage_;
    AccelerationStructure structure_;
};

} // namespace spa::vulkan
