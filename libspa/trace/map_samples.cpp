// SPDX-License-Identifier: Apache-2.0
#include "map_samples.h"

#include "../../shaders/spa_map.h"

#include "../core/element_format.h"

#include <algorithm>

namespace spa::trace {
namespace {

// Of samples: a depth of 1e-9 R, where single precision sees nothing; products of such numbers stay finite.
constexpr float most_w = 1e9F;

void read_depths(const ImageView& image, std::vector<float>& depths) {
    depths.resize(std::size_t(image.width) * image.height);
    const std::size_t size = element_size(image.format);
    for (std::size_t i = 0; i < depths.size(); ++i)
        depths[i] = decode_depth(image.format, image.bytes.data() + i * size);
}

} // namespace

const Surface* stored_surface(const Part& part, std::uint32_t surface) {
    const Layer& layer = part.layers[surface / 2];
    const Surface& found = surface % 2 == 0 ? layer.outer : layer.inner;
    return found.empty() ? nullptr : &found;
}

MapSamples read_samples(const Part& part, std::uint32_t layers) {
    MapSamples samples;
    const ImageView& depth = part.layers.front().outer.depth;
    samples.grid = {part.mapping, depth.width, depth.height};
    read_depths(depth, samples.depth);
    const auto stored = std::uint32_t(part.layers.size());
    const std::uint32_t kept = layers == 0 ? stored : std::min(layers, stored);
    samples.surfaces = kept == 1 && part.layers.front().inner.empty() ? 1 : 2 * kept;
    if (part.mapping != Mapping::octahedral) return samples;
    const std::size_t count = samples.count();
    std::vector<double> lengths(count);
    for (std::uint32_t y = 0; y < depth.height; ++y)
        for (std::uint32_t x = 0; x < depth.width; ++x)
            lengths[std::size_t(y) * depth.width + x] = length(sample_direction(samples.grid, {x, y}));
    samples.w.assign(samples.surfaces * count, SPA_FAR);
    std::vector<float> depths;
    for (std::uint32_t s = 0; s < samples.surfaces; ++s) {
        const Surface* const surface = stored_surface(part, s);
        if (surface == nullptr) continue;
        read_depths(surface->depth, depths);
        for (std::size_t i = 0; i < count; ++i)
            if (depths[i] > 0)
                samples.w[s * count + i] = std::min(float(lengths[i] / double(depths[i])), most_w);
    }
    return samples;
}

} // namespace spa::trace
