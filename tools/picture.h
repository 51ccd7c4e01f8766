// SPDX-License-Identifier: Apache-2.0
// Pictures for people: 8-bit RGB in memory, drawing, and the files that OpenImageIO writes.
#pragma once

#include "../libspa/core/vector.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spa::tools {

using Rgb = std::array<std::uint8_t, 3>;

struct Picture {
    std::uint32_t width = 0, height = 0;
    std::vector<Rgb> pixels; // row-major, row 0 on top

    Picture() = default;
    Picture(std::uint32_t w, std::uint32_t h, Rgb fill);
    [[nodiscard]] Rgb& at(std::uint32_t x, std::uint32_t y) { return pixels[std::size_t(y) * width + x]; }
    [[nodiscard]] const Rgb& at(std::uint32_t x, std::uint32_t y) const {
        return pixels[std::size_t(y) * width + x];
    }
};

// Copies `source` with its upper left corner to (x, y); what lies outside is cut off.
void paste(Picture& target, const Picture& source, std::uint32_t x, std::uint32_t y);

// Whole-number scaling so that the width is at most `max_width`: pixels repeated if the picture is small,
// averaged (in sRGB codes, good enough to look at) if it is large. An empty picture stays empty.
Picture scale_to_fit(const Picture& picture, std::uint32_t max_width);

// Matplotlib's "viridis" (Smith & van der Walt, CC0) by linear interpolation of nine of its colours; t in
// [0,1].
Rgb viridis(double t);

// An image file in memory. channels: 1, 3 or 4. Rows from top to bottom, samples interleaved, in the
// machine's byte order. Same input, same bytes. Throws Error{internal} if OpenImageIO fails.
std::vector<std::byte> encode_png8(std::uint32_t width, std::uint32_t height, int channels,
                                   std::span<const std::uint8_t> samples);
std::vector<std::byte> encode_png16(std::uint32_t width, std::uint32_t height, int channels,
                                    std::span<const std::uint16_t> samples);
// One channel, Y, 32-bit float.
std::vector<std::byte> encode_exr(std::uint32_t width, std::uint32_t height, std::span<const float> samples);
std::vector<std::byte> encode_png(const Picture& picture);

// Channels side by side that one EXR file is to hold: "R", or "indirect.R" of a layer.
struct ExrChannel {
    std::string name;
    std::span<const float> samples; // `stride` floats from one pixel's to the next
    std::size_t stride = 1;
};
// 32-bit float, zip.
std::vector<std::byte> encode_exr(std::uint32_t width, std::uint32_t height,
                                  std::span<const ExrChannel> channels);

// Linear light as a display shows it: times 2^exposure, clamped, sRGB. NaN is black.
Picture tone_map(std::uint32_t width, std::uint32_t height, std::span<const Vec3f> pixels, double exposure);

} // namespace spa::tools
