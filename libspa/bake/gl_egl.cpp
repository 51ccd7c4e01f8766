// SPDX-License-Identifier: Apache-2.0
#include "gl_context.h"

#include "../core/error.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <array>
#include <sstream>

namespace spa::bake {
namespace {

struct Platform {
    std::string name;
    EGLenum kind = 0;
    void* native = nullptr;
    bool software = false;
};

bool has_extension(const char* list, const char* name) {
    std::istringstream words(list ? list : "");
    std::string word;
    while (words >> word) {
        if (word == name) return true;
    }
    return false;
}

template <class Function>
Function egl_function(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

std::vector<Platform> list_platforms() {
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    std::vector<Platform> platforms;
    const auto query_devices = egl_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    const auto query_string = egl_function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    if (has_extension(client, "EGL_EXT_platform_device") && query_devices && query_string) {
        std::array<EGLDeviceEXT, 32> devices{};
        EGLint count = 0;
        if (!query_devices(EGLint(devices.size()), devices.data(), &count)) count = 0;
        for (std::size_t i = 0; i < std::size_t(count); ++i) {
            const bool software =
                has_extension(query_string(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software");
            platforms.push_back({"EGL device " + std::to_string(i) + (software ? " (software)" : ""),
                                 EGL_PLATFORM_DEVICE_EXT, devices[i], software});
        }
    }
    if (has_extension(client, "EGL_MESA_platform_surfaceless")) {
        platforms.push_back({"EGL surfaceless", EGL_PLATFORM_SURFACELESS_MESA, nullptr, true});
    }
    // The display of a software device is the slowest to fail where a driver is half installed: it comes
    // last.
    const auto rank = [](const Platform& p) {
        return p.kind != EGL_PLATFORM_DEVICE_EXT ? 1 : p.software ? 2 : 0;
    };
    std::stable_sort(platforms.begin(), platforms.end(),
                     [&](const Platform& a, const Platform& b) { return rank(a) < rank(b); });
    return platforms;
}

std::string last_error(const char* call) {
    std::ostringstream text;
    text << call << " failed with 0x" << std::hex << eglGetError();
    return text.str();
}

class EglContext final : public GlContext {
public:
    // Throws Error{unsupported} whose message is the reason alone.
    explicit EglContext(const Platform& platform) : name_(platform.name) {
        try {
            open(platform);
        } catch (...) {
            close();
            throw;
        }
    }
    ~EglContext() override { close(); }

    [[nodiscard]] std::string description() const override { return name_ + describe_renderer(gl_); }
    [[nodiscard]] const GlFunctions& functions() const override { return gl_; }

private:
    static void require(bool ok, const std::string& reason) {
        if (!ok) throw Error(ExitCode::unsupported, reason);
    }

    void open(const Platform& platform) {
        const auto get_display = egl_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
        require(get_display != nullptr, "eglGetPlatformDisplayEXT is missing");
        display_ = get_display(platform.kind, platform.native, nullptr);
        require(display_ != EGL_NO_DISPLAY, last_error("eglGetPlatformDisplayEXT"));
        require(eglInitialize(display_, nullptr, nullptr) == EGL_TRUE, last_error("eglInitialize"));
        initialized_ = true;
        const char* extensions = eglQueryString(display_, EGL_EXTENSIONS);
        for (const char* name :
             {"EGL_KHR_create_context", "EGL_KHR_no_config_context", "EGL_KHR_surfaceless_context"}) {
            require(has_extension(extensions, name), std::string(name) + " is missing");
        }
        require(eglBindAPI(EGL_OPENGL_API) == EGL_TRUE, last_error("eglBindAPI(EGL_OPENGL_API)"));
        constexpr std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                                   4,
                                                   EGL_CONTEXT_MINOR_VERSION,
                                                   5,
                                                   EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                   EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                   EGL_NONE};
        context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
        require(context_ != EGL_NO_CONTEXT, last_error("eglCreateContext (OpenGL 4.5 core)"));
        require(eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE,
                last_error("eglMakeCurrent"));
        gl_ = load_gl_functions([](const char* name) { return GlProcedure(eglGetProcAddress(name)); });
    }

    void close() {
        if (!initialized_) return;
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
        eglTerminate(display_);
        eglReleaseThread();
    }

    std::string name_;
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
    bool initialized_ = false;
    GlFunctions gl_;
};

} // namespace

std::unique_ptr<GlContext> make_egl_context(std::vector<std::string>& tried) {
    const std::vector<Platform> platforms = list_platforms();
    for (const Platform& platform : platforms) {
        try {
            return std::make_unique<EglContext>(platform);
        } catch (const Error& error) {
            tried.push_back(platform.name + ": " + error.what());
        }
    }
    if (platforms.empty()) tried.emplace_back("EGL: neither the device nor the surfaceless platform exists");
    return nullptr;
}

} // namespace spa::bake
