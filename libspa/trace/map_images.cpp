// SPDX-License-Identifier: Apache-2.0
#include "map_images.h"

#include "../../shaders/spa_map.h"
#include "../core/element_format.h"

#include <bit>
#include <cstring>

namespace spa::trace {
namespace {

static_assert(std::endian::native == std::endian::little, "words are copied from little-endian images");

std::uint32_t word(const std::byte* element) {
    std::uint32_t result = 0;
    std::memcpy(&result, element, sizeof result);
    return result;
}

// Whether a texel of a normal image has a normal. Its code does not tell: 0 is that of +Z too. A depth image
// of another size says nothing about single texels.
bool has_surface(const Surface& surface, std::uint32_t x, std::uint32_t y) {
    if (surface.depth.width != surface.normal.width || surface.depth.height != surface.normal.height)
        return true;
    return decode_depth(surface.depth.format, surface.depth.at(x, y)) > 0;
}

const Surface& surface_of(const Part& part, std::uint32_t number) {
    const Layer& layer = part.layers[number / 2];
    return number % 2 == 0 ? layer.outer : layer.inner;
}

std::size_t texels(const ImageView& image) { return std::size_t(image.width) * image.height; }

std::uint32_t normal_word(ElementFormat format, const std::byte* element) {
    if (format == ElementFormat::oct16) return word(element);
    const Vec3f normal = decode_normal(format, element);
    if (normal == Vec3f{}) return SPA_NO_NORMAL;
    std::byte code[4]{};
    encode_normal(ElementFormat::oct16, to_double(normal), code);
    return word(code);
}

void write_normals(const Surface& surface, std::span<std::uint32_t> words) {
    const ImageView& image = surface.normal;
    std::size_t at = 0;
    for (std::uint32_t y = 0; y < image.height; ++y)
        for (std::uint32_t x = 0; x < image.width; ++x)
            words[at++] =
                has_surface(surface, x, y) ? normal_word(image.format, image.at(x, y)) : SPA_NO_NORMAL;
}

} // namespace

std::size_t image_words(const Part& part, std::uint32_t surfaces) {
    std::size_t words = 0;
    for (std::uint32_t s = 0; s < surfaces; ++s)
        words += texels(surface_of(part, s).color) + texels(surface_of(part, s).normal);
    return words;
}

std::vector<std::uint32_t> write_images(const Part& part, std::uint32_t surfaces, std::uint32_t first,
                                        std::span<std::uint32_t> words) {
    std::vector<std::uint32_t> table;
    std::size_t at = 0;
    const auto enter = [&](const ImageView& image) {
        table.insert(table.end(), {first + std::uint32_t(at), image.width, image.height});
        const std::span<std::uint32_t> place = words.subspan(at, texels(image));
        at += place.size();
        return place;
    };
    for (std::uint32_t s = 0; s < surfaces; ++s) {
        const Surface& surface = surface_of(part, s);
        const std::span<std::uint32_t> colors = enter(surface.color);
        if (!colors.empty()) std::memcpy(colors.data(), surface.color.bytes.data(), colors.size_bytes());
        write_normals(surface, enter(surface.normal));
    }
    return table;
}

} // namespace spa::trace
