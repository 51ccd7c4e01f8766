// SPDX-License-Identifier: Apache-2.0
// Damaged files never crash, hang or give a broken model: they are refused as invalid data or, where the
// damage leaves the file valid, imported. CI runs this under AddressSanitizer and UndefinedBehaviorSanitizer.
#include "scratch.h"

#include "../../libspa/core/error.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <random>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

const char* const obj =
    "# box\nmtllib a.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0\nv 0.2 0.1 0\nv 0 1 1e-1\n"
    "vt 0 0\nvt 1 0.5\nvn 0 0 1\no part\ng side\ns 1\nusemtl m\nf 1/1/1 2/2/1 3/1/1 \\\n4/2/1 "
    "5/1/1\nf -1 -2 -3\nl 1 2\nusemtl n\nf 1//1 2//1 5//1\n";
const char* const mtl = "newmtl m\nKd 0.5 0.25 1\nd 0.5\nmap_Kd -s 2 2 1 -clamp on tex.tga\nmap_d tex.tga\n"
                        "newmtl n\nKd 1\nTr 0.5\n";
const char* const ply =
    "ply\nformat ascii 1.0\ncomment TextureFile tex.tga\nelement vertex 4\nproperty float x\n"
    "property float y\nproperty float z\nproperty uchar red\nproperty uchar green\nproperty uchar "
    "blue\nelement face 2\nproperty list uchar int vertex_indices\nproperty list uchar float "
    "texcoord\nend_header\n0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0 0 0 255\n0 1 0.5 9 9 9\n4 0 1 2 3 8 "
    "0 0 1 0 1 1 0 1\n3 0 2 3 0\n";
const char* const stl =
    "solid a b\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
    "endfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\n"
    "endfacet\nendsolid a b\n";
const char* const off =
    "COFF # c\n5 3 0\n0 0 0 255 0 0\n1 0 0 0 255 0\n1 1 0 0 0 255 128\n0.2 0.1 0 1 2 3\n0 1 0 9 9 "
    "9\n5 0 1 2 3 4 1.0 0 0\n3 0 1 2\n2 0 1\n";

template <class T>
void put(std::string& bytes, T value, bool big_endian = false) {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), &value, sizeof(T));
    if (big_endian != (std::endian::native == std::endian::big)) std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
}

std::string binary_ply(bool big_endian) {
    std::string bytes =
        std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
        "_endian 1.0\nelement vertex 3\nproperty float x\nproperty short y\nproperty double z\n"
        "element tristrips 1\nproperty list int int vertex_indices\n"
        "element face 1\nproperty list uchar ushort vertex_indices\nend_header\n";
    for (const int i : {0, 1, 2}) {
        put(bytes, float(i), big_endian);
        put(bytes, std::int16_t(i * i), big_endian);
        put(bytes, double(-i), big_endian);
    }
    put(bytes, std::int32_t{5}, big_endian);
    for (const std::int32_t i : {0, 1, 2, -1, 0}) put(bytes, i, big_endian);
    put(bytes, std::uint8_t{3}, big_endian);
    for (const int i : {0, 1, 2}) put(bytes, std::uint16_t(i), big_endian);
    return bytes;
}

std::string binary_stl() {
    std::string bytes(80, ' ');
    put(bytes, std::uint32_t{2});
    for (int t = 0; t < 2; ++t) {
        for (const float value : {0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, float(t)})
            put(bytes, value);
        bytes.append(2, '\0');
    }
    return bytes;
}

struct Sample {
    const char* name;
    std::string bytes;
};

std::vector<Sample> samples() {
    return {{"a.obj", obj},
            {"a.mtl", mtl}, // damaged, it is read through the OBJ file
            {"a.ply", ply},
            {"b.ply", binary_ply(false)},
            {"c.ply", binary_ply(true)},
            {"a.stl", stl},
            {"b.stl", binary_stl()},
            {"a.off", off}};
}

