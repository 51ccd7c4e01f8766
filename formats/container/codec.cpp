// SPDX-License-Identifier: Apache-2.0
#include "codec.h"

#include "little_endian.h"

#include <new>
#include <utility>

#include <zstd.h>

namespace spa::container {
namespace {

// The difference of two T, small positive and small negative ones alike becoming small numbers.
template <class T>
T zigzag(T v) {
    return T(T(v << 1U) ^ T(0U - unsigned(v >> (8 * sizeof(T) - 1))));
}
template <class T>
T unzigzag(T v) {
    return T(T(v >> 1U) ^ T(0U - unsigned(v & 1U)));
}

struct Layout {
    std::size_t width = 0, height = 0, components = 0;
    [[nodiscard]] std::size_t samples() const { return width * height; }
};

// The row being worked on and the one above it, each after a zero: sample x is at [x + 1].
template <class T>
struct Rows {
    std::vector<T> above, current;

    explicit Rows(std::size_t width) : above(width + 1), current(width + 1) {}
    // left + above - above left, modulo 2^bits; what is outside counts as 0.
    [[nodiscard]] T prediction(std::size_t x) const { return T(current[x] + above[x + 1] - above[x]); }
    void next() { std::swap(above, current); }
};

// Component c, byte b of sample i is at raw[(i * components + c) * sizeof(T) + b] and at
// filtered[(c * sizeof(T) + b) * samples + i].
template <class T>
std::vector<std::byte> filter_components(const Layout& layout, std::span<const std::byte> raw) {
    std::vector<std::byte> out(raw.size());
    const std::size_t samples = layout.samples();
    const std::size_t stride = layout.components * sizeof(T);
    for (std::size_t c = 0; c < layout.components; ++c) {
        Rows<T> rows(layout.width);
        const std::byte* from = raw.data() + c * sizeof(T);
        std::byte* to = out.data() + c * sizeof(T) * samples;
        for (std::size_t y = 0; y < layout.height; ++y, rows.next()) {
            for (std::size_t x = 0; x < layout.width; ++x, from += stride, ++to) {
                const T value = load<T>(from);
                const T code = zigzag(T(value - rows.prediction(x)));
                rows.current[x + 1] = value;
                for (std::size_t b = 0; b < sizeof(T); ++b)
                    to[b * samples] = std::byte((code >> (8 * b)) & 0xFFU);
            }
        }
    }
    return out;
}

template <class T>
std::vector<std::byte> unfilter_components(const Layout& layout, std::span<const std::byte> filtered) {
    std::vector<std::byte> out(filtered.size());
    const std::size_t samples = layout.samples();
    const std::size_t stride = layout.components * sizeof(T);
    for (std::size_t c = 0; c < layout.components; ++c) {
        Rows<T> rows(layout.width);
        const std::byte* from = filtered.data() + c * sizeof(T) * samples;
        std::byte* to = out.data() + c * sizeof(T);
        for (std::size_t y = 0; y < layout.height; ++y, rows.next()) {
            for (std::size_t x = 0; x < layout.width; ++x, ++from, to += stride) {
                T code = 0;
                for (std::size_t b = 0; b < sizeof(T); ++b)
                    code = T(code | T(std::to_integer<T>(from[b * samples]) << (8 * b)));
                const T value = T(unzigzag(code) + rows.prediction(x));
                rows.current[x + 1] = value;
                store(to, value);
            }
        }
    }
    return out;
}

Layout layout_of(ElementFormat format, std::uint32_t width, std::uint32_t height) {
    return {width, height, element_shape(format).components};
}

} // namespace

ElementShape element_shape(ElementFormat format) {
    switch (format) {
    case ElementFormat::rgba8: return {4, 1};
    case ElementFormat::u8: return {1, 1};
    case ElementFormat::u16: return {1, 2};
    case ElementFormat::f32: return {1, 4};
    case ElementFormat::oct8: return {2, 1};
    case ElementFormat::oct16: return {2, 2};
    case ElementFormat::rgb8: return {3, 1};
    }
    return {};
}

std::vector<std::byte> filter(ElementFormat format, std::uint32_t width, std::uint32_t height,
                              std::span<const std::byte> raw) {
    const Layout layout = layout_of(format, width, height);
    switch (element_shape(format).component_size) {
    case 1: return filter_components<std::uint8_t>(layout, raw);
    case 2: return filter_components<std::uint16_t>(layout, raw);
    default: return filter_components<std::uint32_t>(layout, raw);
    }
}

std::vector<std::byte> unfilter(ElementFormat format, std::uint32_t width, std::uint32_t height,
                                std::span<const std::byte> filtered) {
    const Layout layout = layout_of(format, width, height);
    switch (element_shape(format).component_size) {
    case 1: return unfilter_components<std::uint8_t>(layout, filtered);
    case 2: return unfilter_components<std::uint16_t>(layout, filtered);
    default: return unfilter_components<std::uint32_t>(layout, filtered);
    }
}

std::vector<std::byte> compress(std::span<const std::byte> raw, int level) {
    std::vector<std::byte> out(ZSTD_compressBound(raw.size()));
    const std::size_t size = ZSTD_compress(out.data(), out.size(), raw.data(), raw.size(), level);
    // With a buffer of compressBound the only failure left is memory.
    if (ZSTD_isError(size) != 0) throw std::bad_alloc();
    out.resize(size);
    return out;
}

Issue decode_section(const SectionEntry& entry, std::span<const std::byte> stored,
                     std::vector<std::byte>& raw) {
    // Some builds of the library also read formats from before version 1.0, and skippable frames hold
    // nothing.
    if (stored.size() < sizeof(std::uint32_t) || load<std::uint32_t>(stored.data()) != ZSTD_MAGICNUMBER)
        return Issue::wrong_frame_size;
    if (ZSTD_getFrameContentSize(stored.data(), stored.size()) != entry.raw_length)
        return Issue::wrong_frame_size;
    const std::size_t frame_size = ZSTD_findFrameCompressedSize(stored.data(), stored.size());
    if (ZSTD_isError(frame_size) != 0) return Issue::compressed_data_damaged;
    if (frame_size != stored.size()) return Issue::wrong_frame_size;

    raw.resize(std::size_t(entry.raw_length));
    const std::size_t size = ZSTD_decompress(raw.data(), raw.size(), stored.data(), stored.size());
    if (ZSTD_isError(size) != 0 || size != raw.size()) return Issue::compressed_data_damaged;
    if (entry.scheme == Scheme::filtered_zstd) raw = unfilter(entry.format, entry.width, entry.height, raw);
    return Issue::none;
}

} // namespace spa::container
