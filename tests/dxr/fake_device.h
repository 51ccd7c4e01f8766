// SPDX-License-Identifier: Apache-2.0
// A Direct3D 12 device of the test's own: buffers are memory of this process at made-up addresses, and every
// call that may fail can be told to. What Direct3D's rules forbid is noted in problems().
#pragma once

#include "unused_device.h"
#include "unused_resource.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace spa::test {

class FakeDevice;

class FakeResource final : public UnusedResource {
public:
    FakeResource(FakeDevice& device, D3D12_HEAP_TYPE heap, const D3D12_RESOURCE_DESC& description,
                 D3D12_RESOURCE_STATES state, D3D12_GPU_VIRTUAL_ADDRESS address);
    ~FakeResource();
    FakeResource(const FakeResource&) = delete;
    FakeResource& operator=(const FakeResource&) = delete;

    HRESULT STDMETHODCALLTYPE QueryInterface(REFIID id, void** object) override;
    ULONG STDMETHODCALLTYPE AddRef() override;
    ULONG STDMETHODCALLTYPE Release() override;
    HRESULT STDMETHODCALLTYPE Map(UINT subresource, const D3D12_RANGE* read, void** data) override;
    void STDMETHODCALLTYPE Unmap(UINT subresource, const D3D12_RANGE* written) override;
    D3D12_GPU_VIRTUAL_ADDRESS STDMETHODCALLTYPE GetGPUVirtualAddress() override { return address; }

    const D3D12_HEAP_TYPE heap;
    const D3D12_RESOURCE_DESC description;
    const D3D12_GPU_VIRTUAL_ADDRESS address;
    D3D12_RESOURCE_STATES state;
    bool mapped = false;
    std::vector<std::byte> bytes;

private:
    FakeDevice& device_;
    ULONG references_ = 1;
};

class FakeDevice final : public UnusedDevice {
public:
    FakeDevice() = default;
    FakeDevice(const FakeDevice&) = delete;
    FakeDevice& operator=(const FakeDevice&) = delete;

    HRESULT STDMETHODCALLTYPE QueryInterface(REFIID id, void** object) override;
    ULONG STDMETHODCALLTYPE AddRef() override { return ++references; }
    ULONG STDMETHODCALLTYPE Release() override { return --references; }
    HRESULT STDMETHODCALLTYPE CheckFeatureSupport(D3D12_FEATURE feature, void* data, UINT size) override;
    HRESULT STDMETHODCALLTYPE CreateCommittedResource(
        const D3D12_HEAP_PROPERTIES* heap, D3D12_HEAP_FLAGS flags, const D3D12_RESOURCE_DESC* description,
        D3D12_RESOURCE_STATES state, const D3D12_CLEAR_VALUE* clear, REFIID id, void** resource) override;
    void STDMETHODCALLTYPE GetRaytracingAccelerationStructurePrebuildInfo(
        const D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_INPUTS* inputs,
        D3D12_RAYTRACING_ACCELERATION_STRUCTURE_PREBUILD_INFO* info) override;

    // The resource that holds `size` bytes from this address on; null, and a problem, if there is none.
    FakeResource* at(D3D12_GPU_VIRTUAL_ADDRESS address, std::uint64_t size);
    // Counts a call that may fail: failure, where it is the one that is to.
    HRESULT result();
    void expect(bool holds, const std::string& problem);

    D3D12_RAYTRACING_TIER tier = D3D12_RAYTRACING_TIER_1_0;
    std::uint64_t structure_size = 1000, scratch_size = 300; // neither a multiple of 256
    int failing_call = -1;                                   // counted from 0; -1: none
    HRESULT failure = E_FAIL;
    int calls = 0;
    ULONG references = 1;
    std::vector<FakeResource*> alive;
    std::vector<std::string> problems;

private:
    D3D12_GPU_VIRTUAL_ADDRESS next_address_ = 0x10000;
};

} // namespace spa::test
