// SPDX-License-Identifier: Apache-2.0
#include "coarse_part.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace spa::tools {

namespace {

class Coarsener {
public:
    Coarsener(Mapping mapping, std::uint32_t cells) : mapping_(mapping), cells_(cells) {}

    // Replaces `image`; its pixels go to `pixels`. Returns whether it had to.
    bool coarsen(ImageView& image, std::vector<std::vector<std::byte>>& pixels) {
        if (image.empty() || fits(image)) return false;
        const std::size_t size = element_size(image.format);
        const std::vector<std::size_t>& sources = nearest(image);
        std::vector<std::byte>& bytes = pixels.emplace_back(sources.size() * size);
        auto out = bytes.begin();
        for (const std::size_t source : sources)
            out = std::copy_n(image.bytes.begin() + std::ptrdiff_t(source * size), size, out);
        image = {bytes, cells_ + 1, cells_ + 1, image.format};
        return true;
    }

private:
    [[nodiscard]] bool fits(const ImageView& image) const {
        return mapping_ == Mapping::octahedral && image.width <= cells_ + 1;
    }

    // For every sample of the result that of an image of this size; the images of a part mostly have one
    // size.
    const std::vector<std::size_t>& nearest(const ImageView& image) {
        std::vector<std::size_t>& sources = nearest_[{image.width, image.height}];
        if (!sources.empty()) return sources;
        const Grid from{mapping_, image.width, image.height};
        const Grid to{Mapping::octahedral, cells_ + 1, cells_ + 1};
        sources.reserve(std::size_t(to.width) * to.height);
        for (std::uint32_t y = 0; y < to.height; ++y)
            for (std::uint32_t x = 0; x < to.width; ++x) {
                const Vec2d position = position_of(from, sample_direction(to, {x, y}));
                const TexelIndex texel = wrap(from, std::llround(position.x), std::llround(position.y));
                sources.push_back(std::size_t(texel.y) * from.width + texel.x);
            }
        return sources;
    }

    Mapping mapping_;
    std::uint32_t cells_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> nearest_;
};

} // namespace

CoarsePart coarse_part(const Part& part, std::uint32_t cells) {
    CoarsePart coarse{part, {}};
    Coarsener coarsener(part.mapping, cells);
    for (Layer& layer : coarse.part.layers)
        for (Surface* surface : {&layer.outer, &layer.inner}) {
            coarsener.coarsen(surface->color, coarse.pixels);
            coarsener.coarsen(surface->normal, coarse.pixels);
            if (coarsener.coarsen(surface->depth, coarse.pixels)) coarse.part.mixed = coarse.part.folds = {};
        }
    coarse.part.mapping = Mapping::octahedral;
    return coarse;
}

} // namespace spa::tools
