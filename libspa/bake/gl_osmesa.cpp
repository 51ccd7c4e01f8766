// SPDX-License-Identifier: Apache-2.0
#include "gl_context.h"

#ifdef SPA_HAVE_OSMESA

#include "../core/error.h"

#include <GL/osmesa.h>
#include <dlfcn.h>

#include <array>
#include <memory>

namespace spa::bake {
namespace {

// The library, loaded when it is asked for: it brings a compiler (LLVM) along, which would cost every start
// of every program that can bake some ten milliseconds.
class OsmesaLibrary {
public:
    // Throws Error{unsupported} whose message is the reason alone.
    OsmesaLibrary() : handle_(dlopen(SPA_OSMESA_SONAME, RTLD_NOW | RTLD_LOCAL)) {
        if (!handle_) throw Error(ExitCode::unsupported, dlerror());
        load(create, "OSMesaCreateContextAttribs");
        load(make_current, "OSMesaMakeCurrent");
        load(destroy, "OSMesaDestroyContext");
        load(procedure, "OSMesaGetProcAddress");
    }

    decltype(&OSMesaCreateContextAttribs) create = nullptr;
    decltype(&OSMesaMakeCurrent) make_current = nullptr;
    decltype(&OSMesaDestroyContext) destroy = nullptr;
    decltype(&OSMesaGetProcAddress) procedure = nullptr;

private:
    template <class Function>
    void load(Function& function, const char* name) {
        function = reinterpret_cast<Function>(dlsym(handle_.get(), name));
        if (function == nullptr)
            throw Error(ExitCode::unsupported, std::string(SPA_OSMESA_SONAME " lacks ") + name);
    }

    struct Close {
        void operator()(void* handle) const { dlclose(handle); }
    };
    std::unique_ptr<void, Close> handle_;
};

class OsmesaContext final : public GlContext {
public:
    // Throws Error{unsupported} whose message is the reason alone.
    OsmesaContext() {
        constexpr std::array<int, 9> attributes{OSMESA_FORMAT,
                                                OSMESA_RGBA,
                                                OSMESA_PROFILE,
                                                OSMESA_CORE_PROFILE,
                                                OSMESA_CONTEXT_MAJOR_VERSION,
                                                4,
                                                OSMESA_CONTEXT_MINOR_VERSION,
                                                5,
                                                0};
        context_ = library_.create(attributes.data(), nullptr);
        if (!context_)
            throw Error(ExitCode::unsupported, "OSMesaCreateContextAttribs (OpenGL 4.5 core) failed");
        try {
            if (!library_.make_current(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1)) {
                throw Error(ExitCode::unsupported, "OSMesaMakeCurrent failed");
            }
            gl_ =
                load_gl_functions([this](const char* name) { return GlProcedure(library_.procedure(name)); });
        } catch (...) {
            close();
            throw;
        }
    }
    ~OsmesaContext() override { close(); }

    [[nodiscard]] std::string description() const override { return "OSMesa" + describe_renderer(gl_); }
    [[nodiscard]] const GlFunctions& functions() const override { return gl_; }

private:
    void close() {
        library_.make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
        library_.destroy(context_);
    }

    OsmesaLibrary library_;
    OSMesaContext context_ = nullptr;
    std::array<unsigned char, 4> pixel_{}; // the window that OSMesa insists on
    GlFunctions gl_;
};

} // namespace

std::unique_ptr<GlContext> make_osmesa_context(std::vector<std::string>& tried) {
    try {
        return std::make_unique<OsmesaContext>();
    } catch (const Error& error) {
        tried.push_back(std::string("OSMesa: ") + error.what());
        return nullptr;
    }
}

} // namespace spa::bake

#else

namespace spa::bake {

std::unique_ptr<GlContext> make_osmesa_context(std::vector<std::string>& tried) {
    tried.emplace_back("OSMesa: not part of this build");
    return nullptr;
}

} // namespace spa::bake

#endif
