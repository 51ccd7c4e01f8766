// SPDX-License-Identifier: Apache-2.0
#include "../../tools/label.h"
#include "../../tools/picture.h"
#include "../../tools/text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace spa::test {
namespace {

using namespace spa::tools;

TEST(Picture, SmallOnesAreRepeatedAndLargeOnesAveraged) {
    Picture picture(2, 1, {});
    picture.at(1, 0) = {100, 200, 40};
    const Picture large = scale_to_fit(picture, 7);
    EXPECT_EQ(large.width, 6U);
    EXPECT_EQ(large.height, 3U);
    EXPECT_EQ(large.at(2, 2), (Rgb{0, 0, 0}));
    EXPECT_EQ(large.at(3, 0), (Rgb{100, 200, 40}));
    const Picture small = scale_to_fit(picture, 1);
    EXPECT_EQ(small.width, 1U);
    EXPECT_EQ(small.height, 1U);
    EXPECT_EQ(small.at(0, 0), (Rgb{50, 100, 20}));
}

TEST(Picture, PasteCutsOffWhatIsOutside) {
    Picture target(4, 4, {});
    paste(target, Picture(3, 3, {9, 9, 9}), 2, 3);
    EXPECT_EQ(std::count(target.pixels.begin(), target.pixels.end(), Rgb{9, 9, 9}), 2);
    paste(target, Picture(3, 3, {9, 9, 9}), 4, 0);
    EXPECT_EQ(std::count(target.pixels.begin(), target.pixels.end(), Rgb{9, 9, 9}), 2);
}

TEST(Picture, ViridisGrowsLighter) {
    EXPECT_EQ(viridis(0), (Rgb{68, 1, 84}));
    EXPECT_EQ(viridis(1), (Rgb{253, 231, 37}));
    EXPECT_EQ(viridis(-1), viridis(0));
    const auto luminance = [](Rgb c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; };
    for (int i = 0; i < 32; ++i)
        EXPECT_LT(luminance(viridis(i / 32.0)), luminance(viridis((i + 1) / 32.0))) << i;
}

TEST(Label, EveryCharacterIsDifferent) {
    std::set<std::vector<Rgb>> seen;
    for (char c = ' '; c <= '~'; ++c) {
        Picture picture(label_advance, label_height, {});
        draw_label(picture, 0, 0, std::string(1, c), {255, 255, 255});
        EXPECT_TRUE(seen.insert(picture.pixels).second) << c;
    }
}

TEST(Label, ScalesAndStaysInside) {
    Picture one(label_advance, label_height, {}), three(3 * label_advance, 3 * label_height, {});
    draw_label(one, 0, 0, "R", {1, 1, 1});
    draw_label(three, 0, 0, "R", {1, 1, 1}, 3);
    EXPECT_EQ(scale_to_fit(one, 3 * label_advance).pixels, three.pixels);
    Picture tiny(3, 3, {});
    draw_label(tiny, 1, 1, "a long text\xC3\xA9", {1, 1, 1}, 4);
}

TEST(Text, Bytes) {
    EXPECT_EQ(byte_count(1), "1 byte");
    EXPECT_EQ(byte_count(1023), "1023 bytes");
    EXPECT_EQ(byte_count(1536), "1.5 KiB");
    EXPECT_EQ(byte_count((1U << 20U) - 1), "1.0 MiB");
    EXPECT_EQ(byte_count(std::uint64_t(5) << 30U), "5.0 GiB");
}

TEST(Text, Hex) {
    EXPECT_EQ(hex64(0xAB), "00000000000000ab");
    EXPECT_EQ(hex64(~std::uint64_t(0)), "ffffffffffffffff");
}

TEST(Text, Wrap) {
    EXPECT_EQ(wrap_text("one two three", 7), (std::vector<std::string>{"one two", "three"}));
    EXPECT_EQ(wrap_text("a\n\nb", 7), (std::vector<std::string>{"a", "", "b"}));
    EXPECT_EQ(wrap_text("incomprehensible", 4), (std::vector<std::string>{"incomprehensible"}));
}

} // namespace
} // namespace spa::test
