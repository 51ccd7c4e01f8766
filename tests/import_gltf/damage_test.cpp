// SPDX-License-Identifier: Apache-2.0
// Files damaged at random (with fixed seeds) never crash, hang or give a broken model. CI runs this under
// AddressSanitizer and UndefinedBehaviorSanitizer.
#include "scene_builder.h"

#include "../../formats/import/source_file.h"
#include "../../formats/import/texture.h"
#include "../../libspa/core/error.h"

#include <algorithm>
#include <random>
#include <span>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

using import::Limits;

constexpr std::uintmax_t largest_file = 64 * 1024;

struct Outcomes {
    std::size_t imported = 0, refused = 0;
};

Limits tight_limits() {
    Limits limits;
    limits.vertices = limits.triangles = limits.texture_pixels = 1U << 20U;
    return limits;
}

using Reader = void (*)(const std::filesystem::path& path); // expects what it reads to be valid

void check_model(const std::filesystem::path& path) {
    expect_valid(import::read_model(path, tight_limits()));
}
void check_scene(const std::filesystem::path& path) {
    expect_valid(import::read_scene(path, tight_limits()));
}

void import_damaged(const Scratch& scratch, const std::string& name, const std::string& bytes,
                    Outcomes& outcomes, Reader reader = check_model) {
    const std::filesystem::path path = scratch.write(name, bytes);
    try {
        reader(path);
        ++outcomes.imported;
    } catch (const Error& error) {
        // unsupported: damage can make up the name of an extension.
        EXPECT_TRUE(error.code() == ExitCode::invalid_data || error.code() == ExitCode::unsupported)
            << error.what();
        EXPECT_EQ(std::string_view(error.what()).rfind(path.string(), 0), 0U) << error.what();
        ++outcomes.refused;
    }
}

// Words that steer a parser of JSON or a decoder.
constexpr const char* words[] = {"-1",    "0",    "4294967295", "9007199254740993",
                                 "1e308", "null", "[]",         "{}",
                                 "\"",    "true", "0.5",        "5126",
                                 ",",     "]",    "\xFF",       "..",
                                 "99",    "[[[[", "MAT4",       "SCALAR",
                                 "16",    "3",    "7",          "1"};

std::string damage(std::string bytes, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return std::size_t(random()) % std::max<std::size_t>(n, 1); };
    for (std::size_t change = 0; change <= below(3) && !bytes.empty(); ++change) {
        const std::size_t at = below(bytes.size());
        switch (below(5)) {
        case 0: bytes[at] = char(random()); break;
        case 1: bytes[at] = char(bytes[at] ^ (1 << below(8))); break;
        case 2: bytes.erase(at, 1 + below(8)); break;
        case 3: {
            // Another digit keeps JSON valid, so that the damage goes deep.
            const std::size_t digit = bytes.find_first_of("0123456789", at);
            if (digit != std::string::npos) bytes[digit] = char('0' + below(10));
            break;
        }
        default: {
            const std::string_view word = words[below(std::size(words))];
            bytes.replace(at, std::min(word.size(), bytes.size() - at), word);
            break;
        }
        }
    }
    return bytes;
}

std::vector<std::filesystem::path> small_files(const std::vector<std::string>& extensions) {
    std::vector<std::filesystem::path> out;
    for (const char* folder : {"gltf", "unsupported", "malformed", "textures"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(assets() / folder))
            if (entry.is_regular_file() && entry.file_size() <= largest_file &&
                std::find(extensions.begin(), extensions.end(), entry.path().extension()) != extensions.end())
                out.push_back(entry.path());
    std::sort(out.begin(), out.end());
    return out;
}

std::string content(const std::filesystem::path& path) {
    const std::vector<std::byte> bytes = import::read_file(path, {}).bytes;
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(GltfDamage, RealFiles) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS";
    std::mt19937 random(20240521);
    Outcomes outcomes;
    for (const std::filesystem::path& path : small_files({".gltf", ".glb"})) {
        SCOPED_TRACE(path);
        const Scratch scratch;
        for (const auto& entry : std::filesystem::recursive_directory_iterator(path.parent_path()))
            if (entry.is_regular_file() && entry.path() != path && entry.file_size() <= largest_file)
                scratch.write(std::filesystem::relative(entry.path(), path.parent_path()).string(),
                              content(entry.path()));
        const std::string bytes = content(path);
        for (int round = 0; round < 40; ++round)
            import_damaged(scratch, path.filename().string(), damage(bytes, random), outcomes);
    }
    EXPECT_GT(outcomes.imported, 100U);
    EXPECT_GT(outcomes.refused, 1000U);
}

TEST(GltfDamage, Pictures) {
    if (assets().empty()) GTEST_SKIP() << "no assets: set SPA_ASSETS";
    std::mt19937 random(20240522);
    Outcomes outcomes;
    for (const std::filesystem::path& path : small_files({".png", ".jpg"})) {
        SCOPED_TRACE(path);
        const std::string bytes = content(path);
        for (int round = 0; round < 30; ++round) {
            const std::string damaged = damage(bytes, random);
            try {
                const Texture texture =
                    import::read_texture(std::as_bytes(std::span(damaged)), "a", tight_limits());
                EXPECT_EQ(texture.mips[0].pixels.size(),
                          std::size_t{texture.mips[0].width} * texture.mips[0].height);
                ++outcomes.imported;
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ExitCode::invalid_data) << error.what();
                ++outcomes.refused;
            }
        }
    }
    EXPECT_GT(outcomes.imported, 100U);
    EXPECT_GT(outcomes.refused, 100U);
}

