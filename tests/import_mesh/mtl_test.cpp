// SPDX-License-Identifier: Apache-2.0
#include "scratch.h"

#include "../../libspa/core/error.h"

#include <gtest/gtest.h>

namespace spa::test {
namespace {

using Pixels = std::vector<std::array<std::uint8_t, 4>>;
const Pixels red{{255, 0, 0, 255}};

const std::string face = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n";

// A triangle with material m of the library `mtl`.
import::Result read_with(const Scratch& scratch, const std::string& mtl){scratch.write("a.mtl", mtl);
return scratch.read("t.obj", "mtllib a.mtl\n" + face + "usemtl m\nf 1/1 2/2 3/3\n");
} // namespace

const Material& material_of(const import::Result& result) {
    expect_valid(result);
    return result.model.materials[result.model.triangle_materials[0]];
}

TEST(Mtl, DiffuseIsADisplayValueAndWhiteByDefault) {
    const Scratch scratch;
    const auto result = read_with(scratch, "newmtl other\nKd 1 1 1\nnewmtl m\nKd 1 0.5 0\n");
    const Material& m = material_of(result);
    EXPECT_EQ(m.name, "m");
    EXPECT_FLOAT_EQ(m.base_color.x, 1);
    EXPECT_NEAR(m.base_color.y, 0.21404, 1e-5);
    EXPECT_FLOAT_EQ(m.base_color.z, 0);
    EXPECT_EQ(m.alpha_mode, AlphaMode::opaque);
    EXPECT_EQ(result.model.materials.size(), 1U); // only those in use
    EXPECT_EQ(material_of(read_with(scratch, "newmtl m\n")).base_color, (Vec4f{1, 1, 1, 1}));
    EXPECT_NEAR(material_of(read_with(scratch, "newmtl m\nKd 0.5\n")).base_color.z, 0.21404, 1e-5);
    const auto bad = read_with(scratch, "newmtl m\nKd 1 x 0\n");
    EXPECT_EQ(material_of(bad).base_color, (Vec4f{1, 1, 1, 1}));
    EXPECT_TRUE(has_warning(bad.report, "a.mtl line 2: 'x' is not a number"));
}

TEST(Mtl, Opacity) {
    const Scratch scratch;
    const auto alpha = [&](const std::string& statements) {
        const auto result = read_with(scratch, "newmtl m\n" + statements);
        const Material& m = material_of(result);
        EXPECT_EQ(m.alpha_mode, m.base_color.w < 1 ? AlphaMode::blend : AlphaMode::opaque);
        return m.base_color.w;
    };
    EXPECT_FLOAT_EQ(alpha("d 0.25\n"), 0.25F);
    EXPECT_FLOAT_EQ(alpha("d -halo 0.25\n"), 0.25F);
    EXPECT_FLOAT_EQ(alpha("Tr 0.25\n"), 0.75F);
    EXPECT_FLOAT_EQ(alpha("Tr 0.25\nd 0.5\n"), 0.5F);
    EXPECT_FLOAT_EQ(alpha("d 1\nTr 1\n"), 1);
    EXPECT_FLOAT_EQ(alpha("Tr 1\n"), 1); // an opacity under the wrong name
    EXPECT_FLOAT_EQ(alpha("d 7\n"), 1);
    EXPECT_FLOAT_EQ(alpha("d 0\n"), 0);
    EXPECT_TRUE(has_warning(read_with(scratch, "newmtl m\nd 0\n").report, "fully transparent"));
}

TEST(Mtl, TextureWithOptionsAndBlanksInItsName) {
    const Scratch scratch;
    scratch.write_tga("sub/my tex.tga", 1, red);
    const auto result = read_with(
        scratch,
        "newmtl m\nKd 0 0 0\nmap_Kd -blendu on -s 2 3 1 -o 0.5 -clamp on -mm 0 1 sub\\my tex.tga \r\n");
    const Material& m = material_of(result);
    ASSERT_EQ(result.model.textures.size(), 1U);
    EXPECT_EQ(m.texture, 0U);
    EXPECT_EQ(m.base_color, (Vec4f{1, 1, 1, 1})); // black beside a texture counts as white
    EXPECT_EQ(m.wrap_u, Wrap::clamp_to_edge);
    EXPECT_EQ(result.model.textures[0].mips[0].pixels[0], red[0]);
    EXPECT_EQ(result.report.files.back().name, "sub/my tex.tga");
    const auto& v = result.model.triangles[0].vertex;
    EXPECT_EQ(result.model.uvs[v[0]], (Vec2f{0.5F, 1})); // 0 * 2 + 0.5, 1 - 0 * 3
    EXPECT_EQ(result.model.uvs[v[1]], (Vec2f{2.5F, 1}));
    EXPECT_EQ(result.model.uvs[v[2]], (Vec2f{0.5F, -2}));
}

TEST(Mtl, KdMultipliesTheTexture) {
    const Scratch scratch;
    scratch.write_tga("t.tga", 1, red);
    const auto result = read_with(scratch, "newmtl m\nKd 0.5 1 1\nmap_Kd t.tga\n");
    EXPECT_NEAR(material_of(result).base_color.x, 0.21404, 1e-5);
}

TEST(Mtl, AlphaOfTheTextureBlends) {
    const Scratch scratch;
    scratch.write_tga("t.tga", 1, {{255, 0, 0, 128}});
    EXPECT_EQ(material_of(read_with(scratch, "newmtl m\nmap_Kd t.tga\n")).alpha_mode, AlphaMode::blend);
    scratch.write_tga("t.tga", 1, red);
    EXPECT_EQ(material_of(read_with(scratch, "newmtl m\nmap_Kd t.tga\n")).alpha_mode, AlphaMode::opaque);
}

TEST(Mtl, DissolveMapBecomesAlpha) {
    const Scratch scratch;
    scratch.write_tga("color.tga", 1, {{10, 20, 30, 255}, {40, 50, 60, 255}});
    scratch.write_tga("luma.tga", 2, {{0, 0, 0, 255}, {200, 200, 200, 255}});
    scratch.write_tga("alpha.tga", 1, {{9, 9, 9, 77}});
    const auto both = read_with(scratch, "newmtl m\nd 0\nmap_Kd color.tga\nmap_d luma.tga\n");
    EXPECT_EQ(material_of(both).alpha_mode, AlphaMode::blend);
    EXPECT_EQ(material_of(both).base_color.w, 1);
    const Image& image = both.model.textures[0].mips[0];
    ASSERT_EQ(image.width, 2U);
    ASSERT_EQ(image.height, 2U);
    const Pixels expected{{10, 20, 30, 0}, {10, 20, 30, 200}, {40, 50, 60, 0}, {40, 50, 60, 200}};
    EXPECT_EQ(image.pixels, expected);
    EXPECT_EQ(both.model.textures[0].mips.back().pixels.size(), 1U);
    const auto alone = read_with(scratch, "newmtl m\nKd 0 1 0\nmap_d alpha.tga\n");
    EXPECT_EQ(alone.model.textures[0].mips[0].pixels, (Pixels{{255, 255, 255, 77}}));
    EXPECT_EQ(material_of(alone).base_color, (Vec4f{0, 1, 0, 1}));
}

TEST(Mtl, SameMapsShareATexture) {
    const Scratch scratch;
    scratch.write_tga("t.tga", 1, red);
    scratch.write("a.mtl", "newmtl m\nmap_Kd t.tga\nnewmtl n\nKd 1 0 0\nmap_Kd t.tga\n");
    const auto result =
        scratch.read("t.obj", "mtllib a.mtl\n" + face + "usemtl m\nf 1 2 3\nusemtl n\nf 3 2 1\n");
    EXPECT_EQ(result.model.materials.size(), 2U);
    EXPECT_EQ(result.model.textures.size(), 1U);
    EXPECT_EQ(result.model.triangle_materials, (std::vector<std::uint32_t>{0, 1}));
}

TEST(Mtl, MissingFilesAreWarnings) {
    const Scratch scratch;
    const auto texture = read_with(scratch, "newmtl m\nKd 1 0 0\nmap_Kd gone.png\n");
    EXPECT_EQ(material_of(texture).base_color, (Vec4f{1, 0, 0, 1}));
    EXPECT_TRUE(has_warning(texture.report, "material 'm' of a.mtl: texture 'gone.png' is missing"));
    const auto library = scratch.read("u.obj", "mtllib none.mtl\n" + face + "usemtl m\nf 1 2 3\n");
    EXPECT_TRUE(has_warning(library.report, "'none.mtl' is missing"));
    EXPECT_TRUE(has_warning(library.report, "The material 'm' is in no material library"));
}

TEST(Mtl, SeveralLibrariesAndNamesWithBlanks) {
    const Scratch scratch;
    scratch.write("a.mtl", "newmtl m\nKd 1 0 0\n");
    scratch.write("b c.mtl", "newmtl n\nKd 0 1 0\nnewmtl m\nKd 0 0 1\n");
    scratch.write("d.mtl", "newmtl o o\nKd 0 0 1\n");
    const auto result =
        scratch.read("t.obj", "mtllib a.mtl d.mtl\nmtllib b c.mtl\n" + face +
                                  "usemtl m\nf 1 2 3\nusemtl n\nf 1 2 3\nusemtl o o\nf 1 2 3\n");
    ASSERT_EQ(result.model.materials.size(), 3U);
    EXPECT_EQ(result.model.materials[0].base_color, (Vec4f{1, 0, 0, 1})); // the first library wins
    EXPECT_EQ(result.model.materials[1].base_color, (Vec4f{0, 1, 0, 1}));
    EXPECT_EQ(result.model.materials[2].base_color, (Vec4f{0, 0, 1, 1}));
    EXPECT_TRUE(result.report.warnings.empty());
    EXPECT_EQ(result.report.files.size(), 4U);
}

TEST(Mtl, LettersOfTheWrongCaseAndFoldersOfTheLibrary) {
    const Scratch scratch;
    scratch.write_tga("Maps/Tex.tga", 1, red);
    EXPECT_EQ(read_with(scratch, "newmtl m\nmap_Kd maps/TEX.TGA\n").model.textures.size(), 1U);
    scratch.write("maps2/m.mtl", "newmtl m\nmap_Kd here.tga\n");
    scratch.write_tga("maps2/here.tga", 1, red);
    EXPECT_EQ(
        scratch.read("t.obj", "mtllib maps2/m.mtl\n" + face + "usemtl m\nf 1 2 3\n").model.textures.size(),
        1U);
}

TEST(Mtl, ReferencesStayInTheFolder) {
    const Scratch scratch;
    for (const char* name : {"../x.png", "/etc/passwd", "C:\\x.png", "http://host/x.png"}) {
        scratch.write("a.mtl", "newmtl m\nmap_Kd " + std::string(name) + "\n");
        EXPECT_NE(scratch.refusal("t.obj", "mtllib a.mtl\n" + face + "usemtl m\nf 1 2 3\n").find("reference"),
                  std::string::npos);
        EXPECT_NE(scratch.refusal("t.obj", "mtllib " + std::string(name) + "\n" + face + "f 1 2 3\n")
                      .find("reference"),
                  std::string::npos);
    }
}

TEST(Mtl, BrokenTextureIsNamed) {
    const Scratch scratch;
    scratch.write("bad.png", "no picture");
    scratch.write("a.mtl", "newmtl m\nmap_Kd bad.png\n");
    const std::string message = scratch.refusal("t.obj", "mtllib a.mtl\n" + face + "usemtl m\nf 1 2 3\n");
    EXPECT_NE(message.find("material 'm' of a.mtl"), std::string::npos) << message;
    EXPECT_NE(message.find("bad.png"), std::string::npos) << message;
}

} // namespace spa::test
} // namespace spa::test