struct Outcomes {
    std::size_t imported = 0, refused = 0;
};

// Imports a file with this content; counts what came of it.
void import_damaged(const Scratch& scratch, const Sample& sample, const std::string& bytes,
                    Outcomes& outcomes) {
    std::filesystem::path path = scratch.write(sample.name, bytes);
    if (path.extension() == ".mtl") path.replace_extension(".obj");
    import::Limits limits;
    limits.texture_pixels = 1U << 20U;
    try {
        const auto result = import::read_model(path, limits);
        expect_valid(result);
        ++outcomes.imported;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::invalid_data) << error.what();
        EXPECT_EQ(std::string_view(error.what()).rfind(path.string(), 0), 0U) << error.what();
        ++outcomes.refused;
    }
}

void write_companions(const Scratch& scratch) {
    scratch.write("a.obj", obj);
    scratch.write("a.mtl", mtl);
    scratch.write_tga("tex.tga", 1, {{1, 2, 3, 200}, {4, 5, 6, 255}});
}

TEST(Damage, SamplesAreWhole) {
    for (const Sample& sample : samples()) {
        const Scratch scratch;
        write_companions(scratch);
        Outcomes outcomes;
        import_damaged(scratch, sample, sample.bytes, outcomes);
        EXPECT_EQ(outcomes.imported, 1U) << sample.name;
    }
}

TEST(Damage, CutAtEveryLength) {
    for (const Sample& sample : samples()) {
        SCOPED_TRACE(sample.name);
        const Scratch scratch;
        write_companions(scratch);
        Outcomes outcomes;
        for (std::size_t size = 0; size < sample.bytes.size(); ++size)
            import_damaged(scratch, sample, sample.bytes.substr(0, size), outcomes);
        // A text that ends between two statements can be whole; binary data cannot, nor can what counts
        // ahead.
        const std::string_view name = sample.name;
        if (name == "b.ply" || name == "c.ply" || name == "b.stl") {
            EXPECT_EQ(outcomes.imported, 0U);
        }
        EXPECT_TRUE(outcomes.refused > 0 || name == "a.mtl");
    }
}

// Words that steer a parser; the numbers are at the edges of their types.
const char* const words[] = {"-1",
                             "0",
                             "4294967295",
                             "4294967296",
                             "9223372036854775807",
                             "nan",
                             "1e39",
                             "-",
                             "/",
                             "//",
                             "\\",
                             "#",
                             "\n",
                             "\r",
                             " ",
                             "list",
                             "uchar",
                             "double",
                             "\xFF",
                             "f",
                             "v",
                             "usemtl m\n",
                             "f 1 2 3\n",
                             "end_header\n",
                             "endloop\n",
                             "3 0 1 2\n",
                             "1e-46",
                             ".",
                             "+",
                             "..",
                             "mtllib a.mtl\n"};

TEST(Damage, RandomChanges) {
    for (const Sample& sample : samples()) {
        SCOPED_TRACE(sample.name);
        const Scratch scratch;
        write_companions(scratch);
        std::mt19937 random(12345);
        const auto below = [&](std::size_t n) { return std::size_t(random()) % std::max<std::size_t>(n, 1); };
        Outcomes outcomes;
        for (int round = 0; round < 2000; ++round) {
            std::string bytes = sample.bytes;
            for (std::size_t change = 0; change <= below(3); ++change) {
                const std::size_t at = below(bytes.size());
                switch (below(4)) {
                case 0: bytes[at] = char(random()); break;
                case 1: bytes[at] = char(bytes[at] ^ (1 << below(8))); break;
                case 2: bytes.erase(at, 1 + below(12)); break;
                default: bytes.insert(at, words[below(std::size(words))]); break;
                }
            }
            import_damaged(scratch, sample, bytes, outcomes);
        }
        EXPECT_GT(outcomes.imported, 0U);
        EXPECT_GT(outcomes.refused, 0U);
    }
}

} // namespace
} // namespace spa::test