void damage_document(const GltfBuilder& builder, unsigned seed, Reader reader) {
    const Scratch scratch;
    std::mt19937 random(seed);
    Outcomes outcomes;
    for (const bool binary : {true, false}) {
        const std::string bytes = binary ? builder.glb() : builder.text();
        import_damaged(scratch, "a.glb", bytes, outcomes, reader);
        EXPECT_EQ(outcomes.imported, 1U);
        for (int round = 0; round < 3000; ++round)
            import_damaged(scratch, "a.glb", damage(bytes, random), outcomes, reader);
        EXPECT_GT(outcomes.imported, 100U);
        EXPECT_GT(outcomes.refused, 100U);
        outcomes = {};
    }
}

// A document with everything in it, cut and damaged more often.
TEST(GltfDamage, HandMadeDocument) {
    GltfBuilder builder = triangle();
    Json& primitive = builder.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = builder.add_accessor<float>({0, 0, 1, 0, 0, 1}, "VEC2");
    primitive["attributes"]["COLOR_0"] =
        builder.add_accessor<std::uint8_t>(std::vector<std::uint8_t>(12, 200), "VEC4", true);
    primitive["attributes"]["JOINTS_0"] =
        builder.add_accessor<std::uint8_t>(std::vector<std::uint8_t>(12, 0), "VEC4");
    primitive["attributes"]["WEIGHTS_0"] = builder.add_accessor<float>(std::vector<float>(12, 0.25F), "VEC4");
    primitive["indices"] = builder.add_accessor<std::uint16_t>({0, 1, 2}, "SCALAR");
    primitive["targets"] = {{{"POSITION", builder.add_accessor<float>(std::vector<float>(9, 0.5F), "VEC3")}}};
    builder.json["meshes"][0]["weights"] = {1};
    const int bind = builder.add_accessor<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "MAT4");
    builder.json["skins"] = {{{"joints", {1}}, {"inverseBindMatrices", bind}}};
    builder.json["nodes"][0]["skin"] = 0;
    builder.json["nodes"].push_back({{"rotation", {0, 0, 0, 1}}, {"mesh", 0}, {"children", {2}}});
    const int offsets = builder.add_accessor<float>({0, 0, 0, 1, 1, 1}, "VEC3");
    builder.json["nodes"].push_back(
        {{"mesh", 0},
         {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", offsets}}}}}}}});
    builder.json["scenes"][0]["nodes"] = {0, 1};
    primitive["material"] = 0;
    builder.json["materials"] = {
        {{"alphaMode", "MASK"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 1}}}}}};
    damage_document(builder, 20240523, check_model);
}

// Little but what only a scene has.
TEST(GltfDamage, HandMadeScene) {
    GltfBuilder builder = lit_triangle({{"type", "spot"},
                                        {"name", "lamp"},
                                        {"color", {1, 0.5, 0.2}},
                                        {"intensity", 30},
                                        {"range", 9},
                                        {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.7}}}});
    builder.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}, {"aspectRatio", 1.5}}}},
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0}, {"zfar", 1}}}}};
    builder.json["nodes"][1]["camera"] = 0;
    builder.json["nodes"][1]["rotation"] = {0, 0, 0, 1};
    builder.json["nodes"].push_back({{"camera", 1}, {"scale", {2, 2, 2}}, {"children", {1}}});
    builder.json["scenes"][0]["nodes"] = {0, 2};
    damage_document(builder, 20240524, check_scene);
}

} // namespace
} // namespace spa::test
