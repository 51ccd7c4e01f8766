// SPDX-License-Identifier: Apache-2.0
// The orbit baker, the reference: a real camera for every sample, on the bounding sphere, aimed at the
// centre; the centre pixel is what is stored (the paper, section 2.4). Runs on OpenGL without a window.
#pragma once

#include "bake_options.h"
#include "crossings.h"

#include <memory>
#include <string>

namespace spa::bake {

// A headless OpenGL 4.5 core context, current on the thread that made it until it is destroyed.
class GlContext {
public:
    virtual ~GlContext() = default;
    GlContext() = default;
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;
    // Such as "EGL surfaceless, llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5".
    [[nodiscard]] virtual std::string description() const = 0;
};

// automatic: EGL on a device (hardware first), EGL surfaceless, then OSMesa. Throws Error{unsupported} that
// lists what was tried and why each failed.
std::unique_ptr<GlContext> make_gl_context(GlApi api);

// Finds the crossings of every sample with one camera view a sample. naive: one draw call and one read-back
// a view, every triangle each time: the paper's way, for measuring; otherwise culled clusters of triangles are
// drawn in instanced batches into one-pixel tiles. Needs a current context.
// Source: ../../docs/baking.md, "Orbit".
CrossingGrid cast_orbit(const CenteredModel& model, const Grid& grid, bool naive, const CastOptions& options);

} // namespace spa::bake
