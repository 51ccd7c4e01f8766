// SPDX-License-Identifier: Apache-2.0
// A command line for dxcompiler.dll, for Windows and Wine: tools/check_hlsl.sh builds it with mingw-w64.
//
//   dxc_driver OUTPUT SOURCE [DXC_OPTION...]
//   dxc_driver --version
//
// Messages go to stderr. Exit codes: 0, 1 if the source has errors, 2 if anything else fails. The few
// interfaces of dxcapi.h that it needs stand below, since no Debian package has that header.
#include <windows.h>

#include <unknwn.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

constexpr GUID compiler_class = {
    0x73e22d93, 0xe6ce, 0x47f3, {0xb5, 0xbf, 0xf0, 0x66, 0x4f, 0x39, 0xc1, 0xb0}};
constexpr GUID library_class = {0x6245d6af, 0x66e0, 0x48fd, {0x80, 0xb4, 0x4d, 0x27, 0x17, 0x96, 0x74, 0x8c}};
constexpr GUID compiler3_id = {0x228b4687, 0x5a6a, 0x4730, {0x90, 0x0c, 0x97, 0x02, 0xb2, 0x20, 0x3f, 0x54}};
constexpr GUID utils_id = {0x4605c4cb, 0x2019, 0x492a, {0xad, 0xa4, 0x65, 0xf2, 0x0b, 0xb7, 0xd6, 0x7f}};
constexpr GUID result_id = {0x58346cda, 0xdde7, 0x4497, {0x94, 0x61, 0x6f, 0x87, 0xaf, 0x5e, 0x06, 0x59}};
constexpr GUID version_id = {0xb04f5b50, 0x2059, 0x4f12, {0xa8, 0xff, 0xa1, 0xe0, 0xcd, 0xe1, 0xcc, 0x7e}};

struct DxcBuffer {
    const void* bytes;
    SIZE_T size;
    UINT encoding;
};

struct IDxcBlob : IUnknown {
    virtual void* STDMETHODCALLTYPE GetBufferPointer() = 0;
    virtual SIZE_T STDMETHODCALLTYPE GetBufferSize() = 0;
};

struct IDxcResult : IUnknown {
    virtual HRESULT STDMETHODCALLTYPE GetStatus(HRESULT* status) = 0;
    virtual HRESULT STDMETHODCALLTYPE GetResult(IDxcBlob** result) = 0;
    virtual HRESULT STDMETHODCALLTYPE GetErrorBuffer(IDxcBlob** errors) = 0;
};

struct IDxcCompiler3 : IUnknown {
    virtual HRESULT STDMETHODCALLTYPE Compile(const DxcBuffer* source, LPCWSTR* arguments, UINT32 count,
                                              IUnknown* include_handler, REFIID id, void** result) = 0;
};

struct IDxcUtils : IUnknown {
    // Not called; they hold the places of the six before the one that is.
    virtual HRESULT STDMETHODCALLTYPE CreateBlobFromBlob() = 0;
    virtual HRESULT STDMETHODCALLTYPE CreateBlobFromPinned() = 0;
    virtual HRESULT STDMETHODCALLTYPE MoveToBlob() = 0;
    virtual HRESULT STDMETHODCALLTYPE CreateBlob() = 0;
    virtual HRESULT STDMETHODCALLTYPE LoadFile() = 0;
    virtual HRESULT STDMETHODCALLTYPE CreateReadOnlyStreamFromBlob() = 0;
    virtual HRESULT STDMETHODCALLTYPE CreateDefaultIncludeHandler(IUnknown** handler) = 0;
};

struct IDxcVersionInfo : IUnknown {
    virtual HRESULT STDMETHODCALLTYPE GetVersion(UINT32* major, UINT32* minor) = 0;
};

using CreateInstance = HRESULT(WINAPI*)(REFCLSID, REFIID, void**);

int fail(const char* what) {
    std::fprintf(stderr, "dxc_driver: %s\n", what);
    return 2;
}

int print_version(CreateInstance create) {
    IDxcVersionInfo* info = nullptr;
    UINT32 major = 0;
    UINT32 minor = 0;
    if (FAILED(create(compiler_class, version_id, reinterpret_cast<void**>(&info))) ||
        FAILED(info->GetVersion(&major, &minor)))
        return fail("dxcompiler.dll does not tell its version");
    std::printf("%u.%u\n", major, minor);
    return 0;
}

// Objects live as long as the process.
int compile(CreateInstance create, const std::wstring& output, std::vector<LPCWSTR>& arguments) {
    std::ifstream file(arguments.front(), std::ios::binary);
    const std::string source{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (!file.is_open()) return fail("the source cannot be read");
    constexpr UINT utf8 = 65001;
    const DxcBuffer buffer{source.data(), source.size(), utf8};

    IDxcUtils* utils = nullptr;
    IUnknown* includes = nullptr;
    IDxcCompiler3* compiler = nullptr;
    IDxcResult* result = nullptr;
    if (FAILED(create(library_class, utils_id, reinterpret_cast<void**>(&utils))) ||
        FAILED(utils->CreateDefaultIncludeHandler(&includes)) ||
        FAILED(create(compiler_class, compiler3_id, reinterpret_cast<void**>(&compiler))) ||
        FAILED(compiler->Compile(&buffer, arguments.data(), UINT32(arguments.size()), includes, result_id,
                                 reinterpret_cast<void**>(&result))))
        return fail("dxcompiler.dll refuses to work");

    IDxcBlob* messages = nullptr;
    if (SUCCEEDED(result->GetErrorBuffer(&messages)) && messages != nullptr && messages->GetBufferSize() > 1)
        std::fprintf(stderr, "%.*s", int(messages->GetBufferSize()),
                     static_cast<const char*>(messages->GetBufferPointer()));
    HRESULT status = E_FAIL;
    if (FAILED(result->GetStatus(&status)) || FAILED(status)) return 1;
    IDxcBlob* object = nullptr;
    if (FAILED(result->GetResult(&object)) || object == nullptr) return fail("there is no output");
    std::ofstream out(output.c_str(), std::ios::binary);
    out.write(static_cast<const char*>(object->GetBufferPointer()), std::streamsize(object->GetBufferSize()));
    out.close();
    return out.good() ? 0 : fail("the output cannot be written");
}

} // namespace

int wmain(int count, wchar_t** arguments) {
    const HMODULE library = LoadLibraryW(L"dxcompiler.dll");
    if (library == nullptr) return fail("there is no dxcompiler.dll beside it");
    const auto create = reinterpret_cast<CreateInstance>(
        reinterpret_cast<void*>(GetProcAddress(library, "DxcCreateInstance")));
    if (create == nullptr) return fail("dxcompiler.dll is not one");
    if (count == 2 && std::wstring(arguments[1]) == L"--version") return print_version(create);
    if (count < 3) return fail("say: dxc_driver OUTPUT SOURCE [OPTION...]");
    std::vector<LPCWSTR> rest(arguments + 2, arguments + count);
    return compile(create, arguments[1], rest);
}
