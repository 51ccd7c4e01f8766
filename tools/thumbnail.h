// SPDX-License-Identifier: Apache-2.0
// A small picture of the object that a map stands for, for lists of many maps.
#pragma once

#include "picture.h"

#include "../libspa/core/spherical_map.h"

#include <cstdint>

namespace spa::tools {

// What is around the object: of middle lightness, so that light and dark objects stand out from it, and it
// from light and dark pages.
inline constexpr Rgb thumbnail_background{0x6b, 0x72, 0x7c};

// All parts of the map from the front (+Z), a little from the right (+X) and above (+Y), in perspective, as
// large as fits. Colours of the map, lit from over the viewer's left shoulder; four rays a pixel. Maps with
// more samples than such a picture shows are looked at in a coarser copy, and so are latlong ones. A map
// without any surface: the background alone.
//
// The map must have passed the container's checks. Same map and size, same picture. One thread; O(samples +
// size^2): of a 256-cell map about 20 ms and 6 KiB as PNG for 96 pixels, 8 ms and 3 KiB for 64.
// size: of a side, >= 1.
Picture thumbnail(const SphericalMap& map, std::uint32_t size);

} // namespace spa::tools
