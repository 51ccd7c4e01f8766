// SPDX-License-Identifier: Apache-2.0
#include "gl_context.h"

#ifdef SPA_HAVE_OSMESA

#include "../core/error.h"

#include <GL/osmesa.h>

#include <array>

namespace spa::bake {
namespace {

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
        context_ = OSMesaCreateContextAttribs(attributes.data(), nullptr);
        if (!context_)
            throw Error(ExitCode::unsupported, "OSMesaCreateContextAttribs (OpenGL 4.5 core) failed");
        try {
            if (!OSMesaMakeCurrent(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1)) {
                throw Error(ExitCode::unsupported, "OSMesaMakeCurrent failed");
            }
            gl_ = load_gl_functions([](const char* name) { return GlProcedure(OSMesaGetProcAddress(name)); });
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
        OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
        OSMesaDestroyContext(context_);
    }

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
