// SPDX-License-Identifier: Apache-2.0
// From stored surfaces to the images of a part and what is stored beside them.
#pragma once

#include "bake.h"
#include "intervals.h"

#include "../core/folds.h"

namespace spa::bake {

// Fills part.layers from surfaces over the depth grid (`shape`) and over the colour grid's sub-texel samples
// (`color`, the same number of surfaces). Layers without any outer surface and inner sides without any inner
// surface are left out; layer 0 always exists. Colours are dilated by color_dilation texels. All bytes go to
// `map.pixels`.
constexpr unsigned color_dilation = 8;
void pack_layers(const SurfaceGrid& shape, const SurfaceGrid& color, const Options& options, Part& part,
                 OwnedMap& map);

// Fills part.mixed with these bits (mixed.h).
void pack_mixed(const std::vector<std::byte>& mixed, Part& part, OwnedMap& map);

// Fills part.folds with these records; none of them: it stays empty.
void pack_folds(const std::vector<FoldRecord>& records, Part& part, OwnedMap& map);

// Share of the sphere's directions, by solid angle, at which a surface has a point.
double coverage(const std::vector<SurfacePoint>& surface, const Grid& grid);

} // namespace spa::bake
