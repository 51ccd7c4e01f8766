// SPDX-License-Identifier: Apache-2.0
// OpenGL objects that delete themselves, made by direct state access, and the watch over OpenGL errors.
#pragma once

#include "gl_functions.h"

#include <cstddef>
#include <span>
#include <string>
#include <utility>

namespace spa::bake {

// Collects the error messages of KHR_debug while it lives.
class GlErrors {
public:
    explicit GlErrors(const GlFunctions& gl);
    ~GlErrors();
    GlErrors(const GlErrors&) = delete;
    GlErrors& operator=(const GlErrors&) = delete;

    // Throws Error if OpenGL has reported an error since the last call: unsupported when memory ran out,
    // internal otherwise. `where` says after what.
    void check(const char* where);

private:
    static void APIENTRY receive(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                 const GLchar* message, const void* user);

    const GlFunctions& gl_;
    std::string messages_;
};

// One name of OpenGL and how to delete it. Movable; the context must outlive it.
class GlObject {
public:
    using Delete = void (*)(const GlFunctions& gl, GLuint name);

    GlObject() = default;
    GlObject(const GlFunctions& gl, GLuint name, Delete destroy) : gl_(&gl), name_(name), destroy_(destroy) {}
    GlObject(GlObject&& other) noexcept
        : gl_(other.gl_), name_(std::exchange(other.name_, 0)), destroy_(other.destroy_) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(gl_, other.gl_);
        std::swap(name_, other.name_);
        std::swap(destroy_, other.destroy_);
        return *this;
    }
    ~GlObject() {
        if (name_ != 0) destroy_(*gl_, name_);
    }

    [[nodiscard]] GLuint name() const { return name_; }

private:
    const GlFunctions* gl_ = nullptr;
    GLuint name_ = 0;
    Delete destroy_ = nullptr;
};

// A buffer of a fixed size; flags as of glNamedBufferStorage. Zero bytes become a few, so that it can be
// bound.
GlObject make_buffer(const GlFunctions& gl, std::span<const std::byte> content);
GlObject make_dynamic_buffer(const GlFunctions& gl, std::size_t size);

// A 2D texture without content.
GlObject make_texture(const GlFunctions& gl, GLenum format, GLsizei width, GLsizei height, GLsizei levels);
GlObject make_sampler(const GlFunctions& gl);
GlObject make_vertex_array(const GlFunctions& gl);

// colors may be empty. Throws Error{internal} if the framebuffer is not complete.
GlObject make_framebuffer(const GlFunctions& gl, std::span<const GlObject* const> colors,
                          const GlObject& depth);

// Throws Error{internal} with the compiler's log if the program does not build.
GlObject make_program(const GlFunctions& gl, const std::string& vertex, const std::string& fragment);

} // namespace spa::bake
