// SPDX-License-Identifier: Apache-2.0
// ID3D12Device5 with the methods that the loader does not call.
#pragma once

#include "unexpected.h"

namespace spa::test {

class UnusedDevice : public ID3D12Device5 {
public:
    HRESULT STDMETHODCALLTYPE GetPrivateData(REFGUID, UINT*, void*) override { unexpected("GetPrivateData"); }
    HRESULT STDMETHODCALLTYPE SetPrivateData(REFGUID, UINT, const void*) override {
        unexpected("SetPrivateData");
    }
    HRESULT STDMETHODCALLTYPE SetPrivateDataInterface(REFGUID, const IUnknown*) override {
        unexpected("SetPrivateDataInterface");
    }
    HRESULT STDMETHODCALLTYPE SetName(LPCWSTR) override { unexpected("SetName"); }
    UINT STDMETHODCALLTYPE GetNodeCount() override { unexpected("GetNodeCount"); }
    HRESULT STDMETHODCALLTYPE CreateCommandQueue(const D3D12_COMMAND_QUEUE_DESC*, REFIID, void**) override {
        unexpected("CreateCommandQueue");
    }
    HRESULT STDMETHODCALLTYPE CreateCommandAllocator(D3D12_COMMAND_LIST_TYPE, REFIID, void**) override {
        unexpected("CreateCommandAllocator");
    }
    HRESULT STDMETHODCALLTYPE CreateGraphicsPipelineState(const D3D12_GRAPHICS_PIPELINE_STATE_DESC*, REFIID,
                                                          void**) override {
        unexpected("CreateGraphicsPipelineState");
    }
    HRESULT STDMETHODCALLTYPE CreateComputePipelineState(const D3D12_COMPUTE_PIPELINE_STATE_DESC*, REFIID,
                                                         void**) override {
        unexpected("CreateComputePipelineState");
    }
    HRESULT STDMETHODCALLTYPE CreateCommandList(UINT, D3D12_COMMAND_LIST_TYPE, ID3D12CommandAllocator*,
                                                ID3D12PipelineState*, REFIID, void**) override {
        unexpected("CreateCommandList");
    }
    HRESULT STDMETHODCALLTYPE CreateDescriptorHeap(const D3D12_DESCRIPTOR_HEAP_DESC*, REFIID,
                                                   void**) override {
        unexpected("CreateDescriptorHeap");
    }
    UINT STDMETHODCALLTYPE GetDescriptorHandleIncrementSize(D3D12_DESCRIPTOR_HEAP_TYPE) override {
        unexpected("GetDescriptorHandleIncrementSize");
    }
    HRESULT STDMETHODCALLTYPE CreateRootSignature(UINT, const void*, SIZE_T, REFIID, void**) override {
        unexpected("CreateRootSignature");
    }
    void STDMETHODCALLTYPE CreateConstantBufferView(const D3D12_CONSTANT_BUFFER_VIEW_DESC*,
                                                    D3D12_CPU_DESCRIPTOR_HANDLE) override {
        unexpected("CreateConstantBufferView");
    }
    void STDMETHODCALLTYPE CreateShaderResourceView(ID3D12Resource*, const D3D12_SHADER_RESOURCE_VIEW_DESC*,
                                                    D3D12_CPU_DESCRIPTOR_HANDLE) override {
        unexpected("CreateShaderResourceView");
    }
    void STDMETHODCALLTYPE CreateUnorderedAccessView(ID3D12Resource*, ID3D12Resource*,
                                                     const D3D12_UNORDERED_ACCESS_VIEW_DESC*,
                                                     D3D12_CPU_DESCRIPTOR_HANDLE) override {
        unexpected("CreateUnorderedAccessView");
    }
    void STDMETHODCALLTYPE CreateRenderTargetView(ID3D12Resource*, const D3D12_RENDER_TARGET_VIEW_DESC*,
                                                  D3D12_CPU_DESCRIPTOR_HANDLE) override {
        unexpected("CreateRenderTargetView");
    }
    void STDMETHODCALLTYPE CreateDepthStencilView(ID3D12Resource*, const D3D12_DEPTH_STENCIL_VIEW_DESC*,
                                                  D3D12_CPU_DESCRIPTOR_HANDLE) override {
        unexpected("CreateDepthStencilView");
    }
    void STDMETHODCALLTYPE CreateSampler(const D3D12_SAMPLER_DESC*, D3D12_CPU_DESCRIPTOR_HANDLE) override {
        unexpected("CreateSampler");
    }
    void STDMETHODCALLTYPE CopyDescriptors(UINT, const D3D12_CPU_DESCRIPTOR_HANDLE*, const UINT*, UINT,
                                           const D3D12_CPU_DESCRIPTOR_HANDLE*, const UINT*,
                                           D3D12_DESCRIPTOR_HEAP_TYPE) override {
        unexpected("CopyDescriptors");
    }
    void STDMETHODCALLTYPE CopyDescriptorsSimple(UINT, D3D12_CPU_DESCRIPTOR_HANDLE,
                                                 D3D12_CPU_DESCRIPTOR_HANDLE,
                                                 D3D12_DESCRIPTOR_HEAP_TYPE) override {
        unexpected("CopyDescriptorsSimple");
    }
    D3D12_RESOURCE_ALLOCATION_INFO STDMETHODCALLTYPE
    GetResourceAllocationInfo(UINT, UINT, const D3D12_RESOURCE_DESC*) override {
        unexpected("GetResourceAllocationInfo");
    }
    D3D12_HEAP_PROPERTIES STDMETHODCALLTYPE GetCustomHeapProperties(UINT, D3D12_HEAP_TYPE) override {
        unexpected("GetCustomHeapProperties");
    }
    HRESULT STDMETHODCALLTYPE CreateHeap(const D3D12_HEAP_DESC*, REFIID, void**) override {
        unexpected("CreateHeap");
    }
    HRESULT STDMETHODCALLTYPE CreatePlacedResource(ID3D12Heap*, UINT64, const D3D12_RESOURCE_DESC*,
                                                   D3D12_RESOURCE_STATES, const D3D12_CLEAR_VALUE*, REFIID,
                                                   void**) override {
        unexpected("CreatePlacedResource");
    }
    HRESULT STDMETHODCALLTYPE CreateReservedResource(const D3D12_RESOURCE_DESC*, D3D12_RESOURCE_STATES,
                                                     const D3D12_CLEAR_VALUE*, REFIID, void**) override {
        unexpected("CreateReservedResource");
    }
    HRESULT STDMETHODCALLTYPE CreateSharedHandle(ID3D12DeviceChild*, const SECURITY_ATTRIBUTES*, DWORD,
                                                 LPCWSTR, HANDLE*) override {
        unexpected("CreateSharedHandle");
    }
    HRESULT STDMETHODCALLTYPE OpenSharedHandle(HANDLE, REFIID, void**) override {
        unexpected("OpenSharedHandle");
    }
    HRESULT STDMETHODCALLTYPE OpenSharedHandleByName(LPCWSTR, DWORD, /*[annotation][out]*/ HANDLE*) override {
        unexpected("OpenSharedHandleByName");
    }
    HRESULT STDMETHODCALLTYPE MakeResident(UINT, ID3D12Pageable* const*) override {
        unexpected("MakeResident");
    }
    HRESULT STDMETHODCALLTYPE Evict(UINT, ID3D12Pageable* const*) override { unexpected("Evict"); }
    HRESULT STDMETHODCALLTYPE CreateFence(UINT64, D3D12_FENCE_FLAGS, REFIID, void**) override {
        unexpected("CreateFence");
    }
    HRESULT STDMETHODCALLTYPE GetDeviceRemovedReason() override { unexpected("GetDeviceRemovedReason"); }
    void STDMETHODCALLTYPE GetCopyableFootprints(const D3D12_RESOURCE_DESC*, UINT, UINT, UINT64,
                                                 D3D12_PLACED_SUBRESOURCE_FOOTPRINT*, UINT*, UINT64*,
                                                 UINT64*) override {
        unexpected("GetCopyableFootprints");
    }
    HRESULT STDMETHODCALLTYPE CreateQueryHeap(const D3D12_QUERY_HEAP_DESC*, REFIID, void**) override {
        unexpected("CreateQueryHeap");
    }
    HRESULT STDMETHODCALLTYPE SetStablePowerState(BOOL) override { unexpected("SetStablePowerState"); }
    HRESULT STDMETHODCALLTYPE CreateCommandSignature(const D3D12_COMMAND_SIGNATURE_DESC*,
                                                     ID3D12RootSignature*, REFIID, void**) override {
        unexpected("CreateCommandSignature");
    }
    void STDMETHODCALLTYPE GetResourceTiling(ID3D12Resource*, UINT*, D3D12_PACKED_MIP_INFO*,
                                             D3D12_TILE_SHAPE*, UINT*, UINT,
                                             D3D12_SUBRESOURCE_TILING*) override {
        unexpected("GetResourceTiling");
    }
    LUID STDMETHODCALLTYPE GetAdapterLuid() override { unexpected("GetAdapterLuid"); }
    HRESULT STDMETHODCALLTYPE CreatePipelineLibrary(const void*, SIZE_T, REFIID, void**) override {
        unexpected("CreatePipelineLibrary");
    }
    HRESULT STDMETHODCALLTYPE SetEventOnMultipleFenceCompletion(ID3D12Fence* const*, const UINT64*, UINT,
                                                                D3D12_MULTIPLE_FENCE_WAIT_FLAGS,
                                                                HANDLE) override {
        unexpected("SetEventOnMultipleFenceCompletion");
    }
    HRESULT STDMETHODCALLTYPE SetResidencyPriority(UINT, ID3D12Pageable* const*,
                                                   const D3D12_RESIDENCY_PRIORITY*) override {
        unexpected("SetResidencyPriority");
    }
    HRESULT STDMETHODCALLTYPE CreatePipelineState(const D3D12_PIPELINE_STATE_STREAM_DESC*, REFIID,
                                                  void**) override {
        unexpected("CreatePipelineState");
    }
    HRESULT STDMETHODCALLTYPE OpenExistingHeapFromAddress(const void*, REFIID, void**) override {
        unexpected("OpenExistingHeapFromAddress");
    }
    HRESULT STDMETHODCALLTYPE OpenExistingHeapFromFileMapping(HANDLE, REFIID, void**) override {
        unexpected("OpenExistingHeapFromFileMapping");
    }
    HRESULT STDMETHODCALLTYPE EnqueueMakeResident(D3D12_RESIDENCY_FLAGS, UINT, ID3D12Pageable* const*,
                                                  ID3D12Fence*, UINT64) override {
        unexpected("EnqueueMakeResident");
    }
    HRESULT STDMETHODCALLTYPE CreateCommandList1(UINT, D3D12_COMMAND_LIST_TYPE, D3D12_COMMAND_LIST_FLAGS,
                                                 REFIID, void**) override {
        unexpected("CreateCommandList1");
    }
    HRESULT STDMETHODCALLTYPE CreateProtectedResourceSession(const D3D12_PROTECTED_RESOURCE_SESSION_DESC*,
                                                             REFIID, void**) override {
        unexpected("CreateProtectedResourceSession");
    }
    HRESULT STDMETHODCALLTYPE CreateCommittedResource1(const D3D12_HEAP_PROPERTIES*, D3D12_HEAP_FLAGS,
                                                       const D3D12_RESOURCE_DESC*, D3D12_RESOURCE_STATES,
                                                       const D3D12_CLEAR_VALUE*,
                                                       ID3D12ProtectedResourceSession*, REFIID,
                                                       void**) override {
        unexpected("CreateCommittedResource1");
    }
    HRESULT STDMETHODCALLTYPE CreateHeap1(const D3D12_HEAP_DESC*, ID3D12ProtectedResourceSession*, REFIID,
                                          void**) override {
        unexpected("CreateHeap1");
    }
    HRESULT STDMETHODCALLTYPE CreateReservedResource1(const D3D12_RESOURCE_DESC*, D3D12_RESOURCE_STATES,
                                                      const D3D12_CLEAR_VALUE*,
                                                      ID3D12ProtectedResourceSession*, REFIID,
                                                      void**) override {
        unexpected("CreateReservedResource1");
    }
    D3D12_RESOURCE_ALLOCATION_INFO STDMETHODCALLTYPE GetResourceAllocationInfo1(
        UINT, UINT, const D3D12_RESOURCE_DESC*, D3D12_RESOURCE_ALLOCATION_INFO1*) override {
        unexpected("GetResourceAllocationInfo1");
    }
    HRESULT STDMETHODCALLTYPE CreateLifetimeTracker(ID3D12LifetimeOwner*, REFIID, void**) override {
        unexpected("CreateLifetimeTracker");
    }
    void STDMETHODCALLTYPE RemoveDevice() override { unexpected("RemoveDevice"); }
    HRESULT STDMETHODCALLTYPE EnumerateMetaCommands(UINT*, D3D12_META_COMMAND_DESC*) override {
        unexpected("EnumerateMetaCommands");
    }
    HRESULT STDMETHODCALLTYPE EnumerateMetaCommandParameters(REFGUID, D3D12_META_COMMAND_PARAMETER_STAGE,
                                                             UINT*, UINT*,
                                                             D3D12_META_COMMAND_PARAMETER_DESC*) override {
        unexpected("EnumerateMetaCommandParameters");
    }
    HRESULT STDMETHODCALLTYPE CreateMetaCommand(REFGUID, UINT, const void*, SIZE_T, REFIID, void**) override {
        unexpected("CreateMetaCommand");
    }
    HRESULT STDMETHODCALLTYPE CreateStateObject(const D3D12_STATE_OBJECT_DESC*, REFIID, void**) override {
        unexpected("CreateStateObject");
    }
    D3D12_DRIVER_MATCHING_IDENTIFIER_STATUS STDMETHODCALLTYPE CheckDriverMatchingIdentifier(
        D3D12_SERIALIZED_DATA_TYPE, const D3D12_SERIALIZED_DATA_DRIVER_MATCHING_IDENTIFIER*) override {
        unexpected("CheckDriverMatchingIdentifier");
    }
};

} // namespace spa::test
