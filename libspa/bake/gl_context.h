// SPDX-License-Identifier: Apache-2.0
// Internal: the ways to a context that make_gl_context tries.
#pragma once

#include "gl_functions.h"
#include "orbit.h"

#include <string>
#include <vector>

namespace spa::bake {

// The context of the first EGL platform that gives OpenGL 4.5 core: hardware devices, surfaceless, software
// devices. Null if none does; then `tried` has a sentence for each.
std::unique_ptr<GlContext> make_egl_context(std::vector<std::string>& tried);

// The same for OSMesa; a build without OSMesa says so in `tried`.
std::unique_ptr<GlContext> make_osmesa_context(std::vector<std::string>& tried);

// ", GL_RENDERER, OpenGL GL_VERSION".
std::string describe_renderer(const GlFunctions& gl);

} // namespace spa::bake
