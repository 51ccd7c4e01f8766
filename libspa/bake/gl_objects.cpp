// SPDX-License-Identifier: Apache-2.0
#include "gl_objects.h"

#include "../core/error.h"

#include <algorithm>
#include <sstream>
#include <vector>

namespace spa::bake {
namespace {

std::string hexadecimal(GLenum value) {
    std::ostringstream text;
    text << "0x" << std::hex << value;
    return text.str();
}

GlObject compile(const GlFunctions& gl, GLenum stage, const std::string& source) {
    GlObject shader(gl, gl.CreateShader(stage),
                    [](const GlFunctions& table, GLuint name) { table.DeleteShader(name); });
    const GLchar* text = source.c_str();
    gl.ShaderSource(shader.name(), 1, &text, nullptr);
    gl.CompileShader(shader.name());
    GLint ok = GL_FALSE;
    gl.GetShaderiv(shader.name(), GL_COMPILE_STATUS, &ok);
    if (ok == GL_TRUE) return shader;
    std::vector<GLchar> log(4096);
    gl.GetShaderInfoLog(shader.name(), GLsizei(log.size()), nullptr, log.data());
    throw Error(ExitCode::internal, std::string("the orbit baker's ") +
                                        (stage == GL_VERTEX_SHADER ? "vertex" : "fragment") +
                                        " shader does not compile: " + log.data());
}

} // namespace

GlErrors::GlErrors(const GlFunctions& gl) : gl_(gl) {
    while (gl.GetError() != GL_NO_ERROR) {
    }
    gl.Enable(GL_DEBUG_OUTPUT);
    gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    gl.DebugMessageCallback(&GlErrors::receive, this);
}

GlErrors::~GlErrors() {
    gl_.DebugMessageCallback(nullptr, nullptr);
    gl_.Disable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    gl_.Disable(GL_DEBUG_OUTPUT);
}

void APIENTRY GlErrors::receive(GLenum /*source*/, GLenum type, GLuint /*id*/, GLenum /*severity*/,
                                GLsizei /*length*/, const GLchar* message, const void* user) {
    constexpr std::size_t longest = 4096; // a faulty draw repeats its message
    auto& messages = static_cast<GlErrors*>(const_cast<void*>(user))->messages_;
    if (type == GL_DEBUG_TYPE_ERROR && messages.size() < longest) messages += std::string(": ") + message;
}

void GlErrors::check(const char* where) {
    const GLenum error = gl_.GetError();
    if (error == GL_NO_ERROR && messages_.empty()) return;
    const std::string message =
        "OpenGL error " + hexadecimal(error) + " after " + where + std::exchange(messages_, {});
    throw Error(error == GL_OUT_OF_MEMORY ? ExitCode::unsupported : ExitCode::internal, message);
}

namespace {

GlObject make_storage(const GlFunctions& gl, std::size_t size, const void* content, GLbitfield flags) {
    GLuint name = 0;
    gl.CreateBuffers(1, &name);
    GlObject buffer(gl, name, [](const GlFunctions& table, GLuint old) { table.DeleteBuffers(1, &old); });
    gl.NamedBufferStorage(name, GLsizeiptr(size), content, flags);
    return buffer;
}

} // namespace

GlObject make_buffer(const GlFunctions& gl, std::span<const std::byte> content) {
    if (content.empty()) return make_dynamic_buffer(gl, 0);
    return make_storage(gl, content.size(), content.data(), 0);
}

GlObject make_dynamic_buffer(const GlFunctions& gl, std::size_t size) {
    return make_storage(gl, std::max<std::size_t>(size, 16), nullptr, GL_DYNAMIC_STORAGE_BIT);
}

GlObject make_texture(const GlFunctions& gl, GLenum format, GLsizei width, GLsizei height, GLsizei levels) {
    GLuint name = 0;
    gl.CreateTextures(GL_TEXTURE_2D, 1, &name);
    GlObject texture(gl, name, [](const GlFunctions& table, GLuint old) { table.DeleteTextures(1, &old); });
    gl.TextureStorage2D(name, levels, format, width, height);
    return texture;
}

GlObject make_sampler(const GlFunctions& gl) {
    GLuint name = 0;
    gl.CreateSamplers(1, &name);
    return {gl, name, [](const GlFunctions& table, GLuint old) { table.DeleteSamplers(1, &old); }};
}

GlObject make_vertex_array(const GlFunctions& gl) {
    GLuint name = 0;
    gl.CreateVertexArrays(1, &name);
    return {gl, name, [](const GlFunctions& table, GLuint old) { table.DeleteVertexArrays(1, &old); }};
}

GlObject make_framebuffer(const GlFunctions& gl, std::span<const GlObject* const> colors,
                          const GlObject& depth) {
    GLuint name = 0;
    gl.CreateFramebuffers(1, &name);
    GlObject framebuffer(gl, name,
                         [](const GlFunctions& table, GLuint old) { table.DeleteFramebuffers(1, &old); });
    gl.NamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth.name(), 0);
    std::vector<GLenum> attachments;
    for (const GlObject* color : colors) {
        attachments.push_back(GL_COLOR_ATTACHMENT0 + GLenum(attachments.size()));
        gl.NamedFramebufferTexture(name, attachments.back(), color->name(), 0);
    }
    if (attachments.empty()) attachments.push_back(GL_NONE);
    gl.NamedFramebufferDrawBuffers(name, GLsizei(attachments.size()), attachments.data());
    gl.NamedFramebufferReadBuffer(name, attachments.front());
    const GLenum status = gl.CheckNamedFramebufferStatus(name, GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        throw Error(ExitCode::internal,
                    "the orbit baker's framebuffer is not complete: " + hexadecimal(status));
    }
    return framebuffer;
}

GlObject make_program(const GlFunctions& gl, const std::string& vertex, const std::string& fragment) {
    const GlObject vertex_shader = compile(gl, GL_VERTEX_SHADER, vertex);
    const GlObject fragment_shader = compile(gl, GL_FRAGMENT_SHADER, fragment);
    GlObject program(gl, gl.CreateProgram(),
                     [](const GlFunctions& table, GLuint name) { table.DeleteProgram(name); });
    gl.AttachShader(program.name(), vertex_shader.name());
    gl.AttachShader(program.name(), fragment_shader.name());
    gl.LinkProgram(program.name());
    GLint ok = GL_FALSE;
    gl.GetProgramiv(program.name(), GL_LINK_STATUS, &ok);
    if (ok == GL_TRUE) return program;
    std::vector<GLchar> log(4096);
    gl.GetProgramInfoLog(program.name(), GLsizei(log.size()), nullptr, log.data());
    throw Error(ExitCode::internal, std::string("the orbit baker's shaders do not link: ") + log.data());
}

} // namespace spa::bake
