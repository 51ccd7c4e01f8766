// SPDX-License-Identifier: Apache-2.0
// The outermost surface that a part stores, as triangles.
#pragma once

#include "map_surface.h"

#include "../core/spherical_map.h"

namespace spa::measure {

// In the part's frame, in units of its radius; triangles without area are left out. O(samples).
MapSurface outermost_surface(const Part& part);

} // namespace spa::measure
