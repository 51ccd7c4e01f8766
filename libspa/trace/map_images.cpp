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

void append_table(const ImageView& image, MapImages& images) {
    images.table.push_back(std::uint32_t(images.words.size()));
    images.table.push_back(image.empty() ? 0 : image.width);
    images.table.push_back(image.empty() ? 0 : image.height);
    images.words.reserve(images.words.size() + std::size_t(image.width) * image.height);
}

void append_colors(const ImageView& image, MapImages& images) {
    append_table(image, images);
    for (std::uint32_t y = 0; y < image.height; ++y)
        for (std::uint32_t x = 0; x < image.width; ++x) images.words.push_back(word(image.at(x, y)));
}

std::uint32_t normal_word(ElementFormat format, const std::byte* element) {
    if (format == ElementFormat::oct16) return word(element);
    const Vec3f normal = decode_normal(format, element);
    if (normal == Vec3f{}) return SPA_NO_NORMAL;
    std::byte code[4]{};
    encode_normal(ElementFormat::oct16, to_double(normal), code);
    return word(code);
}

void append_normals(const Surface& surface, MapImages& images) {
    const ImageView& image = surface.normal;
    append_table(image, images);
    for (std::uint32_t y = 0; y < image.height; ++y)
        for (std::uint32_t x = 0; x < image.width; ++x)
            images.words.push_back(has_surface(surface, x, y) ? normal_word(image.format, image.at(x, y))
                                                              : SPA_NO_NORMAL);
}

} // namespace

MapImages read_images(const Part& part, std::uint32_t surfaces) {
    MapImages images;
    for (std::uint32_t s = 0; s < surfaces; ++s) {
        const Layer& layer = part.layers[s / 2];
        const Surface& surface = s % 2 == 0 ? layer.outer : layer.inner;
        append_colors(surface.color, images);
        append_normals(surface, images);
    }
    return images;
}

} // namespace spa::trace
