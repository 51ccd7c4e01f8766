// SPDX-License-Identifier: Apache-2.0
#include "map_object.h"

#include "buffer.h"

#include "../../shaders/spa_hit.h"
#include "../core/error.h"
#include "../trace/space.h"

#include <cstddef>
#include <cstring>
#include <string>

namespace spa::dxr {
namespace {

constexpr std::uint64_t structure_alignment = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BYTE_ALIGNMENT;
static_assert(trace::packed_alignment % D3D12_RAYTRACING_AABB_BYTE_ALIGNMENT == 0);
static_assert(sizeof(trace::PackedBox) == sizeof(D3D12_RAYTRACING_AABB));
static_assert(sizeof(D3D12_RAYTRACING_AABB) % D3D12_RAYTRACING_AABB_BYTE_ALIGNMENT == 0);

void require_ray_tracing(ID3D12Device5* device) {
    D3D12_FEATURE_DATA_D3D12_OPTIONS5 options{};
    check(device->CheckFeatureSupport(D3D12_FEATURE_D3D12_OPTIONS5, &options, sizeof options),
          "CheckFeatureSupport");
    if (options.RaytracingTier < D3D12_RAYTRACING_TIER_1_0)
        throw Error(
            ExitCode::unsupported,
            "this Direct3D device does not trace rays (D3D12_RAYTRACING_TIER_1_0); take another adapter");
}

D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS
build_inputs(const D3D12_RAYTRACING_GEOMETRY_DESC& geometry) {
    D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS inputs{};
    inputs.Type = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL;
    inputs.Flags = D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BUILD_FLAG_PREFER_FAST_TRACE;
    inputs.NumDescs = 1;
    inputs.DescsLayout = D3D12_ELEMENTS_LAYOUT_ARRAY;
    inputs.pGeometryDescs = &geometry;
    return inputs;
}

void transition(ID3D12GraphicsCommandList4* commands, ID3D12Resource* resource, D3D12_RESOURCE_STATES before,
                D3D12_RESOURCE_STATES after) {
    D3D12_RESOURCE_BARRIER barrier{};
    barrier.Type = D3D12_RESOURCE_BARRIER_TYPE_TRANSITION;
    barrier.Transition.pResource = resource;
    barrier.Transition.Subresource = D3D12_RESOURCE_BARRIER_ALL_SUBRESOURCES;
    barrier.Transition.StateBefore = before;
    barrier.Transition.StateAfter = after;
    commands->ResourceBarrier(1, &barrier);
}

void wait_for_builds(ID3D12GraphicsCommandList4* commands, ID3D12Resource* structures) {
    D3D12_RESOURCE_BARRIER barrier{};
    barrier.Type = D3D12_RESOURCE_BARRIER_TYPE_UAV;
    barrier.UAV.pResource = structures;
    commands->ResourceBarrier(1, &barrier);
}

} // namespace

MapObject::MapObject(ID3D12Device5* device, const SphericalMap& map, const LoadOptions& options)
    : coverage_(options.coverage) {
    const trace::PackedImages packed(map, options.compile, options.whole_sphere);
    require_ray_tracing(device);
    write_images(device, map, packed);
    create_structures(device);
}

void MapObject::write_images(ID3D12Device5* device, const SphericalMap& map,
                             const trace::PackedImages& packed) {
    for (const trace::PackedPart& part : packed.parts()) parts_.emplace_back().packed = part;
    const std::uint64_t size = packed.bytes();
    if (size / sizeof(std::uint32_t) > UINT32_MAX)
        throw Error(ExitCode::unsupported, "this map is too large for one buffer: its trace images have " +
                                               std::to_string(size) + " bytes; load it with fewer layers");

    staging_ = make_buffer(device, size, BufferUse::upload);
    const D3D12_RANGE nothing_read{0, 0};
    void* mapped = nullptr;
    check(staging_->Map(0, &nothing_read, &mapped), "ID3D12Resource::Map");
    packed.write(map, {static_cast<std::byte*>(mapped), std::size_t(size)});
    staging_->Unmap(0, nullptr);
    images_ = make_buffer(device, size, BufferUse::data);
    memory_.images = size;
    memory_.temporary = size;
}

D3D12_RAYTRACING_GEOMETRY_DESC MapObject::box_geometry(const LoadedPart& part) const {
    D3D12_RAYTRACING_GEOMETRY_DESC geometry{};
    geometry.Type = D3D12_RAYTRACING_GEOMETRY_TYPE_PROCEDURAL_PRIMITIVE_AABBS;
    geometry.Flags = coverage_ ? D3D12_RAYTRACING_GEOMETRY_FLAG_NO_DUPLICATE_ANYHIT_INVOCATION
                               : D3D12_RAYTRACING_GEOMETRY_FLAG_OPAQUE;
    geometry.AABBs.AABBCount = 1;
    geometry.AABBs.AABBs.StartAddress = images_->GetGPUVirtualAddress() + part.packed.box;
    geometry.AABBs.AABBs.StrideInBytes = sizeof(D3D12_RAYTRACING_AABB);
    return geometry;
}

void MapObject::create_structures(ID3D12Device5* device) {
    std::uint64_t structures = 0;
    std::uint64_t scratch = 0;
    for (LoadedPart& part : parts_) {
        const D3D12_RAYTRACING_GEOMETRY_DESC geometry = box_geometry(part);
        const D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS inputs = build_inputs(geometry);
        D3D12_RAYTRACING_ACCELERATION_STRUCTURE_PREBUILD_INFO sizes{};
        device->GetRaytracingAccelerationStructurePrebuildInfo(&inputs, &sizes);
        if (sizes.ResultDataMaxSizeInBytes == 0)
            throw Error(ExitCode::internal,
                        "GetRaytracingAccelerationStructurePrebuildInfo gives no size for a structure");
        part.structure = structures;
        part.scratch = scratch;
        structures = align(structures + sizes.ResultDataMaxSizeInBytes, structure_alignment);
        // Not shared, so that builds need no barriers between them.
        scratch = align(scratch + sizes.ScratchDataSizeInBytes, structure_alignment);
    }
    structures_ = make_buffer(device, structures, BufferUse::structure);
    memory_.structures = structures;
    if (scratch == 0) return;
    scratch_ = make_buffer(device, scratch, BufferUse::scratch);
    memory_.temporary += scratch;
}

void MapObject::record(ID3D12GraphicsCommandList4* commands) {
    if (staging_.get() == nullptr)
        throw Error(ExitCode::usage, "MapObject::record() after finish(): what it copies is gone");
    // The buffers' first uses take them from the common state to the one for copies, and to unordered access.
    commands->CopyBufferRegion(images_.get(), 0, staging_.get(), 0, memory_.images);
    transition(commands, images_.get(), D3D12_RESOURCE_STATE_COPY_DEST,
               D3D12_RESOURCE_STATE_NON_PIXEL_SHADER_RESOURCE);
    const D3D12_GPU_VIRTUAL_ADDRESS scratch = scratch_.get() ? scratch_->GetGPUVirtualAddress() : 0;
    for (const LoadedPart& part : parts_) {
        const D3D12_RAYTRACING_GEOMETRY_DESC geometry = box_geometry(part);
        D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_DESC build{};
        build.Inputs = build_inputs(geometry);
        build.DestAccelerationStructureData = structures_->GetGPUVirtualAddress() + part.structure;
        build.ScratchAccelerationStructureData = scratch + part.scratch;
        commands->BuildRaytracingAccelerationStructure(&build, 0, nullptr);
    }
    wait_for_builds(commands, structures_.get());
}

void MapObject::finish() {
    staging_.reset();
    scratch_.reset();
    memory_.temporary = 0;
}

D3D12_GPU_VIRTUAL_ADDRESS MapObject::structure(std::uint32_t part) const {
    return structures_->GetGPUVirtualAddress() + parts_[part].structure;
}

std::uint32_t MapObject::record_flags(std::uint32_t flags) const {
    return coverage_ ? flags | SPA_RECORD_COVERAGE : flags;
}

ShaderRecord MapObject::shader_record(std::uint32_t part, std::uint32_t flags) const {
    return {images_->GetGPUVirtualAddress() + parts_[part].packed.image, record_flags(flags), part};
}

QueryRecord MapObject::query_record(std::uint32_t part, std::uint32_t buffer, std::uint32_t flags) const {
    return {std::uint32_t(parts_[part].packed.image / sizeof(std::uint32_t)), buffer, record_flags(flags),
            part};
}

D3D12_RAYTRACING_INSTANCE_DESC MapObject::instance(std::uint32_t part, const Affine& object_to_world,
                                                   const InstanceOptions& options) const {
    const trace::MapSpace space = trace::map_space(parts_[part].packed.placement, object_to_world);
    D3D12_RAYTRACING_INSTANCE_DESC instance{};
    const auto rows = trace::instance_rows(space);
    static_assert(sizeof rows == sizeof instance.Transform);
    std::memcpy(instance.Transform, rows.data(), sizeof rows);
    instance.InstanceID = options.id & 0xFFFFFFU;
    instance.InstanceMask = options.mask;
    instance.InstanceContributionToHitGroupIndex = options.hit_record & 0xFFFFFFU;
    instance.Flags = UINT(options.flags) & 0xFFU;
    instance.AccelerationStructure = structure(part);
    return instance;
}

D3D12_SHADER_RESOURCE_VIEW_DESC MapObject::images_view() const {
    D3D12_SHADER_RESOURCE_VIEW_DESC view{};
    view.Format = DXGI_FORMAT_R32_TYPELESS;
    view.ViewDimension = D3D12_SRV_DIMENSION_BUFFER;
    view.Shader4ComponentMapping = D3D12_DEFAULT_SHADER_4_COMPONENT_MAPPING;
    view.Buffer.NumElements = UINT(memory_.images / sizeof(std::uint32_t));
    view.Buffer.Flags = D3D12_BUFFER_SRV_FLAG_RAW;
    return view;
}

} // namespace spa::dxr
