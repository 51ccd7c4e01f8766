// SPDX-License-Identifier: Apache-2.0
#include "fake_device.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace spa::test {
namespace {

constexpr GUID resource_id = {0x696442BE, 0xA72E, 0x4059, {0xBC, 0x79, 0x5B, 0x5C, 0x98, 0x04, 0x0F, 0xAD}};

} // namespace

void unexpected(const char* method) {
    std::fprintf(stderr, "the loader called %s, which the fakes do not have\n", method);
    std::abort();
}

FakeResource::FakeResource(FakeDevice& device, D3D12_HEAP_TYPE heap_type,
                           const D3D12_RESOURCE_DESC& resource_description,
                           D3D12_RESOURCE_STATES initial_state, D3D12_GPU_VIRTUAL_ADDRESS gpu_address)
    : heap(heap_type), description(resource_description), address(gpu_address), state(initial_state),
      bytes(std::size_t(resource_description.Width), std::byte{0xCD}), device_(device) {
    device_.alive.push_back(this);
}

FakeResource::~FakeResource() { std::erase(device_.alive, this); }

HRESULT FakeResource::QueryInterface(REFIID, void**) { unexpected("ID3D12Resource::QueryInterface"); }

ULONG FakeResource::AddRef() { return ++references_; }

ULONG FakeResource::Release() {
    const ULONG left = --references_;
    if (left == 0) delete this;
    return left;
}

HRESULT FakeResource::Map(UINT subresource, const D3D12_RANGE* read, void** data) {
    device_.expect(subresource == 0, "Map: a buffer has one subresource");
    device_.expect(heap == D3D12_HEAP_TYPE_UPLOAD, "Map: not in an upload heap");
    device_.expect(read != nullptr && read->Begin == read->End, "Map: upload memory is not to be read");
    device_.expect(!mapped, "Map: twice");
    const HRESULT result = device_.result();
    if (FAILED(result)) return result;
    mapped = true;
    *data = bytes.data();
    return S_OK;
}

void FakeResource::Unmap(UINT subresource, const D3D12_RANGE*) {
    device_.expect(subresource == 0 && mapped, "Unmap: not mapped");
    mapped = false;
}

HRESULT FakeDevice::QueryInterface(REFIID, void**) { unexpected("ID3D12Device::QueryInterface"); }

HRESULT FakeDevice::CheckFeatureSupport(D3D12_FEATURE feature, void* data, UINT size) {
    const HRESULT called = result();
    if (FAILED(called)) return called;
    if (feature != D3D12_FEATURE_D3D12_OPTIONS5 || size != sizeof(D3D12_FEATURE_DATA_D3D12_OPTIONS5))
        return E_INVALIDARG;
    static_cast<D3D12_FEATURE_DATA_D3D12_OPTIONS5*>(data)->RaytracingTier = tier;
    return S_OK;
}

HRESULT FakeDevice::CreateCommittedResource(const D3D12_HEAP_PROPERTIES* heap, D3D12_HEAP_FLAGS,
                                            const D3D12_RESOURCE_DESC* description,
                                            D3D12_RESOURCE_STATES state, const D3D12_CLEAR_VALUE* clear,
                                            REFIID id, void** resource) {
    *resource = nullptr;
    expect(id == resource_id, "CreateCommittedResource: not an ID3D12Resource");
    expect(clear == nullptr, "CreateCommittedResource: a buffer has no clear value");
    const D3D12_RESOURCE_DESC& d = *description;
    const bool buffer = d.Dimension == D3D12_RESOURCE_DIMENSION_BUFFER && d.Alignment == 0 && d.Width > 0 &&
                        d.Height == 1 && d.DepthOrArraySize == 1 && d.MipLevels == 1 &&
                        d.Format == DXGI_FORMAT_UNKNOWN && d.SampleDesc.Count == 1 &&
                        d.SampleDesc.Quality == 0 && d.Layout == D3D12_TEXTURE_LAYOUT_ROW_MAJOR;
    expect(buffer, "CreateCommittedResource: not a description of a buffer");
    if (!buffer) return E_INVALIDARG;
    if (heap->Type == D3D12_HEAP_TYPE_UPLOAD)
        expect(state == D3D12_RESOURCE_STATE_GENERIC_READ && d.Flags == D3D12_RESOURCE_FLAG_NONE,
               "CreateCommittedResource: upload heaps hold resources in the generic-read state");
    else
        expect(state == D3D12_RESOURCE_STATE_COMMON ||
                   (state == D3D12_RESOURCE_STATE_RAYTRACING_ACCELERATION_STRUCTURE &&
                    d.Flags == D3D12_RESOURCE_FLAG_ALLOW_UNORDERED_ACCESS),
               "CreateCommittedResource: a buffer begins in the common state or as acceleration structures");
    const HRESULT called = result();
    if (FAILED(called)) return called;
    // Own addresses, 64 KiB aligned, with a gap between.
    *resource = new FakeResource(*this, heap->Type, d, state, next_address_);
    next_address_ += (d.Width + 0x1FFFF) & ~std::uint64_t(0xFFFF);
    return S_OK;
}

void FakeDevice::GetRaytracingAccelerationStructurePrebuildInfo(
    const D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS* inputs,
    D3D12_RAYTRACING_ACCELERATION_STRUCTURE_PREBUILD_INFO* info) {
    expect(inputs->Type == D3D12_RAYTRACING_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL && inputs->NumDescs == 1,
           "GetRaytracingAccelerationStructurePrebuildInfo: not one geometry");
    info->ResultDataMaxSizeInBytes = structure_size;
    info->ScratchDataSizeInBytes = scratch_size;
    info->UpdateScratchDataSizeInBytes = 0;
}

FakeResource* FakeDevice::at(D3D12_GPU_VIRTUAL_ADDRESS address, std::uint64_t size) {
    const auto found = std::find_if(alive.begin(), alive.end(), [&](const FakeResource* resource) {
        return address >= resource->address &&
               address + size <= resource->address + resource->description.Width;
    });
    if (found != alive.end()) return *found;
    problems.emplace_back("there is no buffer at an address");
    return nullptr;
}

HRESULT FakeDevice::result() { return calls++ == failing_call ? failure : S_OK; }

void FakeDevice::expect(bool holds, const std::string& problem) {
    if (!holds) problems.push_back(problem);
}

} // namespace spa::test
