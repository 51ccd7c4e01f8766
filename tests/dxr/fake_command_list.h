// SPDX-License-Identifier: Apache-2.0
// A command list that does at once what it is told, as a GPU would, and holds it against Direct3D's rules of
// states, barriers and alignment. Breaches go to the device's problems.
#pragma once

#include "fake_device.h"
#include "unused_command_list.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace spa::test {

struct BuiltStructure {
    std::uint64_t size = 0;
    D3D12_RAYTRACING_AABB box{};
    D3D12_RAYTRACING_GEOMETRY_FLAGS flags = D3D12_RAYTRACING_GEOMETRY_FLAG_NONE;
    bool visible = false; // a barrier came after
};

class FakeCommandList final : public UnusedCommandList {
public:
    explicit FakeCommandList(FakeDevice& device) : device_(device) {}
    FakeCommandList(const FakeCommandList&) = delete;
    FakeCommandList& operator=(const FakeCommandList&) = delete;

    HRESULT STDMETHODCALLTYPE QueryInterface(REFIID id, void** object) override;
    ULONG STDMETHODCALLTYPE AddRef() override { return ++references; }
    ULONG STDMETHODCALLTYPE Release() override { return --references; }
    void STDMETHODCALLTYPE CopyBufferRegion(ID3D12Resource* to, UINT64 to_offset, ID3D12Resource* from,
                                            UINT64 from_offset, UINT64 size) override;
    void STDMETHODCALLTYPE ResourceBarrier(UINT count, const D3D12_RESOURCE_BARRIER* barriers) override;
    void STDMETHODCALLTYPE BuildRaytracingAccelerationStructure(
        const D3D12_BUILD_RAYTRACING_ACCELERATION_STRUCTURE_DESC* build, UINT info_count,
        const D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_DESC* infos) override;

    ULONG references = 1;
    std::vector<std::string> commands; // "copy", "transition", "build", "uav", in order
    std::map<D3D12_GPU_VIRTUAL_ADDRESS, BuiltStructure> structures;

private:
    void build_box(const D3D12_RAYTRACING_GEOMETRY_DESC& geometry, BuiltStructure& built);

    FakeDevice& device_;
    std::vector<D3D12_GPU_VIRTUAL_ADDRESS> scratch_;
};

} // namespace spa::test
