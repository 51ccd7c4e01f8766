// SPDX-License-Identifier: Apache-2.0
// The run-time loader: a spherical map on a Vulkan device, ready to be traced beside triangles.
//
// Order of operations:
//   1. Create the VkDevice with device_extensions() and DeviceFeatures (device.h), and a Device of it.
//   2. Open the file (formats/container/reader.h), and make a MapObject of File::map(). Everything is
//      allocated, and the images are written from the file's mapping straight into staging memory. The file
//      may be closed now.
//   3. record() into a command buffer of a queue that can compute: copies, barriers, one bottom-level
//      acceleration structure a part. Submit it. load() does both for an application that may wait.
//   4. After the submission's fence: finish() gives staging and scratch memory back.
//   5. Put instance() of every part into a top-level structure, as often as wanted. Its instances with
//      transforms of their own are what moves: move() for another pose, then the top level again
//      (TopLevel::set_instances and record); bottom levels are never built again.
//   6a. Ray-tracing pipelines: a hit group from the shaders of hit_group.h, a shader record a part: the
//   group's
//      handle, then the 16 bytes of shader_record(); InstanceOptions::hit_record says which is an instance's.
//   6b. Ray queries: a buffer of shader_record(), one a custom index; #include "spa_ray_query.glsl" in the
//   shader.
//   7. Destroy the MapObject when no submitted work uses it any more.
#pragma once

#include "acceleration_structure.h"
#include "buffer.h"

#include "../core/affine.h"
#include "../core/spherical_map.h"
#include "../trace/packed_images.h"

#include <cstdint>
#include <span>
#include <vector>

namespace spa::vulkan {

// What a hit shader reads of one part, after the shader group's handle or as an element of a table
// (shaders/spa_record.glsl).
struct ShaderRecord {
    VkDeviceAddress image = 0; // of the part's trace image (shaders/spa_map.h)
    std::uint32_t flags = 0;   // SPA_CULL_BACK, SPA_CULL_FRONT, SPA_RECORD_COVERAGE (shaders/spa_hit.h)
    std::uint32_t part = 0;    // number of the part in the map
};
static_assert(sizeof(ShaderRecord) == 16);

struct LoadOptions {
    trace::CompileOptions compile; // layers, and whether with colours and normals
    // Lets rays through where the map stores little coverage: records have SPA_RECORD_COVERAGE, and the
    // geometry is not opaque, so that hits call an any-hit shader (spa.rahit).
    bool coverage = false;
    // The box of a part is that of its sphere instead of the stored surface: for fan and march, whose nearest
    // samples and test points reach beyond the surface between the samples. The projective trace is faster
    // without.
    bool whole_sphere = false;
};

struct InstanceOptions {
    std::uint32_t custom_index = 0; // < 2^24; of the record in a table, for ray queries
    std::uint8_t mask = 0xFF;       // of rays that may see it
    std::uint32_t hit_record = 0;   // < 2^24; instanceShaderBindingTableRecordOffset
    VkGeometryInstanceFlagsKHR flags = 0;
};

struct MemoryUsed {              // bytes
    VkDeviceSize images = 0;     // trace images and boxes
    VkDeviceSize structures = 0; // acceleration structures
    VkDeviceSize temporary = 0;  // staging and scratch, until finish()
};

class MapObject {
public:
    // Step 2. map: as a reader that has checked it gives it, or a bake; need not outlive the call. Throws
    // Error: unsupported if the device's memory does not suffice or a part is too large (TraceMap), internal
    // if Vulkan fails. O(samples).
    MapObject(const Device& device, const SphericalMap& map, const LoadOptions& options = {});

    // Step 3. `commands` is recording, outside a render pass. Once. Later commands of the queue may trace
    // against the parts without a barrier of their own.
    void record(VkCommandBuffer commands);
    // Step 4.
    void finish();

    [[nodiscard]] std::uint32_t part_count() const { return std::uint32_t(parts_.size()); }
    [[nodiscard]] const AccelerationStructure& structure(std::uint32_t part) const {
        return parts_[part].structure;
    }
    // flags: SPA_CULL_BACK, SPA_CULL_FRONT.
    [[nodiscard]] ShaderRecord shader_record(std::uint32_t part, std::uint32_t flags = 0) const;
    // A part somewhere in the world: the shader's object space is the part's map space (shaders/README.md),
    // so that t is the world's. object_to_world has an inverse; it may mirror, shear and scale unevenly.
    [[nodiscard]] VkAccelerationStructureInstanceKHR
    instance(std::uint32_t part, const Affine& object_to_world, const InstanceOptions& options = {}) const;
    // Another pose: of instances that instance() made, part by part from the first one on, the transforms
    // alone become others. object_to_world: one entry a part (pose_parts, ../mesh/pose.h), as for instance();
    // instances: as many. O(parts).
    void move(std::span<VkAccelerationStructureInstanceKHR> instances,
              std::span<const Affine> object_to_world) const;
    [[nodiscard]] const MemoryUsed& memory() const { return memory_; }

private:
    struct LoadedPart {
        trace::PackedPart packed; // where in images_
        VkDeviceSize structure_offset = 0, structure_size = 0, scratch_offset = 0;
        AccelerationStructure structure;
    };
    void write_images(const SphericalMap& map, const LoadOptions& options);
    void create_structures();
    [[nodiscard]] VkTransformMatrixKHR transform(std::uint32_t part, const Affine& object_to_world) const;
    [[nodiscard]] VkAccelerationStructureGeometryKHR box_geometry(std::uint32_t part) const;

    const Device* device_;
    bool coverage_;
    Buffer images_;     // trace images, then the boxes from which bottom levels are built
    Buffer structures_; // bottom levels
    Buffer staging_;    // what images_ will hold
    Buffer scratch_;
    std::vector<LoadedPart> parts_; // after structures_, in which theirs lie
    MemoryUsed memory_;
};

// Steps 3 and 4 for several objects, by a command buffer of its own that is waited for. queue: of this
// family, which can compute; not used by others meanwhile.
void load(const Device& device, VkQueue queue, std::uint32_t queue_family,
          std::span<MapObject* const> objects);

} // namespace spa::vulkan
