// SPDX-License-Identifier: Apache-2.0
// The star envelope: what a map would hold if it had all the texels and bits one could wish for.
#pragma once

#include "../bake/bake.h"
#include "../core/spherical_map.h"
#include "../mesh/model.h"

#include <cstdint>

namespace spa::measure {

// A map by the definition of `part` - its centre, its frame, its layers or `layers` if that is more, one
// layer without inner surfaces being solid to the centre - but octahedral, of `cells` cells a side, with
// depths of 32 bits, exact crossings and neither colours nor normals of another size. radius: as part.radius
// should be, from which the stored one may differ. Bakes in the caller's TBB arena; O(triangles + cells^2).
// Throws as bake_model does, and bake::Cancelled.
bake::OwnedMap star_map(const Model& model, const Part& part, double radius, std::uint32_t layers,
                        std::uint32_t cells, unsigned threads, const bake::Progress& progress);

} // namespace spa::measure
