// SPDX-License-Identifier: Apache-2.0
#include "buffer.h"

namespace spa::dxr {
namespace {

// IID_ID3D12Resource, by value: nothing is linked for its sake.
constexpr GUID resource_id = {0x696442BE, 0xA72E, 0x4059, {0xBC, 0x79, 0x5B, 0x5C, 0x98, 0x04, 0x0F, 0xAD}};

// Buffers begin in the common state, whatever they are for, but for these two.
D3D12_RESOURCE_STATES initial_state(BufferUse use) {
    if (use == BufferUse::structure) return D3D12_RESOURCE_STATE_RAYTRACING_ACCELERATION_STRUCTURE;
    if (use == BufferUse::upload) return D3D12_RESOURCE_STATE_GENERIC_READ;
    return D3D12_RESOURCE_STATE_COMMON;
}

} // namespace

Com<ID3D12Resource> make_buffer(ID3D12Device5* device, std::uint64_t size, BufferUse use) {
    D3D12_HEAP_PROPERTIES heap{};
    heap.Type = use == BufferUse::upload ? D3D12_HEAP_TYPE_UPLOAD : D3D12_HEAP_TYPE_DEFAULT;
    D3D12_RESOURCE_DESC description{};
    description.Dimension = D3D12_RESOURCE_DIMENSION_BUFFER;
    description.Width = size;
    description.Height = 1;
    description.DepthOrArraySize = 1;
    description.MipLevels = 1;
    description.Format = DXGI_FORMAT_UNKNOWN;
    description.SampleDesc.Count = 1;
    description.Layout = D3D12_TEXTURE_LAYOUT_ROW_MAJOR;
    if (use == BufferUse::structure || use == BufferUse::scratch)
        description.Flags = D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS;
    void* buffer = nullptr;
    check(device->CreateCommittedResource(&heap, D3D12_HEAP_FLAG_NONE, &description, initial_state(use),
                                          nullptr, resource_id, &buffer),
          "CreateCommittedResource");
    return Com<ID3D12Resource>(static_cast<ID3D12Resource*>(buffer));
}

} // namespace spa::dxr
