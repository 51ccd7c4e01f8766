// SPDX-License-Identifier: Apache-2.0
#include "gl_functions.h"

#include "../core/error.h"

#include <string>

namespace spa::bake {

GlFunctions load_gl_functions(const GlLoader& loader) {
    GlFunctions gl;
    std::string missing;
    const auto load = [&]<class Function>(Function& function, const char* name) {
        function = reinterpret_cast<Function>(loader(name));
        if (!function) missing += missing.empty() ? name : std::string(", ") + name;
    };
    load(gl.AttachShader, "glAttachShader");
    load(gl.BindBufferBase, "glBindBufferBase");
    load(gl.BindFramebuffer, "glBindFramebuffer");
    load(gl.BindSampler, "glBindSampler");
    load(gl.BindTextureUnit, "glBindTextureUnit");
    load(gl.BindVertexArray, "glBindVertexArray");
    load(gl.CheckNamedFramebufferStatus, "glCheckNamedFramebufferStatus");
    load(gl.ClearNamedFramebufferfv, "glClearNamedFramebufferfv");
    load(gl.ClearNamedFramebufferuiv, "glClearNamedFramebufferuiv");
    load(gl.ClipControl, "glClipControl");
    load(gl.CompileShader, "glCompileShader");
    load(gl.CreateBuffers, "glCreateBuffers");
    load(gl.CreateFramebuffers, "glCreateFramebuffers");
    load(gl.CreateProgram, "glCreateProgram");
    load(gl.CreateSamplers, "glCreateSamplers");
    load(gl.CreateShader, "glCreateShader");
    load(gl.CreateTextures, "glCreateTextures");
    load(gl.CreateVertexArrays, "glCreateVertexArrays");
    load(gl.DebugMessageCallback, "glDebugMessageCallback");
    load(gl.DeleteBuffers, "glDeleteBuffers");
    load(gl.DeleteFramebuffers, "glDeleteFramebuffers");
    load(gl.DeleteProgram, "glDeleteProgram");
    load(gl.DeleteSamplers, "glDeleteSamplers");
    load(gl.DeleteShader, "glDeleteShader");
    load(gl.DeleteTextures, "glDeleteTextures");
    load(gl.DeleteVertexArrays, "glDeleteVertexArrays");
    load(gl.DepthFunc, "glDepthFunc");
    load(gl.Disable, "glDisable");
    load(gl.DrawArrays, "glDrawArrays");
    load(gl.Enable, "glEnable");
    load(gl.Finish, "glFinish");
    load(gl.GetError, "glGetError");
    load(gl.GetIntegerv, "glGetIntegerv");
    load(gl.GetProgramInfoLog, "glGetProgramInfoLog");
    load(gl.GetProgramiv, "glGetProgramiv");
    load(gl.GetShaderInfoLog, "glGetShaderInfoLog");
    load(gl.GetShaderiv, "glGetShaderiv");
    load(gl.GetString, "glGetString");
    load(gl.LinkProgram, "glLinkProgram");
    load(gl.NamedBufferStorage, "glNamedBufferStorage");
    load(gl.NamedBufferSubData, "glNamedBufferSubData");
    load(gl.NamedFramebufferDrawBuffers, "glNamedFramebufferDrawBuffers");
    load(gl.NamedFramebufferReadBuffer, "glNamedFramebufferReadBuffer");
    load(gl.NamedFramebufferTexture, "glNamedFramebufferTexture");
    load(gl.PixelStorei, "glPixelStorei");
    load(gl.ProgramUniform1ui, "glProgramUniform1ui");
    load(gl.ReadPixels, "glReadPixels");
    load(gl.SamplerParameteri, "glSamplerParameteri");
    load(gl.ShaderSource, "glShaderSource");
    load(gl.TextureStorage2D, "glTextureStorage2D");
    load(gl.TextureSubImage2D, "glTextureSubImage2D");
    load(gl.UseProgram, "glUseProgram");
    load(gl.Viewport, "glViewport");
    if (!missing.empty()) {
        throw Error(ExitCode::unsupported, "the OpenGL context lacks " + missing);
    }
    return gl;
}

} // namespace spa::bake
