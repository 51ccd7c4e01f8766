// SPDX-License-Identifier: Apache-2.0
// The OpenGL 4.5 entry points that the orbit baker calls, as a plain table loaded from one context. A process
// can hold EGL and OSMesa at once, whose functions of the same name differ, so nothing may bind to the
// symbols of a library.
#pragma once

#include <GL/glcorearb.h>

#include <functional>

namespace spa::bake {

// Members are named as in the specification, without the prefix "gl".
struct GlFunctions {
    PFNGLATTACHSHADERPROC AttachShader{};
    PFNGLBINDBUFFERBASEPROC BindBufferBase{};
    PFNGLBINDFRAMEBUFFERPROC BindFramebuffer{};
    PFNGLBINDSAMPLERPROC BindSampler{};
    PFNGLBINDTEXTUREUNITPROC BindTextureUnit{};
    PFNGLBINDVERTEXARRAYPROC BindVertexArray{};
    PFNGLCHECKNAMEDFRAMEBUFFERSTATUSPROC CheckNamedFramebufferStatus{};
    PFNGLCLEARNAMEDFRAMEBUFFERFVPROC ClearNamedFramebufferfv{};
    PFNGLCLEARNAMEDFRAMEBUFFERUIVPROC ClearNamedFramebufferuiv{};
    PFNGLCLIPCONTROLPROC ClipControl{};
    PFNGLCOMPILESHADERPROC CompileShader{};
    PFNGLCREATEBUFFERSPROC CreateBuffers{};
    PFNGLCREATEFRAMEBUFFERSPROC CreateFramebuffers{};
    PFNGLCREATEPROGRAMPROC CreateProgram{};
    PFNGLCREATESAMPLERSPROC CreateSamplers{};
    PFNGLCREATESHADERPROC CreateShader{};
    PFNGLCREATETEXTURESPROC CreateTextures{};
    PFNGLCREATEVERTEXARRAYSPROC CreateVertexArrays{};
    PFNGLDEBUGMESSAGECALLBACKPROC DebugMessageCallback{};
    PFNGLDELETEBUFFERSPROC DeleteBuffers{};
    PFNGLDELETEFRAMEBUFFERSPROC DeleteFramebuffers{};
    PFNGLDELETEPROGRAMPROC DeleteProgram{};
    PFNGLDELETESAMPLERSPROC DeleteSamplers{};
    PFNGLDELETESHADERPROC DeleteShader{};
    PFNGLDELETETEXTURESPROC DeleteTextures{};
    PFNGLDELETEVERTEXARRAYSPROC DeleteVertexArrays{};
    PFNGLDEPTHFUNCPROC DepthFunc{};
    PFNGLDISABLEPROC Disable{};
    PFNGLDRAWARRAYSPROC DrawArrays{};
    PFNGLENABLEPROC Enable{};
    PFNGLFINISHPROC Finish{};
    PFNGLGETERRORPROC GetError{};
    PFNGLGETINTEGERVPROC GetIntegerv{};
    PFNGLGETPROGRAMINFOLOGPROC GetProgramInfoLog{};
    PFNGLGETPROGRAMIVPROC GetProgramiv{};
    PFNGLGETSHADERINFOLOGPROC GetShaderInfoLog{};
    PFNGLGETSHADERIVPROC GetShaderiv{};
    PFNGLGETSTRINGPROC GetString{};
    PFNGLLINKPROGRAMPROC LinkProgram{};
    PFNGLNAMEDBUFFERSTORAGEPROC NamedBufferStorage{};
    PFNGLNAMEDBUFFERSUBDATAPROC NamedBufferSubData{};
    PFNGLNAMEDFRAMEBUFFERDRAWBUFFERSPROC NamedFramebufferDrawBuffers{};
    PFNGLNAMEDFRAMEBUFFERREADBUFFERPROC NamedFramebufferReadBuffer{};
    PFNGLNAMEDFRAMEBUFFERTEXTUREPROC NamedFramebufferTexture{};
    PFNGLPIXELSTOREIPROC PixelStorei{};
    PFNGLPROGRAMUNIFORM1UIPROC ProgramUniform1ui{};
    PFNGLREADPIXELSPROC ReadPixels{};
    PFNGLSAMPLERPARAMETERIPROC SamplerParameteri{};
    PFNGLSHADERSOURCEPROC ShaderSource{};
    PFNGLTEXTURESTORAGE2DPROC TextureStorage2D{};
    PFNGLTEXTURESUBIMAGE2DPROC TextureSubImage2D{};
    PFNGLUSEPROGRAMPROC UseProgram{};
    PFNGLVIEWPORTPROC Viewport{};
};

using GlProcedure = void (*)();
using GlLoader = std::function<GlProcedure(const char* name)>;

// Throws Error{unsupported} that names the functions the context lacks.
GlFunctions load_gl_functions(const GlLoader& loader);

} // namespace spa::bake
