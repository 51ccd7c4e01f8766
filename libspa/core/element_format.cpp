// SPDX-License-Identifier: Apache-2.0
#include "element_format.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace spa {
namespace {

// Little-endian whatever the machine is.
void store_u16(std::byte* out, std::uint16_t v) {
    out[0] = std::byte(v & 0xFFU);
    out[1] = std::byte(v >> 8U);
}
void store_u32(std::byte* out, std::uint32_t v) {
    for (unsigned i = 0; i < 4; ++i) out[i] = std::byte((v >> (8 * i)) & 0xFFU);
}
std::uint16_t load_u16(const std::byte* in) {
    return std::uint16_t(std::to_integer<unsigned>(in[0]) | std::to_integer<unsigned>(in[1]) << 8U);
}
std::uint32_t load_u32(const std::byte* in) {
    return std::uint32_t(load_u16(in)) | std::uint32_t(load_u16(in + 2)) << 16U;
}

double sign(double v) { return v < 0 ? -1.0 : 1.0; }

// Octahedral projection of a unit vector onto [-1,1]^2 around +Z, unfolded (Cigolle et al. 2014).
Vec2d octahedral_project(Vec3d n) {
    const double l = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    const Vec2d p{n.x / l, n.y / l};
    if (n.z >= 0) return p;
    return {(1 - std::abs(p.y)) * sign(n.x), (1 - std::abs(p.x)) * sign(n.y)};
}
Vec3d octahedral_unproject(Vec2d p) {
    Vec3d n{p.x, p.y, 1 - std::abs(p.x) - std::abs(p.y)};
    if (n.z < 0) {
        n.x = (1 - std::abs(p.y)) * sign(p.x);
        n.y = (1 - std::abs(p.x)) * sign(p.y);
    }
    return normalize(n);
}

// The best of the four codes around the exact position, as signed integers in [-scale, scale].
std::array<int, 2> octahedral_code(Vec3d n, int scale) {
    const Vec2d p = octahedral_project(n) * double(scale);
    const int x0 = int(std::floor(p.x));
    const int y0 = int(std::floor(p.y));
    std::array<int, 2> best{};
    double best_cos = -2;
    for (int dy = 0; dy < 2; ++dy) {
        for (int dx = 0; dx < 2; ++dx) {
            const int x = std::clamp(x0 + dx, -scale, scale);
            const int y = std::clamp(y0 + dy, -scale, scale);
            const double c = dot(n, octahedral_unproject({double(x) / scale, double(y) / scale}));
            if (c > best_cos) {
                best_cos = c;
                best = {x, y};
            }
        }
    }
    return best;
}

} // namespace

const char* name(ElementFormat format) {
    switch (format) {
    case ElementFormat::rgba8: return "rgba8";
    case ElementFormat::u8: return "u8";
    case ElementFormat::u16: return "u16";
    case ElementFormat::f32: return "f32";
    case ElementFormat::oct8: return "oct8";
    case ElementFormat::oct16: return "oct16";
    case ElementFormat::rgb8: return "rgb8";
    }
    return "unknown";
}

void encode_depth(ElementFormat format, double normalized_depth, std::byte* out) {
    const double d = std::clamp(normalized_depth, 0.0, 1.0);
    switch (format) {
    case ElementFormat::u8: *out = std::byte(std::max(1L, std::lround(d * 255))); break;
    case ElementFormat::u16: store_u16(out, std::uint16_t(std::max(1L, std::lround(d * 65535)))); break;
    default:
        store_u32(out, std::bit_cast<std::uint32_t>(std::max(float(d), std::numeric_limits<float>::min())));
    }
}

float decode_depth(ElementFormat format, const std::byte* in) {
    switch (format) {
    case ElementFormat::u8: return float(std::to_integer<unsigned>(*in)) / 255.0F;
    case ElementFormat::u16: return float(load_u16(in)) / 65535.0F;
    default: return std::bit_cast<float>(load_u32(in));
    }
}

double depth_quantum_error(ElementFormat format) {
    switch (format) {
    case ElementFormat::u8: return 0.5 / 255;
    case ElementFormat::u16: return 0.5 / 65535;
    default: return std::numeric_limits<float>::epsilon();
    }
}

void encode_normal(ElementFormat format, Vec3d normal, std::byte* out) {
    if (normal == Vec3d{}) {
        std::fill_n(out, element_size(format), std::byte{0});
        return;
    }
    if (format == ElementFormat::rgb8) {
        const auto code = [](double v) {
            return std::byte(std::lround((std::clamp(v, -1.0, 1.0) + 1) * 127.5));
        };
        out[0] = code(normal.x);
        out[1] = code(normal.y);
        out[2] = code(normal.z);
    } else if (format == ElementFormat::oct8) {
        const auto code = octahedral_code(normal, 127);
        out[0] = std::byte(std::uint8_t(code[0]));
        out[1] = std::byte(std::uint8_t(code[1]));
    } else {
        const auto code = octahedral_code(normal, 32767);
        store_u16(out, std::uint16_t(code[0]));
        store_u16(out + 2, std::uint16_t(code[1]));
    }
}

Vec3f decode_normal(ElementFormat format, const std::byte* in) {
    if (format == ElementFormat::rgb8) {
        const auto value = [](std::byte b) { return std::to_integer<int>(b) / 127.5 - 1; };
        if (in[0] == std::byte{0} && in[1] == std::byte{0} && in[2] == std::byte{0}) return {};
        return to_float(normalize(Vec3d{value(in[0]), value(in[1]), value(in[2])}));
    }
    // -128 and -32768 are not produced; clamping keeps a foreign file inside the square.
    if (format == ElementFormat::oct8) {
        const auto value = [](std::byte b) {
            return std::max(-1.0, double(std::int8_t(std::to_integer<std::uint8_t>(b))) / 127);
        };
        return to_float(octahedral_unproject({value(in[0]), value(in[1])}));
    }
    const auto value = [](std::uint16_t v) { return std::max(-1.0, double(std::int16_t(v)) / 32767); };
    return to_float(octahedral_unproject({value(load_u16(in)), value(load_u16(in + 2))}));
}

float srgb_to_linear(std::uint8_t code) {
    const double s = double(code) / 255;
    return float(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
}

std::uint8_t linear_to_srgb(float linear) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 255;
    const double l = double(linear);
    const double s = l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055;
    return std::uint8_t(std::lround(s * 255));
}

SrgbEncoder::SrgbEncoder() {
    for (unsigned code = 1; code < 256; ++code) {
        // The inverse of the transfer function is off by a few ulp at most.
        const double s = (code - 0.5) / 255;
        auto least = float(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
        while (linear_to_srgb(least) >= code) least = std::nextafter(least, 0.0F);
        while (linear_to_srgb(least) < code) least = std::nextafter(least, 1.0F);
        least_[code] = least;
    }
    least_[256] = std::numeric_limits<float>::infinity();
    unsigned code = 0;
    for (std::size_t i = 0; i < pieces; ++i) {
        const auto first = std::bit_cast<float>(bits_of_lowest + std::uint32_t(i << shift));
        while (first >= least_[code + 1]) ++code;
        code_[i] = std::uint8_t(code);
    }
}

} // namespace spa
