// SPDX-License-Identifier: Apache-2.0
#include "file_parts.h"
#include "test_maps.h"

#include "../../formats/container/codec.h"
#include "../../formats/container/reader.h"

#include <random>

#include <gtest/gtest.h>

namespace spa::test {
namespace {

using namespace spa::container;

constexpr ElementFormat depth_formats[]{ElementFormat::u8, ElementFormat::u16, ElementFormat::f32};
constexpr ElementFormat normal_formats[]{ElementFormat::oct8, ElementFormat::oct16, ElementFormat::rgb8};

void expect_round_trip(const TestMap& map) {
    for (const Compression compression : {Compression::none, Compression::zstd}) {
        const FileBytes file = write(map.map, compression);
        File opened;
        const Status status = open(std::span<const std::byte>(file), opened);
        ASSERT_TRUE(status.ok()) << describe(status, "file");
        EXPECT_TRUE(same(opened.map(), map.map));
        EXPECT_EQ(opened.length(), file.size());
        EXPECT_EQ(opened.version().major, 1);

        std::size_t used = 0;
        const ReadExactly from_memory = [&](std::span<std::byte> piece) {
            std::copy_n(file.begin() + std::ptrdiff_t(used), piece.size(), piece.begin());
            used += piece.size();
            return true;
        };
        File streamed;
        ASSERT_TRUE(read(from_memory, streamed).ok());
        EXPECT_TRUE(same(streamed.map(), map.map));
        EXPECT_EQ(used, file.size());

        // Views survive moves of their owner.
        File moved = std::move(streamed);
        EXPECT_TRUE(same(moved.map(), map.map));

        File unchecked;
        ASSERT_TRUE(open(std::span<const std::byte>(file), unchecked, {.depth = CheckDepth::structure}).ok());
        EXPECT_TRUE(same(unchecked.map(), map.map));
    }
}

TEST(RoundTrip, EveryElementFormatAndMapping) {
    for (const ElementFormat depth : depth_formats) {
        for (const ElementFormat normal : normal_formats) {
            TestPart octahedral;
            octahedral.depth = depth;
            octahedral.normal = normal;
            expect_round_trip(make_map({octahedral}));
            TestPart latlong = octahedral;
            latlong.mapping = Mapping::latlong;
            latlong.width = 16;
            latlong.height = 7;
            latlong.color_width = 1;
            expect_round_trip(make_map({latlong}));
        }
    }
}

TEST(RoundTrip, PartsAndLayers) {
    TestPart one;
    one.layers = 1;
    TestPart deep;
    deep.layers = 5;
    deep.solid_core = false;
    TestPart bare;
    bare.inner_colors = false;
    TestPart latlong;
    latlong.mapping = Mapping::latlong;
    TestPart unmarked;
    unmarked.mixed = unmarked.center_inside = false;
    TestPart unfolded;
    unfolded.folds = false;
    expect_round_trip(make_map({one, deep, bare, latlong, unmarked, unfolded}, ""));
    expect_round_trip(make_example());
}

TEST(RoundTrip, ThePapersPreset) {
    TestPart paper;
    paper.mapping = Mapping::latlong;
    paper.width = paper.color_width = 640;
    paper.height = paper.color_height = 480;
    paper.depth = ElementFormat::u8;
    paper.normal = ElementFormat::rgb8;
    paper.layers = 1;
    expect_round_trip(make_map({paper}));
}

TEST(RoundTrip, CompressionPays) {
    TestPart part;
    part.width = part.height = part.color_width = part.color_height = 65;
    const TestMap map = make_map({part});
    const FileBytes packed = write(map.map, Compression::zstd);
    EXPECT_LT(packed.size() * 2, write(map.map).size());
    bool filtered = false;
    for (const Section& section : take_apart(packed).sections)
        filtered = filtered || section.entry.scheme == Scheme::filtered_zstd;
    EXPECT_TRUE(filtered);
    EXPECT_EQ(take_apart(packed).find(type_fold).entry.scheme, Scheme::zstd);
}

TEST(RoundTrip, SameMapSameBytes) {
    EXPECT_EQ(write(make_map({TestPart{}}).map, Compression::zstd),
              write(make_map({TestPart{}}).map, Compression::zstd));
}

// Uncompressed images lie in the file's own memory, at multiples of 64.
TEST(RoundTrip, UncompressedImagesAreUsedWhereTheyLie) {
    const FileBytes file = write(make_map({TestPart{}}).map);
    File opened;
    ASSERT_TRUE(open(std::span<const std::byte>(file), opened).ok());
    const std::byte* const pixels = opened.map().parts[0].layers[1].outer.normal.bytes.data();
    EXPECT_GE(pixels, file.data());
    EXPECT_LT(pixels, file.data() + file.size());
    EXPECT_EQ((pixels - file.data()) % 64, 0);
}

// The definition in formats/SPA.md, section 4, written down a second time and as plainly as possible.
FileBytes filter_by_definition(ElementFormat format, std::uint32_t width, std::uint32_t height,
                               const FileBytes& raw) {
    const ElementShape shape = element_shape(format);
    const std::size_t c_count = shape.components;
    const std::size_t s = shape.component_size;
    const std::uint64_t modulus = std::uint64_t(1) << (8 * s);
    const auto v = [&](std::int64_t x, std::int64_t y, std::size_t c) -> std::uint64_t {
        if (x < 0 || y < 0) return 0;
        std::uint64_t value = 0;
        const std::size_t at = (std::size_t(y) * width + std::size_t(x)) * c_count * s + c * s;
        for (std::size_t b = s; b-- > 0;) value = value * 256 + std::to_integer<std::uint64_t>(raw[at + b]);
        return value;
    };
    FileBytes out(raw.size());
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            for (std::size_t c = 0; c < c_count; ++c) {
                const std::uint64_t d =
                    (v(x, y, c) + 2 * modulus - v(std::int64_t(x) - 1, y, c) - v(x, std::int64_t(y) - 1, c) +
                     v(std::int64_t(x) - 1, std::int64_t(y) - 1, c)) %
                    modulus;
                const std::uint64_t z = d < modulus / 2 ? 2 * d : 2 * (modulus - d) - 1;
                for (std::size_t b = 0; b < s; ++b)
                    out[(c * s + b) * width * height + std::size_t(y) * width + x] =
                        std::byte((z >> (8 * b)) & 0xFFU);
            }
        }
    }
    return out;
}

TEST(Filter, IsTheDefinitionAndLossless) {
    std::mt19937 random(1);
    for (const ElementFormat format :
         {ElementFormat::rgba8, ElementFormat::u8, ElementFormat::u16, ElementFormat::f32,
          ElementFormat::oct8, ElementFormat::oct16, ElementFormat::rgb8}) {
        EXPECT_EQ(element_shape(format).components * element_shape(format).component_size,
                  element_size(format));
        for (const auto& [width, height] :
             {std::pair(1U, 1U), std::pair(7U, 1U), std::pair(1U, 5U), std::pair(9U, 6U)}) {
            FileBytes raw(std::size_t(width) * height * element_size(format));
            for (std::byte& b : raw) b = std::byte(random() & 0xFFU);
            const FileBytes filtered = filter(format, width, height, raw);
            EXPECT_EQ(filtered, filter_by_definition(format, width, height, raw)) << name(format);
            EXPECT_EQ(unfilter(format, width, height, filtered), raw) << name(format);
        }
    }
}

} // namespace
} // namespace spa::test
