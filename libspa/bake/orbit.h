// SPDX-License-Identifier: Apache-2.0
// The orbit baker, the reference: a real camera for every sample, on the bounding sphere, aimed at the
// centre; the centre pixel is what is stored (the paper, section 2.4). Runs on OpenGL without a window.
#pragma once

#include "bake_options.h"
#include "crossings.h"

#include <memory>
#include <string>

namespace spa::bake {

struct GlFunctions; // gl_functions.h: the entry points of one context

// A headless OpenGL 4.5 core context, current on the thread that made it until it is destroyed. One at a time
// on a thread.
class GlContext {
public:
    virtual ~GlContext() = default;
    GlContext() = default;
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;
    // Such as "EGL surfaceless, llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa 22.3.6".
    [[nodiscard]] virtual std::string description() const = 0;
    [[nodiscard]] virtual const GlFunctions& functions() const = 0;
};

// automatic: EGL on a device (hardware first), EGL surfaceless, then OSMesa. Throws Error{unsupported} that
// lists what was tried and why each failed.
std::unique_ptr<GlContext> make_gl_context(GlApi api);

// Finds the crossings of every sample with one camera view a sample. naive: one draw call and one read-back
// a view, every triangle each time: the paper's way, for measuring; otherwise each view draws only triangles
// whose directions come near its axis, and views are drawn in batches into one-pixel tiles. Both give the
// same crossings. Call it on the thread on which `context` is current. Memory beyond the model: a fixed
// amount for the batch in flight (below 200 MB), the textures' copies, and the result. Throws
// Error{unsupported} when the context lacks what is needed, Error{internal} on an OpenGL error, and
// Cancelled. Source: ../../docs/baking.md, "Orbit".
CrossingGrid cast_orbit(const GlContext& context, const CenteredModel& model, const Grid& grid, bool naive,
                        const CastOptions& options);

} // namespace spa::bake
