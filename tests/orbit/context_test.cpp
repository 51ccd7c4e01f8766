// SPDX-License-Identifier: Apache-2.0
#include "fixture.h"

#include "../../libspa/bake/gl_functions.h"
#include "../../libspa/bake/gl_objects.h"

namespace spa::test {
namespace {

using bake::GlApi;

TEST(GlContext, SaysWhatItIs) {
    for (const auto& [api, word] : {std::pair{GlApi::egl, "EGL"}, std::pair{GlApi::osmesa, "OSMesa"}}) {
        const auto context = open_context(api);
        if (!context) continue;
        EXPECT_EQ(context->description().rfind(word, 0), 0U) << context->description();
        EXPECT_NE(context->description().find("OpenGL"), std::string::npos) << context->description();
    }
}

TEST(GlContext, AutomaticPrefersEgl) {
    if (!open_context(GlApi::egl)) GTEST_SKIP() << "no EGL here";
    EXPECT_EQ(open_context(GlApi::automatic)->description().rfind("EGL", 0), 0U);
}

// One after the other in one process, each with its own functions.
TEST(GlContext, EglAndOsmesaTakeTurns) {
    for (const GlApi api : {GlApi::egl, GlApi::osmesa, GlApi::egl, GlApi::osmesa}) {
        const auto context = open_context(api);
        if (!context) GTEST_SKIP() << "not both EGL and OSMesa are here";
        GLint major = 0;
        context->functions().GetIntegerv(GL_MAJOR_VERSION, &major);
        EXPECT_GE(major, 4);
    }
}

TEST(GlFunctions, MissingOnesAreNamed) {
    try {
        bake::load_gl_functions([](const char* name) {
            return std::string(name) == "glViewport" ? bake::GlProcedure(nullptr) : bake::GlProcedure([] {});
        });
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unsupported);
        EXPECT_STREQ(error.what(), "the OpenGL context lacks glViewport");
    }
}

class GlObjects : public OrbitTest {};

TEST_F(GlObjects, ErrorsOfOpenGlAreThrown) {
    const bake::GlFunctions& gl = context->functions();
    bake::GlErrors errors(gl);
    errors.check("nothing");
    gl.BindTextureUnit(0, 12345);
    EXPECT_THROW(errors.check("binding a texture that does not exist"), Error);
    errors.check("the error was taken");
}

TEST_F(GlObjects, ShaderLogIsInTheMessage) {
    const std::string good = "#version 450 core\nvoid main() { gl_Position = vec4(0.0); }\n";
    const std::string bad = "#version 450 core\nvoid main() { no_such_thing = 1; }\n";
    try {
        bake::make_program(context->functions(), good, bad);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::internal);
        EXPECT_NE(std::string(error.what()).find("no_such_thing"), std::string::npos) << error.what();
    }
}

TEST_F(GlObjects, IncompleteFramebufferIsRefused) {
    const bake::GlFunctions& gl = context->functions();
    const bake::GlObject depth = bake::make_texture(gl, GL_DEPTH_COMPONENT32F, 4, 4, 1);
    const bake::GlObject not_depth = bake::make_texture(gl, GL_RGBA8, 4, 4, 1);
    EXPECT_NO_THROW(bake::make_framebuffer(gl, {}, depth));
    EXPECT_THROW(bake::make_framebuffer(gl, {}, not_depth), Error);
}

} // namespace
} // namespace spa::test
