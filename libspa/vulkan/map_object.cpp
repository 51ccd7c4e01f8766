// SPDX-License-Identifier: Apache-2.0
#include "map_object.h"

#include "build.h"
#include "submit.h"

#include "../../shaders/spa_hit.h"
#include "../core/error.h"
#include "../trace/space.h"

#include <array>
#include <cstring>

namespace spa::vulkan {
namespace {

constexpr VkDeviceSize image_alignment = 256; // the greatest that any device asks of storage buffers
// Boxes are wider by this share of R: the surface they are made for is only met to rounding.
constexpr float box_margin = 1e-6F;

VkAabbPositionsKHR box_of(const shader::SpaMap& map, bool whole_sphere) {
    // latlong images do not say where their surface is.
    if (whole_sphere || map.mapping != SPA_OCTAHEDRAL) return {-1, -1, -1, 1, 1, 1};
    return {map.box_low.x - box_margin,  map.box_low.y - box_margin,  map.box_low.z - box_margin,
            map.box_high.x + box_margin, map.box_high.y + box_margin, map.box_high.z + box_margin};
}

} // namespace

MapObject::MapObject(const Device& device, const SphericalMap& map, const LoadOptions& options)
    : device_(&device), coverage_(options.coverage) {
    if (map.parts.empty()) throw Error(ExitCode::usage, "there is no part to load: was the file opened?");
    write_images(map, options);
    create_structures();
}

void MapObject::write_images(const SphericalMap& map, const LoadOptions& options) {
    // Without images first: those go straight from the file's mapping to staging memory.
    std::vector<trace::TraceMap> traced;
    VkDeviceSize size = 0;
    for (const Part& part : map.parts) {
        traced.emplace_back(part, trace::CompileOptions{options.compile.layers, false});
        LoadedPart& loaded = parts_.emplace_back();
        loaded.placement = part;
        loaded.placement.layers.clear(); // views that may not outlive this call
        loaded.placement.mixed = {};
        loaded.image = size;
        const std::size_t words =
            options.compile.images ? traced.back().size_with_images(part) : traced.back().words().size();
        loaded.image_words = words;
        size = align(size + words * sizeof(std::uint32_t), image_alignment);
    }
    memory_.images = size;
    for (LoadedPart& part : parts_) {
        part.box = size;
        size += sizeof(VkAabbPositionsKHR);
    }

    staging_ = Buffer(*device_, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryUse::upload);
    std::byte* const bytes = staging_.bytes().data();
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const std::span<std::uint32_t> words(reinterpret_cast<std::uint32_t*>(bytes + parts_[i].image),
                                             parts_[i].image_words);
        if (options.compile.images)
            traced[i].write_with_images(map.parts[i], words);
        else
            std::memcpy(words.data(), traced[i].words().data(), words.size_bytes());
        const VkAabbPositionsKHR box = box_of(traced[i].map(), options.whole_sphere);
        std::memcpy(bytes + parts_[i].box, &box, sizeof box);
    }
    images_ = Buffer(*device_, size,
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
    boxes.data.deviceAddress = images_.address() + parts_[part].box;
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
    return {images_.address() + parts_[part].image, flags, part};
}

VkAccelerationStructureInstanceKHR MapObject::instance(std::uint32_t part, const Affine& object_to_world,
                                                       const InstanceOptions& options) const {
    const LoadedPart& loaded = parts_[part];
    const trace::MapSpace space = trace::map_space(loaded.placement, object_to_world);
    VkAccelerationStructureInstanceKHR instance{};
    const std::array<double, 3> translation{space.origin.x, space.origin.y, space.origin.z};
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d& row = space.to_world.row[i];
        const std::array<double, 4> values{row.x, row.y, row.z, translation[i]};
        for (std::size_t j = 0; j < 4; ++j) instance.transform.matrix[i][j] = float(values[j]);
    }
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
