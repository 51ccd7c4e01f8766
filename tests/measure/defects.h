// SPDX-License-Identifier: Apache-2.0
// Maps with a known defect: baked, then changed by hand.
#pragma once

#include "../../libspa/bake/bake.h"
#include "../../samples/samples.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace spa::test {

inline bake::Options small_options() {
    bake::Options options;
    options.grid = options.color_grid = {Mapping::octahedral, 65, 65};
    return options;
}

inline Model sample_model(const std::string& name) {
    return samples::make_sample(name, samples::find_sample(name)->default_level);
}

inline bake::Result bake_sample(const std::string& name, const bake::Options& options) {
    return bake::bake_model(sample_model(name), options);
}

// The bytes of one texel, to be changed. image: one of the map's own.
inline std::byte* texel(bake::OwnedMap& map, const ImageView& image, TexelIndex at) {
    const auto owner = std::find_if(map.pixels.begin(), map.pixels.end(),
                                    [&](const auto& p) { return p.get() == image.bytes.data(); });
    return owner->get() + (std::size_t(at.y) * image.width + at.x) * element_size(image.format);
}

inline void move_depth(bake::OwnedMap& map, const ImageView& depth, TexelIndex at, int codes) {
    std::uint16_t code = 0;
    std::memcpy(&code, texel(map, depth, at), 2);
    code = std::uint16_t(code + codes);
    std::memcpy(texel(map, depth, at), &code, 2);
}

inline void clear_depth(bake::OwnedMap& map, const ImageView& depth, TexelIndex at) {
    std::memset(texel(map, depth, at), 0, 2);
}

// Adds to green, or takes away where that would overflow.
inline void add_to_color(bake::OwnedMap& map, const ImageView& color, TexelIndex at, int codes) {
    std::byte* const green = texel(map, color, at) + 1;
    const int value = std::to_integer<int>(*green);
    *green = std::byte(value + codes <= 255 ? value + codes : value - codes);
}

} // namespace spa::test
