// SPDX-License-Identifier: Apache-2.0
#include "codec.h"

#include "little_endian.h"

#include <new>

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

// The samples of one component: sample i is at values[i].
template <class T>
struct Plane {
    std::vector<T> values;
    std::size_t width = 0;

    // left + above - above left, modulo 2^bits; what is outside counts as 0.
    [[nodiscard]] T prediction(std::size_t i) const {
        const bool has_left = i % width > 0;
        const bool has_above = i >= width;
        const T left = has_left ? values[i - 1] : T(0);
        const T above = has_above ? values[i - width] : T(0);
        const T corner = has_left && has_above ? values[i - width - 1] : T(0);
        return T(left + above - corner);
    }
};

struct Layout {
    std::size_t width = 0, samples = 0, components = 0;
};

// Component c, byte b of sample i is at raw[(i * components + c) * sizeof(T) + b] and at
// filtered[(c * sizeof(T) + b) * samples + i].
template <class T>
std::vector<std::byte> filter_components(const Layout& layout, std::span<const std::byte> raw) {
    std::vector<std::byte> out(raw.size());
    Plane<T> plane{std::vector<T>(layout.samples), layout.width};
    for (std::size_t c = 0; c < layout.components; ++c) {
        std::byte* const planes = out.data() + c * sizeof(T) * layout.samples;
        for (std::size_t i = 0; i < layout.samples; ++i) {
            plane.values[i] = load<T>(raw.data() + (i * layout.components + c) * sizeof(T));
            const T code = zigzag(T(plane.values[i] - plane.prediction(i)));
            for (std::size_t b = 0; b < sizeof(T); ++b)
                planes[b * layout.samples + i] = std::byte((code >> (8 * b)) & 0xFFU);
        }
    }
    return out;
}

template <class T>
std::vector<std::byte> unfilter_components(const Layout& layout, std::span<const std::byte> filtered) {
    std::vector<std::byte> out(filtered.size());
    Plane<T> plane{std::vector<T>(layout.samples), layout.width};
    for (std::size_t c = 0; c < layout.components; ++c) {
        const std::byte* const planes = filtered.data() + c * sizeof(T) * layout.samples;
        for (std::size_t i = 0; i < layout.samples; ++i) {
            T code = 0;
            for (std::size_t b = 0; b < sizeof(T); ++b)
                code = T(code | T(std::to_integer<T>(planes[b * layout.samples + i]) << (8 * b)));
            plane.values[i] = T(unzigzag(code) + plane.prediction(i));
            store(out.data() + (i * layout.components + c) * sizeof(T), plane.values[i]);
        }
    }
    return out;
}

Layout layout_of(ElementFormat format, std::uint32_t width, std::uint32_t height) {
    return {width, std::size_t(width) * height, element_shape(format).components};
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
