// SPDX-License-Identifier: Apache-2.0
// Rays as renderers shoot them at an object, made by code: for measuring tracers. The object is in normalised
// space: its centre at the origin, its bounding sphere the unit sphere.
#pragma once

#include "../core/vector.h"
#include "../mesh/model.h"
#include "../trace/ray.h"

#include <cstdint>
#include <span>
#include <vector>

namespace spa::measure {

enum class RaySet : std::uint8_t {
    primary, // coherent: a camera 3 R from the centre whose square image frames the sphere, in rows
    bounce, // diffuse bounces: from points of the walls of a room, a cube of edge 3 R around the centre, with
            // the density of a cosine about the wall's normal
    chords, // incoherent: through two independent points of the sphere; starts on it
    shadow, // from points of a floor below the sphere, a disc of radius 2.5 R, to points of a lamp, a square
            // of edge 1 R beside and above: t_max = 1 is the lamp; only hit or miss matters
    leaving, // from points 0.01 to 0.1 R off the object's own surface, as surfaces close to it would be, in
             // all directions evenly: origins inside the sphere, and where the object is concave inside it
};

// All of them, in this order.
std::span<const RaySet> ray_sets();
// "primary", ...
const char* name(RaySet set);

// Whether only hit or miss is asked of the set.
constexpr bool asks_occlusion(RaySet set) { return set == RaySet::shadow; }

// `count` rays with directions of unit length (shadow: of the distance to the lamp). The same arguments give
// the same rays everywhere; other seeds give others. positions, triangles: of the object, in normalised
// space; only `leaving` reads them, and gives no rays for an object without area. O(count + triangles).
std::vector<trace::Ray> make_rays(RaySet set, std::uint32_t count, std::uint64_t seed,
                                  std::span<const Vec3f> positions, std::span<const Triangle> triangles);

} // namespace spa::measure
