// SPDX-License-Identifier: Apache-2.0
#include "gl_context.h"

#include "../core/error.h"

namespace spa::bake {

std::string describe_renderer(const GlFunctions& gl) {
    const auto text = [&](GLenum what) {
        const GLubyte* value = gl.GetString(what);
        return value ? std::string(reinterpret_cast<const char*>(value)) : std::string("unknown");
    };
    return ", " + text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION);
}

std::unique_ptr<GlContext> make_gl_context(GlApi api) {
    std::vector<std::string> tried;
    std::unique_ptr<GlContext> context;
    if (api != GlApi::osmesa) context = make_egl_context(tried);
    if (!context && api != GlApi::egl) context = make_osmesa_context(tried);
    if (context) return context;
    std::string message = "no headless OpenGL 4.5 core context: ";
    for (const std::string& attempt : tried) message += (&attempt == tried.data() ? "" : "; ") + attempt;
    message += ". Install Mesa's software renderer (Debian: libegl1 libgl1-mesa-dri) or use the radial baker";
    throw Error(ExitCode::unsupported, message);
}

} // namespace spa::bake
