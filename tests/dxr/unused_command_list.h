// SPDX-License-Identifier: Apache-2.0
// ID3D12GraphicsCommandList4 with the methods that the loader does not call.
#pragma once

#include "unexpected.h"

namespace spa::test {

class UnusedCommandList : public ID3D12GraphicsCommandList4 {
public:
    HRESULT STDMETHODCALLTYPE GetPrivateData(REFGUID, UINT*, void*) override { unexpected("GetPrivateData"); }
    HRESULT STDMETHODCALLTYPE SetPrivateData(REFGUID, UINT, const void*) override {
        unexpected("SetPrivateData");
    }
    HRESULT STDMETHODCALLTYPE SetPrivateDataInterface(REFGUID, const IUnknown*) override {
        unexpected("SetPrivateDataInterface");
    }
    HRESULT STDMETHODCALLTYPE SetName(LPCWSTR) override { unexpected("SetName"); }
    HRESULT STDMETHODCALLTYPE GetDevice(REFIID, void**) override { unexpected("GetDevice"); }
    D3D12_COMMAND_LIST_TYPE STDMETHODCALLTYPE GetType() override { unexpected("GetType"); }
    HRESULT STDMETHODCALLTYPE Close() override { unexpected("Close"); }
    HRESULT STDMETHODCALLTYPE Reset(ID3D12CommandAllocator*, ID3D12PipelineState*) override {
        unexpected("Reset");
    }
    void STDMETHODCALLTYPE ClearState(ID3D12PipelineState*) override { unexpected("ClearState"); }
    void STDMETHODCALLTYPE DrawInstanced(UINT, UINT, UINT, UINT) override { unexpected("DrawInstanced"); }
    void STDMETHODCALLTYPE DrawIndexedInstanced(UINT, UINT, UINT, INT, UINT) override {
        unexpected("DrawIndexedInstanced");
    }
    void STDMETHODCALLTYPE Dispatch(UINT, UINT, UINT) override { unexpected("Dispatch"); }
    void STDMETHODCALLTYPE CopyTextureRegion(const D3D12_TEXTURE_COPY_LOCATION*, UINT, UINT, UINT,
                                             const D3D12_TEXTURE_COPY_LOCATION*, const D3D12_BOX*) override {
        unexpected("CopyTextureRegion");
    }
    void STDMETHODCALLTYPE CopyResource(ID3D12Resource*, ID3D12Resource*) override {
        unexpected("CopyResource");
    }
    void STDMETHODCALLTYPE CopyTiles(ID3D12Resource*, const D3D12_TILED_RESOURCE_COORDINATE*,
                                     const D3D12_TILE_REGION_SIZE*, ID3D12Resource*, UINT64,
                                     D3D12_TILE_COPY_FLAGS) override {
        unexpected("CopyTiles");
    }
    void STDMETHODCALLTYPE ResolveSubresource(ID3D12Resource*, UINT, ID3D12Resource*, UINT,
                                              DXGI_FORMAT) override {
        unexpected("ResolveSubresource");
    }
    void STDMETHODCALLTYPE IASetPrimitiveTopology(D3D12_PRIMITIVE_TOPOLOGY) override {
        unexpected("IASetPrimitiveTopology");
    }
    void STDMETHODCALLTYPE RSSetViewports(UINT, const D3D12_VIEWPORT*) override {
        unexpected("RSSetViewports");
    }
    void STDMETHODCALLTYPE RSSetScissorRects(UINT, const D3D12_RECT*) override {
        unexpected("RSSetScissorRects");
    }
    void STDMETHODCALLTYPE OMSetBlendFactor(const FLOAT*) override { unexpected("OMSetBlendFactor"); }
    void STDMETHODCALLTYPE OMSetStencilRef(UINT) override { unexpected("OMSetStencilRef"); }
    void STDMETHODCALLTYPE SetPipelineState(ID3D12PipelineState*) override { unexpected("SetPipelineState"); }
    void STDMETHODCALLTYPE ExecuteBundle(ID3D12GraphicsCommandList*) override { unexpected("ExecuteBundle"); }
    void STDMETHODCALLTYPE SetDescriptorHeaps(UINT, ID3D12DescriptorHeap* const*) override {
        unexpected("SetDescriptorHeaps");
    }
    void STDMETHODCALLTYPE SetComputeRootSignature(ID3D12RootSignature*) override {
        unexpected("SetComputeRootSignature");
    }
    void STDMETHODCALLTYPE SetGraphicsRootSignature(ID3D12RootSignature*) override {
        unexpected("SetGraphicsRootSignature");
    }
    void STDMETHODCALLTYPE SetComputeRootDescriptorTable(UINT, D3D12_GPU_DESCRIPTOR_HANDLE) override {
        unexpected("SetComputeRootDescriptorTable");
    }
    void STDMETHODCALLTYPE SetGraphicsRootDescriptorTable(UINT, D3D12_GPU_DESCRIPTOR_HANDLE) override {
        unexpected("SetGraphicsRootDescriptorTable");
    }
    void STDMETHODCALLTYPE SetComputeRoot32BitConstant(UINT, UINT, UINT) override {
        unexpected("SetComputeRoot32BitConstant");
    }
    void STDMETHODCALLTYPE SetGraphicsRoot32BitConstant(UINT, UINT, UINT) override {
        unexpected("SetGraphicsRoot32BitConstant");
    }
    void STDMETHODCALLTYPE SetComputeRoot32BitConstants(UINT, UINT, const void*, UINT) override {
        unexpected("SetComputeRoot32BitConstants");
    }
    void STDMETHODCALLTYPE SetGraphicsRoot32BitConstants(UINT, UINT, const void*, UINT) override {
        unexpected("SetGraphicsRoot32BitConstants");
    }
    void STDMETHODCALLTYPE SetComputeRootConstantBufferView(UINT, D3D12_GPU_VIRTUAL_ADDRESS) override {
        unexpected("SetComputeRootConstantBufferView");
    }
    void STDMETHODCALLTYPE SetGraphicsRootConstantBufferView(UINT, D3D12_GPU_VIRTUAL_ADDRESS) override {
        unexpected("SetGraphicsRootConstantBufferView");
    }
    void STDMETHODCALLTYPE SetComputeRootShaderResourceView(UINT, D3D12_GPU_VIRTUAL_ADDRESS) override {
        unexpected("SetComputeRootShaderResourceView");
    }
    void STDMETHODCALLTYPE SetGraphicsRootShaderResourceView(UINT, D3D12_GPU_VIRTUAL_ADDRESS) override {
        unexpected("SetGraphicsRootShaderResourceView");
    }
    void STDMETHODCALLTYPE SetComputeRootUnorderedAccessView(UINT, D3D12_GPU_VIRTUAL_ADDRESS) override {
        unexpected("SetComputeRootUnorderedAccessView");
    }
    void STDMETHODCALLTYPE SetGraphicsRootUnorderedAccessView(UINT, D3D12_GPU_VIRTUAL_ADDRESS) override {
        unexpected("SetGraphicsRootUnorderedAccessView");
    }
    void STDMETHODCALLTYPE IASetIndexBuffer(const D3D12_INDEX_BUFFER_VIEW*) override {
        unexpected("IASetIndexBuffer");
    }
    void STDMETHODCALLTYPE IASetVertexBuffers(UINT, UINT, const D3D12_VERTEX_BUFFER_VIEW*) override {
        unexpected("IASetVertexBuffers");
    }
    void STDMETHODCALLTYPE SOSetTargets(UINT, UINT, const D3D12_STREAM_OUTPUT_BUFFER_VIEW*) override {
        unexpected("SOSetTargets");
    }
    void STDMETHODCALLTYPE OMSetRenderTargets(UINT, const D3D12_CPU_DESCRIPTOR_HANDLE*, BOOL,
                                              const D3D12_CPU_DESCRIPTOR_HANDLE*) override {
        unexpected("OMSetRenderTargets");
    }
    void STDMETHODCALLTYPE ClearDepthStencilView(D3D12_CPU_DESCRIPTOR_HANDLE, D3D12_CLEAR_FLAGS, FLOAT, UINT8,
                                                 UINT, const D3D12_RECT*) override {
        unexpected("ClearDepthStencilView");
    }
    void STDMETHODCALLTYPE ClearRenderTargetView(D3D12_CPU_DESCRIPTOR_HANDLE, const FLOAT*, UINT,
                                                 const D3D12_RECT*) override {
        unexpected("ClearRenderTargetView");
    }
    void STDMETHODCALLTYPE ClearUnorderedAccessViewUint(D3D12_GPU_DESCRIPTOR_HANDLE,
                                                        D3D12_CPU_DESCRIPTOR_HANDLE, ID3D12Resource*,
                                                        const UINT*, UINT, const D3D12_RECT*) override {
        unexpected("ClearUnorderedAccessViewUint");
    }
    void STDMETHODCALLTYPE ClearUnorderedAccessViewFloat(D3D12_GPU_DESCRIPTOR_HANDLE,
                                                         D3D12_CPU_DESCRIPTOR_HANDLE, ID3D12Resource*,
                                                         const FLOAT*, UINT, const D3D12_RECT*) override {
        unexpected("ClearUnorderedAccessViewFloat");
    }
    void STDMETHODCALLTYPE DiscardResource(ID3D12Resource*, const D3D12_DISCARD_REGION*) override {
        unexpected("DiscardResource");
    }
    void STDMETHODCALLTYPE BeginQuery(ID3D12QueryHeap*, D3D12_QUERY_TYPE, UINT) override {
        unexpected("BeginQuery");
    }
    void STDMETHODCALLTYPE EndQuery(ID3D12QueryHeap*, D3D12_QUERY_TYPE, UINT) override {
        unexpected("EndQuery");
    }
    void STDMETHODCALLTYPE ResolveQueryData(ID3D12QueryHeap*, D3D12_QUERY_TYPE, UINT, UINT, ID3D12Resource*,
                                            UINT64) override {
        unexpected("ResolveQueryData");
    }
    void STDMETHODCALLTYPE SetPredication(ID3D12Resource*, UINT64, D3D12_PREDICATION_OP) override {
        unexpected("SetPredication");
    }
    void STDMETHODCALLTYPE SetMarker(UINT, const void*, UINT) override { unexpected("SetMarker"); }
    void STDMETHODCALLTYPE BeginEvent(UINT, const void*, UINT) override { unexpected("BeginEvent"); }
    void STDMETHODCALLTYPE EndEvent() override { unexpected("EndEvent"); }
    void STDMETHODCALLTYPE ExecuteIndirect(ID3D12CommandSignature*, UINT, ID3D12Resource*, UINT64,
                                           ID3D12Resource*, UINT64) override {
        unexpected("ExecuteIndirect");
    }
    void STDMETHODCALLTYPE AtomicCopyBufferUINT(ID3D12Resource*, UINT64, ID3D12Resource*, UINT64, UINT,
                                                ID3D12Resource* const*,
                                                const D3D12_SUBRESOURCE_RANGE_UINT64*) override {
        unexpected("AtomicCopyBufferUINT");
    }
    void STDMETHODCALLTYPE AtomicCopyBufferUINT64(ID3D12Resource*, UINT64, ID3D12Resource*, UINT64, UINT,
                                                  ID3D12Resource* const*,
                                                  const D3D12_SUBRESOURCE_RANGE_UINT64*) override {
        unexpected("AtomicCopyBufferUINT64");
    }
    void STDMETHODCALLTYPE OMSetDepthBounds(FLOAT, FLOAT) override { unexpected("OMSetDepthBounds"); }
    void STDMETHODCALLTYPE SetSamplePositions(UINT, UINT, D3D12_SAMPLE_POSITION*) override {
        unexpected("SetSamplePositions");
    }
    void STDMETHODCALLTYPE ResolveSubresourceRegion(ID3D12Resource*, UINT, UINT, UINT, ID3D12Resource*, UINT,
                                                    D3D12_RECT*, DXGI_FORMAT, D3D12_RESOLVE_MODE) override {
        unexpected("ResolveSubresourceRegion");
    }
    void STDMETHODCALLTYPE SetViewInstanceMask(UINT) override { unexpected("SetViewInstanceMask"); }
    void STDMETHODCALLTYPE WriteBufferImmediate(UINT, const D3D12_WRITEBUFFERIMMEDIATE_PARAMETER*,
                                                const D3D12_WRITEBUFFERIMMEDIATE_MODE*) override {
        unexpected("WriteBufferImmediate");
    }
    void STDMETHODCALLTYPE SetProtectedResourceSession(ID3D12ProtectedResourceSession*) override {
        unexpected("SetProtectedResourceSession");
    }
    void STDMETHODCALLTYPE BeginRenderPass(UINT, const D3D12_RENDER_PASS_RENDER_TARGET_DESC*,
                                           const D3D12_RENDER_PASS_DEPTH_STENCIL_DESC*,
                                           D3D12_RENDER_PASS_FLAGS) override {
        unexpected("BeginRenderPass");
    }
    void STDMETHODCALLTYPE EndRenderPass() override { unexpected("EndRenderPass"); }
    void STDMETHODCALLTYPE InitializeMetaCommand(ID3D12MetaCommand*, const void*, SIZE_T) override {
        unexpected("InitializeMetaCommand");
    }
    void STDMETHODCALLTYPE ExecuteMetaCommand(ID3D12MetaCommand*, const void*, SIZE_T) override {
        unexpected("ExecuteMetaCommand");
    }
    void STDMETHODCALLTYPE EmitRaytracingAccelerationStructurePostbuildInfo(
        const D3D12_RAYTRACING_ACCELERATION_STRUCTURE_POSTBUILD_INFO_DESC*, UINT,
        const D3D12_GPU_VIRTUAL_ADDRESS*) override {
        unexpected("EmitRaytracingAccelerationStructurePostbuildInfo");
    }
    void STDMETHODCALLTYPE
    CopyRaytracingAccelerationStructure(D3D12_GPU_VIRTUAL_ADDRESS, D3D12_GPU_VIRTUAL_ADDRESS,
                                        D3D12_RAYTRACING_ACCELERATION_STRUCTURE_COPY_MODE) override {
        unexpected("CopyRaytracingAccelerationStructure");
    }
    void STDMETHODCALLTYPE SetPipelineState1(ID3D12StateObject*) override { unexpected("SetPipelineState1"); }
    void STDMETHODCALLTYPE DispatchRays(const D3D12_DISPATCH_RAYS_DESC*) override {
        unexpected("DispatchRays");
    }
};

} // namespace spa::test
