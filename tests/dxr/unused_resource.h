// SPDX-License-Identifier: Apache-2.0
// ID3D12Resource with the methods that the loader does not call.
#pragma once

#include "unexpected.h"

namespace spa::test {

class UnusedResource : public ID3D12Resource {
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
    D3D12_RESOURCE_DESC STDMETHODCALLTYPE GetDesc() override { unexpected("GetDesc"); }
    HRESULT STDMETHODCALLTYPE WriteToSubresource(UINT, const D3D12_BOX*, const void*, UINT, UINT) override {
        unexpected("WriteToSubresource");
    }
    HRESULT STDMETHODCALLTYPE ReadFromSubresource(void*, UINT, UINT, UINT, const D3D12_BOX*) override {
        unexpected("ReadFromSubresource");
    }
    HRESULT STDMETHODCALLTYPE GetHeapProperties(D3D12_HEAP_PROPERTIES*, D3D12_HEAP_FLAGS*) override {
        unexpected("GetHeapProperties");
    }
};

} // namespace spa::test
