// SPDX-License-Identifier: Apache-2.0
#include "map_images.h"

#include "../core/element_format.h"

#include <bit>
#include <cstring>

namespace spa::trace {
namespace {

static_assert(std::endian::native == std::endian::little, "words are copied from little-endian images");

std::uint32_t color_word(const std::byte* element) {
    std::uint32_t word = 0;
    std::memcpy(&word, element, sizeof word);
    return word;
}

void append_image(const ImageView& image, MapImages& images) {
    images.table.push_back(std::uint32_t(images.words.size()));
    images.table.push_back(image.empty() ? 0 : image.width);
    images.table.push_back(image.empty() ? 0 : image.height);
    if (image.empty()) return;
    const std::size_t count = std::size_t(image.width) * image.height;
    const std::size_t size = element_size(image.format);
    images.words.reserve(images.words.size() + count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::byte* const element = image.bytes.data() + i * size;
        if (image.format == ElementFormat::rgba8 || image.format == ElementFormat::oct16) {
            images.words.push_back(color_word(element));
        } else {
            std::byte code[4]{};
            encode_normal(ElementFormat::oct16, to_double(decode_normal(image.format, element)), code);
            images.words.push_back(color_word(code));
        }
    }
}

} // namespace

MapImages read_images(const Part& part, std::uint32_t surfaces) {
    MapImages images;
    for (std::uint32_t s = 0; s < surfaces; ++s) {
        const Layer& layer = part.layers[s / 2];
        const Surface& surface = s % 2 == 0 ? layer.outer : layer.inner;
        append_image(surface.color, images);
        append_image(surface.normal, images);
    }
    return images;
}

} // namespace spa::trace
