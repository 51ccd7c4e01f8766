// SPDX-License-Identifier: Apache-2.0
#include "../../libspa/core/error.h"
#include "../../samples/samples.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <fstream>
#include <iterator>

namespace {

using spa::Model;
using spa::samples::make_sample;
using spa::samples::to_glb;
using Bytes = std::vector<std::byte>;

std::uint32_t word(const Bytes& bytes, std::size_t offset) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i > 0; --i) value = value << 8U | std::uint32_t(bytes.at(offset + i - 1));
    return value;
}

struct Glb {
    nlohmann::json json;
    Bytes binary;
};

Glb parse(const Bytes& bytes) {
    EXPECT_EQ(std::memcmp(bytes.data(), "glTF", 4), 0);
    EXPECT_EQ(word(bytes, 4), 2U);
    EXPECT_EQ(word(bytes, 8), bytes.size());
    const std::size_t length = word(bytes, 12);
    EXPECT_EQ(length % 4, 0U);
    EXPECT_EQ(std::memcmp(&bytes.at(16), "JSON", 4), 0);
    const char* text = reinterpret_cast<const char*>(&bytes.at(20));
    EXPECT_EQ(word(bytes, 20 + length) + 28 + length, bytes.size());
    EXPECT_EQ(std::memcmp(&bytes.at(24 + length), "BIN\0", 4), 0);
    return {nlohmann::json::parse(text, text + length),
            Bytes(bytes.begin() + std::ptrdiff_t(28 + length), bytes.end())};
}

// The bytes of an accessor or of an image.
Bytes view(const Glb& glb, const nlohmann::json& user) {
    const auto& entry = glb.json.at("bufferViews").at(user.at("bufferView").get<std::size_t>());
    const auto first = glb.binary.begin() + entry.at("byteOffset").get<std::ptrdiff_t>();
    return {first, first + entry.at("byteLength").get<std::ptrdiff_t>()};
}

template <class T>
bool holds(const Bytes& bytes, const std::vector<T>& values) {
    return bytes.size() == values.size() * sizeof(T) &&
           std::memcmp(bytes.data(), values.data(), bytes.size()) == 0;
}

TEST(Glb, HoldsTheVerticesAsTheyAre) {
    const Model model = make_sample("boot", 0);
    const Glb glb = parse(to_glb(model));
    const auto& primitive = glb.json.at("meshes").at(0).at("primitives").at(0);
    const auto accessor = [&](const char* name) {
        return glb.json.at("accessors").at(primitive.at("attributes").at(name).get<std::size_t>());
    };
    EXPECT_EQ(accessor("POSITION").at("count"), 334);
    EXPECT_TRUE(holds(view(glb, accessor("POSITION")), model.positions));
    EXPECT_TRUE(holds(view(glb, accessor("NORMAL")), model.normals));
    EXPECT_TRUE(holds(view(glb, accessor("TEXCOORD_0")), model.uvs));
    EXPECT_FALSE(primitive.at("attributes").contains("COLOR_0"));
    EXPECT_TRUE(glb.json.at("materials").at(0).at("doubleSided").get<bool>());
    EXPECT_FALSE(parse(to_glb(make_sample("cube", 0))).json.at("materials").at(0).contains("doubleSided"));
}

TEST(Glb, IndicesAreAsNarrowAsTheyMayBe) {
    for (const auto& [level, component] : {std::pair{3, 5123}, {4, 5125}}) {
        const Model model = make_sample("boot", level);
        const Glb glb = parse(to_glb(model));
        const auto& accessor =
            glb.json.at("accessors")
                .at(glb.json.at("meshes").at(0).at("primitives").at(0).at("indices").get<std::size_t>());
        EXPECT_EQ(accessor.at("componentType"), component);
        EXPECT_EQ(accessor.at("count"), 3 * model.triangles.size());
    }
}

TEST(Glb, TextureIsAPngOfTheSamePixels) {
    const Model model = make_sample("boot", 0);
    const Glb glb = parse(to_glb(model));
    Bytes png = view(glb, glb.json.at("images").at(0));
    OIIO::Filesystem::IOMemReader source(png.data(), png.size());
    const auto input = OIIO::ImageInput::open("image.png", nullptr, &source);
    ASSERT_TRUE(input) << OIIO::geterror();
    const spa::Image& image = model.textures.at(0).mips.at(0);
    ASSERT_EQ(input->spec().width, int(image.width));
    ASSERT_EQ(input->spec().height, int(image.height));
    ASSERT_EQ(input->spec().nchannels, 3);
    std::vector<std::array<std::uint8_t, 3>> pixels(image.pixels.size());
    ASSERT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, pixels.data()));
    for (std::size_t i = 0; i < pixels.size(); ++i)
        for (std::size_t channel = 0; channel < 3; ++channel)
            ASSERT_EQ(pixels[i].at(channel), image.pixels[i].at(channel));
}

TEST(Glb, KeepsMaterialsApartAndLeavesOutUnusedOnes) {
    Model model = make_sample("cube", 0);
    model.materials = {{}, {}, {}};
    model.materials[1].name = "unused";
    model.materials[2].name = "glass";
    model.materials[2].base_color = {0.5F, 1, 1, 0.25F};
    model.materials[2].alpha_mode = spa::AlphaMode::blend;
    model.triangle_materials.assign(model.triangles.size(), 0);
    model.triangle_materials.back() = 2;
    const Glb glb = parse(to_glb(model));
    const auto& primitives = glb.json.at("meshes").at(0).at("primitives");
    ASSERT_EQ(primitives.size(), 2U);
    ASSERT_EQ(glb.json.at("materials").size(), 2U);
    const auto& glass = glb.json.at("materials").at(primitives.at(1).at("material").get<std::size_t>());
    EXPECT_EQ(glass.at("name"), "glass");
    EXPECT_EQ(glass.at("alphaMode"), "BLEND");
    EXPECT_EQ(glass.at("pbrMetallicRoughness").at("baseColorFactor"), (nlohmann::json{0.5, 1.0, 1.0, 0.25}));
    EXPECT_EQ(glb.json.at("accessors").at(primitives.at(1).at("indices").get<std::size_t>()).at("count"), 3);
}

TEST(Glb, RefusesABrokenModel) {
    Model model = make_sample("cube", 0);
    model.triangles[0].vertex[0] = 24;
    EXPECT_THROW(to_glb(model), spa::Error);
    model = make_sample("cube", 0);
    model.colors.pop_back();
    EXPECT_THROW(to_glb(model), spa::Error);
    EXPECT_THROW(to_glb(Model{}), spa::Error);
}

TEST(GlbFile, IsWrittenWholeOrNotAtAll) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(testing::TempDir()) / "spa_glb_test";
    fs::remove_all(folder);
    fs::create_directory(folder);
    const Model model = make_sample("cube", 0);
    spa::samples::write_glb(model, folder / "cube.glb");
    std::ifstream stream(folder / "cube.glb", std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const Bytes bytes = to_glb(model);
    EXPECT_EQ(text.size(), bytes.size());
    EXPECT_EQ(std::memcmp(text.data(), bytes.data(), bytes.size()), 0);

    fs::create_directories(folder / "taken" / "by a folder");
    for (const fs::path& path : {folder / "no such folder" / "cube.glb", folder / "taken"}) {
        try {
            spa::samples::write_glb(model, path);
            ADD_FAILURE() << path;
        } catch (const spa::Error& error) {
            EXPECT_EQ(error.code(), spa::ExitCode::input_output);
            EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
        }
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2) << "something was left behind";
    fs::remove_all(folder);
}

} // namespace
