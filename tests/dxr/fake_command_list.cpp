// SPDX-License-Identifier: Apache-2.0
#include "fake_command_list.h"

#include <cstring>

namespace spa::test {
namespace {

bool overlap(std::uint64_t a, std::uint64_t a_size, std::uint64_t b, std::uint64_t b_size) {
    return a < b + b_size && b < a + a_size;
}

} // namespace

HRESULT FakeCommandList::QueryInterface(REFIID, void**) { unexpected("ID3D12CommandList::QueryInterface"); }

void FakeCommandList::CopyBufferRegion(ID3D12Resource* to, UINT64 to_offset, ID3D12Resource* from,
                                       UINT64 from_offset, UINT64 size) {
    commands.emplace_back("copy");
    auto* const target = static_cast<FakeResource*>(to);
    auto* const source = static_cast<FakeResource*>(from);
    // The first use takes a buffer out of the common state.
    if (target->state == D3D12_RESOURCE_STATE_COMMON) target->state = D3D12_RESOURCE_STATE_COPY_DEST;
    device_.expect(target->state == D3D12_RESOURCE_STATE_COPY_DEST, "copy: not to a target of copies");
    device_.expect(source->heap == D3D12_HEAP_TYPE_UPLOAD && !source->mapped,
                   "copy: not from upload memory that is written and unmapped");
    if (to_offset + size > target->bytes.size() || from_offset + size > source->bytes.size()) {
        device_.expect(false, "copy: outside a buffer");
        return;
    }
    std::memcpy(target->bytes.data() + to_offset, source->bytes.data() + from_offset, std::size_t(size));
}

void FakeCommandList::ResourceBarrier(UINT count, const D3D12_RESOURCE_BARRIER* barriers) {
    for (UINT i = 0; i < count; ++i) {
        const D3D12_RESOURCE_BARRIER& barrier = barriers[i];
        if (barrier.Type == D3D12_RESOURCE_BARRIER_TYPE_TRANSITION) {
            commands.emplace_back("transition");
            auto* const resource = static_cast<FakeResource*>(barrier.Transition.pResource);
            device_.expect(resource->state == barrier.Transition.StateBefore,
                           "transition: the buffer is in another state");
            resource->state = barrier.Transition.StateAfter;
        } else {
            commands.emplace_back("uav");
            device_.expect(barrier.Type == D3D12_RESOURCE_BARRIER_TYPE_UAV, "barrier: of another type");
            const auto* const resource = static_cast<const FakeResource*>(barrier.UAV.pResource);
            for (auto& [address, built] : structures)
                if (resource == nullptr ||
                    (address >= resource->address && address < resource->address + resource->bytes.size()))
                    built.visible = true;
        }
    }
}

void FakeCommandList::BuildRaytracingAccelerationStructure(
    const D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_DESC* build, UINT info_count,
    const D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_DESC*) {
    commands.emplace_back("build");
    device_.expect(info_count == 0, "build: with information behind it");
    const D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS& inputs = build->Inputs;
    device_.expect(inputs.Type == D3D12_RAYTRACING_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL &&
                       inputs.DescsLayout == D3D12_ELEMENTS_LAYOUT_ARRAY && inputs.NumDescs == 1,
                   "build: not a bottom level of one geometry");
    device_.expect(build->SourceAccelerationStructureData == 0, "build: an update");

    const D3D12_GPU_VIRTUAL_ADDRESS target = build->DestAccelerationStructureData;
    const std::uint64_t size = device_.structure_size;
    device_.expect(target % D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BYTE_ALIGNMENT == 0,
                   "build: the structure is not aligned");
    if (const FakeResource* resource = device_.at(target, size))
        device_.expect(resource->state == D3D12_RESOURCE_STATE_RAYTRACING_ACCELERATION_STRUCTURE,
                       "build: not into a buffer of structures");
    for (const auto& [address, built] : structures)
        device_.expect(!overlap(address, built.size, target, size), "build: structures overlap");

    const D3D12_GPU_VIRTUAL_ADDRESS scratch = build->ScratchAccelerationStructureData;
    if (device_.scratch_size > 0) {
        device_.expect(scratch % D3D12_RAYTRACING_ACCELERATION_STRUCTURE_BYTE_ALIGNMENT == 0,
                       "build: the scratch memory is not aligned");
        if (FakeResource* resource = device_.at(scratch, device_.scratch_size)) {
            if (resource->state == D3D12_RESOURCE_STATE_COMMON)
                resource->state = D3D12_RESOURCE_STATE_UNORDERED_ACCESS;
            device_.expect(resource->state == D3D12_RESOURCE_STATE_UNORDERED_ACCESS &&
                               resource->description.Flags == D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS,
                           "build: scratch memory without unordered access");
        }
        for (const D3D12_GPU_VIRTUAL_ADDRESS other : scratch_)
            device_.expect(!overlap(other, device_.scratch_size, scratch, device_.scratch_size),
                           "build: scratch memory is used twice without a barrier");
        scratch_.push_back(scratch);
    }

    BuiltStructure built;
    built.size = size;
    build_box(*inputs.pGeometryDescs, built);
    structures.emplace(target, built);
}

void FakeCommandList::build_box(const D3D12_RAYTRACING_GEOMETRY_DESC& geometry, BuiltStructure& built) {
    device_.expect(geometry.Type == D3D12_RAYTRACING_GEOMETRY_TYPE_PROCEDURAL_PRIMITIVE_AABBS &&
                       geometry.AABBs.AABBCount == 1,
                   "build: not one box");
    const D3D12_GPU_VIRTUAL_ADDRESS_AND_STRIDE& boxes = geometry.AABBs.AABBs;
    device_.expect(boxes.StartAddress % D3D12_RAYTRACING_AABB_BYTE_ALIGNMENT == 0 &&
                       boxes.StrideInBytes % D3D12_RAYTRACING_AABB_BYTE_ALIGNMENT == 0 &&
                       boxes.StrideInBytes >= sizeof(D3D12_RAYTRACING_AABB),
                   "build: the box is not aligned");
    built.flags = geometry.Flags;
    const FakeResource* resource = device_.at(boxes.StartAddress, sizeof(D3D12_RAYTRACING_AABB));
    if (resource == nullptr) return;
    device_.expect((resource->state & D3D12_RESOURCE_STATE_NON_PIXEL_SHADER_RESOURCE) != 0,
                   "build: the box's buffer is not in the state for reading it");
    std::memcpy(&built.box, resource->bytes.data() + (boxes.StartAddress - resource->address),
                sizeof built.box);
}

} // namespace spa::test
