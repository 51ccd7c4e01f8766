// SPDX-License-Identifier: Apache-2.0
// The element formats of stored images and the exact arithmetic of their codes. The byte layout of each
// is in formats/SPA.md, "Element formats"; the two must not differ.
#pragma once

#include "vector.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace spa {

// The numeric values are those of the file format.
enum class ElementFormat : std::uint32_t {
    rgba8 = 1, // colour: sRGB red, green, blue; linear alpha = coverage
    u8 = 2,    // depth: round(255 r/R), 0 = no surface
    u16 = 3,   // depth: round(65535 r/R), 0 = no surface
    f32 = 4,   // depth: r/R, 0 = no surface
    oct8 = 5,  // normal: octahedral, 2 x int8, value/127
    oct16 = 6, // normal: octahedral, 2 x int16, value/32767
    rgb8 = 7,  // normal: 3 x uint8, value/255 * 2 - 1 (the paper's)
};

// Bytes of one element; 0 for a value that is not an ElementFormat.
constexpr std::size_t element_size(ElementFormat format) {
    switch (format) {
    case ElementFormat::rgba8: return 4;
    case ElementFormat::u8: return 1;
    case ElementFormat::u16: return 2;
    case ElementFormat::f32: return 4;
    case ElementFormat::oct8: return 2;
    case ElementFormat::oct16: return 4;
    case ElementFormat::rgb8: return 3;
    }
    return 0;
}

// "rgba8", "u8", ... as on the command line; "unknown" for a value that is not an ElementFormat.
const char* name(ElementFormat format);

// Writes the code of a normalized depth r/R in [0,1] at `out` (element_size(format) bytes, little-endian).
// A surface never gets code 0: the smallest code of a surface is 1 (f32: the smallest normal float), so
// that "no surface" stays unambiguous. Values above 1 get the top code. Error of u8 and u16: half a code.
// format: u8, u16 or f32.
void encode_depth(ElementFormat format, double normalized_depth, std::byte* out);
// The normalized depth of a code; 0 = no surface.
float decode_depth(ElementFormat format, const std::byte* in);
// The largest |decoded - true| over [0,1] that rounding can cause, in units of R; f32: one ulp of 1.
double depth_quantum_error(ElementFormat format);

// Writes the code of a unit normal (element_size(format) bytes). Of the four octahedral codes around the
// exact position the one with the least angular error is taken (Cigolle et al. 2014, "precise" variant).
// The zero vector gives all-zero bytes. format: oct8, oct16 or rgb8.
void encode_normal(ElementFormat format, Vec3d normal, std::byte* out);
// A unit vector, except that rgb8 code 0,0,0 gives the zero vector ("no surface"). Octahedral code 0,0 is
// also the exact code of +Z: ask the depth whether there is a surface.
Vec3f decode_normal(ElementFormat format, const std::byte* in);

// sRGB transfer (IEC 61966-2-1). Linear values outside [0,1] are clamped; NaN gives 0.
float srgb_to_linear(std::uint8_t code);
std::uint8_t linear_to_srgb(float linear);

// linear_to_srgb from a table, for many of them. Immutable.
class SrgbEncoder {
public:
    SrgbEncoder();
    std::uint8_t operator()(float linear) const {
        if (!(linear > lowest)) return 0;
        if (linear >= 1) return 255;
        const unsigned code = code_[(std::bit_cast<std::uint32_t>(linear) - bits_of_lowest) >> shift];
        return std::uint8_t(linear < least_[code + 1] ? code : code + 1);
    }

private:
    // The float patterns of [lowest, 1), cut into pieces that are so short (one in 256 of their value) that
    // none holds more than one step from code to code.
    static constexpr float lowest = 0x1p-13F; // code 0
    static constexpr std::uint32_t bits_of_lowest = std::bit_cast<std::uint32_t>(lowest);
    static constexpr unsigned shift = 15;
    static constexpr std::size_t pieces = (std::bit_cast<std::uint32_t>(1.0F) - bits_of_lowest) >> shift;
    std::array<std::uint8_t, pieces> code_{}; // of the first value of a piece
    std::array<float, 257> least_{};          // the smallest value of a code; infinity for code 256
};

} // namespace spa
