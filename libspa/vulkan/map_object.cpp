// SPDX-License-Identifier: Apache-2.0
#include "map_object.h"

#include "build.h"
#include "submit.h"

#include "../../shaders/spa_hit.h"
#include "../trace/space.h"

#include <cstring>

namespace spa::vulkan {
namespace {

static_assert(sizeof(trace::PackedBox) == sizeof(VkAabbPositionsKHR));

} // namespace

MapObject::MapObject(const Device& device, const SphericalMap& map, const LoadOptions& options)
    : device_(&device), coverage_(options.coverage) {
    write_images(map, options);
    create_structures();
}

void MapObject::write_images(const SphericalMap& map, const LoadOptions& options) {
    const trace::PackedImages packed(map, options.compile, options.whole_sphere);
    for (const trace::PackedPart& part : packed.parts()) parts_.emplace_back().packed = part;
    memory_.images = packed.bytes();
    staging_ = Buffer(*device_, packed.bytes(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryUse::upload);
    packed.write(map, staging_.bytes());
    images_ = Buffer(*device_, packed.bytes(),
                     VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                         VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR,
                     MemoryUse::device);
}

VkAccelerationStructureGeometryKHR MapObject::box_geometry(std::uint32_t part) const {
    VkAccelerationStructureGeometryKHR geometry{};
    geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
    geometry.geometryType = VK_GEOMETRY_TYPE_AABBS_KHR;
    geometry.flags =
        coverage_ ? VK_GEOMETRY_NO_DUPLICATE_ANY_HIT_INVOCATION_BIT_KHR : VK_GEOMETRY_OPAQUE_BIT_KHR;
    VkAccelerationStructureGeometryAabbsDataKHR& boxes = geometry.geometry.aabbs;
    boxes.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_AABBS_DATA_KHR;
    boxes.data.deviceAddress = images_.address() + parts_[part].packed.box;
    boxes.stride = sizeof(VkAabbPositionsKHR);
    return geometry;
}

void MapObject::create_structures() {
    VkDeviceSize structures = 0;
    VkDeviceSize scratch = 0;
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
        const VkAccelerationStructureGeometryKHR geometry = box_geometry(i);
        const VkAccelerationStructureBuildGeometryInfoKHR info =
            build_info(VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, geometry);
        const VkAccelerationStructureBuildSizesInfoKHR sizes = build_sizes(*device_, info, 1);
        parts_[i].structure_offset = structures;
        parts_[i].structure_size = sizes.accelerationStructureSize;
        parts_[i].scratch_offset = scratch;
        structures = align(structures + sizes.accelerationStructureSize, structure_alignment);
        scratch = align(scratch + sizes.buildScratchSize, device_->scratch_alignment());
    }
    structures_ = Buffer(*device_, structures, VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR,
                         MemoryUse::device);
    for (LoadedPart& part : parts_)
        part.structure = AccelerationStructure(*device_, VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR,
                                               structures_, part.structure_offset, part.structure_size);
    // One alignment more: the buffer's own address may be less aligned.
    scratch_ = Buffer(*device_, scratch + device_->scratch_alignment(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                      MemoryUse::device);
    memory_.structures = structures_.size();
    memory_.temporary = staging_.size() + scratch_.size();
}

void MapObject::record(VkCommandBuffer commands) {
    const DeviceFunctions& call = device_->call();
    VkBufferCopy copy{};
    copy.size = staging_.size();
    call.vkCmdCopyBuffer(commands, staging_.handle(), images_.handle(), 1, &copy);
    memory_barrier(call, commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
                   VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_ACCELERATION_STRUCTURE_READ_BIT_KHR);

    const VkDeviceAddress scratch = align(scratch_.address(), device_->scratch_alignment());
    std::vector<VkAccelerationStructureGeometryKHR> geometries;
    for (std::uint32_t i = 0; i < parts_.size(); ++i) geometries.push_back(box_geometry(i));
    std::vector<VkAccelerationStructureBuildGeometryInfoKHR> builds;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        VkAccelerationStructureBuildGeometryInfoKHR& info =
            builds.emplace_back(build_info(VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, geometries[i]));
        info.dstAccelerationStructure = parts_[i].structure.handle();
        info.scratchData.deviceAddress = scratch + parts_[i].scratch_offset;
    }
    const VkAccelerationStructureBuildRangeInfoKHR one_box{1, 0, 0, 0};
    const std::vector<const VkAccelerationStructureBuildRangeInfoKHR*> ranges(parts_.size(), &one_box);
    call.vkCmdBuildAccelerationStructuresKHR(commands, std::uint32_t(builds.size()), builds.data(),
                                             ranges.data());
    build_barrier(call, commands);
}

void MapObject::finish() {
    staging_ = {};
    scratch_ = {};
    memory_.temporary = 0;
}

ShaderRecord MapObject::shader_record(std::uint32_t part, std::uint32_t flags) const {
    if (coverage_) flags |= SPA_RECORD_COVERAGE;
    return {images_.address() + parts_[part].packed.image, flags, part};
}

VkTransformMatrixKHR MapObject::transform(std::uint32_t part, const Affine& object_to_world) const {
    const auto rows = trace::instance_rows(trace::map_space(parts_[part].packed.placement, object_to_world));
    VkTransformMatrixKHR transform{};
    static_assert(sizeof rows == sizeof transform.matrix);
    std::memcpy(transform.matrix, rows.data(), sizeof rows);
    return transform;
}

void MapObject::move(std::span<VkAccelerationStructureInstanceKHR> instances,
                     std::span<const Affine> object_to_world) const {
    for (std::uint32_t part = 0; part < part_count(); ++part)
        instances[part].transform = transform(part, object_to_world[part]);
}

VkAccelerationStructureInstanceKHR MapObject::instance(std::uint32_t part, const Affine& object_to_world,
                                                       const InstanceOptions& options) const {
    const LoadedPart& loaded = parts_[part];
    VkAccelerationStructureInstanceKHR instance{};
    instance.transform = transform(part, object_to_world);
    instance.instanceCustomIndex = options.custom_index & 0xFFFFFFU;
    instance.mask = options.mask;
    instance.instanceShaderBindingTableRecordOffset = options.hit_record & 0xFFFFFFU;
    instance.flags = options.flags & 0xFFU;
    instance.accelerationStructureReference = loaded.structure.address();
    return instance;
}

void load(const Device& device, VkQueue queue, std::uint32_t queue_family,
          std::span<MapObject* const> objects) {
    submit_and_wait(device, queue, queue_family, [&](VkCommandBuffer commands) {
        for (MapObject* object : objects) object->record(commands);
    });
    for (MapObject* object : objects) object->finish();
}

} // namespace spa::vulkan
