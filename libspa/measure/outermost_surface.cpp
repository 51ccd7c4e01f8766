// SPDX-License-Identifier: Apache-2.0
#include "outermost_surface.h"

namespace spa::measure {

MapSurface outermost_surface(const Part& part) {
    const ImageView& depth = part.layers.front().outer.depth;
    std::vector<double> depths;
    for (std::uint32_t y = 0; y < depth.height; ++y)
        for (std::uint32_t x = 0; x < depth.width; ++x)
            depths.push_back(double(decode_depth(depth.format, depth.at(x, y))));
    MapSurface surface;
    append_surface({part.mapping, depth.width, depth.height}, depths, Mat3{}, surface);
    std::erase_if(surface.triangles, [](const Triangle& t) {
        return t.vertex[0] == t.vertex[1] || t.vertex[1] == t.vertex[2] || t.vertex[2] == t.vertex[0];
    });
    return surface;
}

} // namespace spa::measure
