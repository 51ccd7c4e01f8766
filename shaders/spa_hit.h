// SPDX-License-Identifier: Apache-2.0
// What the stages of Vulkan's and D3D12's ray tracing tell each other about a hit: the flags of a shader
// record, a hit kind of 7 bits, and holes. One text for C++, GLSL and HLSL.
//
// Holes are places that the map stores as not, or hardly, covered (SpaShade::coverage). Whoever wants to see
// through them sets SPA_RECORD_COVERAGE in the record and leaves the geometry non-opaque. The intersection
// stage then marks hits in holes, the any-hit stage refuses them, and the intersection stage goes on behind:
//
//   for (uint n = 0u; n < SPA_MAX_HOLES; n += 1u) {
//       if (!<trace>(map, ray, record.flags & SPA_RECORD_TRACE, hit)) return;
//       bool hole = spa_in_hole(map, hit, record.flags, threshold);
//       if (<report>(hit.t, spa_hit_kind(hit, hole)) || !hole) return;
//       ray.t_min = spa_behind(ray, hit.t);
//   }
#ifndef SPA_HIT_H
#define SPA_HIT_H

#include "spa_shade.h"

SPA_BEGIN

// Flags of a shader record: SPA_CULL_BACK and SPA_CULL_FRONT of spa_map.h, which a trace takes, and
#define SPA_RECORD_TRACE 3u    // the two
#define SPA_RECORD_COVERAGE 8u // hits in holes are marked, and refused by the any-hit stage

// Below this coverage is a hole, where an application does not say otherwise.
#define SPA_HOLE_THRESHOLD 0.5f
// So many holes one behind the other are passed, then the ray misses.
#define SPA_MAX_HOLES 64u

// A hit kind: side (SPA_OUTER, SPA_INNER, SPA_WALL), then one bit for hits from outside the solid, the layer
// up to 7, and one bit for holes. APIs leave 7 bits to procedural geometry.
#define SPA_KIND_SIDE 3u
#define SPA_KIND_FRONT 4u
#define SPA_KIND_LAYER_SHIFT 3u
#define SPA_KIND_LAYER 7u // after the shift; also what stands for any layer from the eighth on
#define SPA_KIND_HOLE 64u

SPA_FUNCTION uint spa_hit_kind(SpaHit hit, bool hole) {
    uint kind = hit.side | (min(hit.layer, SPA_KIND_LAYER) << SPA_KIND_LAYER_SHIFT);
    if (hit.front != 0u) kind |= SPA_KIND_FRONT;
    if (hole) kind |= SPA_KIND_HOLE;
    return kind;
}
SPA_FUNCTION uint spa_kind_side(uint kind) { return kind & SPA_KIND_SIDE; }
SPA_FUNCTION bool spa_kind_front(uint kind) { return (kind & SPA_KIND_FRONT) != 0u; }
SPA_FUNCTION uint spa_kind_layer(uint kind) { return (kind >> SPA_KIND_LAYER_SHIFT) & SPA_KIND_LAYER; }
SPA_FUNCTION bool spa_kind_hole(uint kind) { return (kind & SPA_KIND_HOLE) != 0u; }

// Whether a hit is in a hole, if that is asked for. hit: with its record, not of a trace with SPA_ANY_HIT.
SPA_FUNCTION bool spa_in_hole(SPA_IN(SpaMap) map, SpaHit hit, uint record_flags, float threshold) {
    if ((record_flags & SPA_RECORD_COVERAGE) == 0u) return false;
    SpaShade shade = spa_shade(map, hit);
    return shade.coverage < threshold;
}

// From where a ray goes on behind a hit at t: more than rounding behind it, of t and of places in the unit
// ball.
SPA_FUNCTION float spa_behind(SPA_IN(SpaRay) ray, float t) {
    return t + (abs(t) + 1.0f / sqrt(dot(ray.direction, ray.direction))) * 1e-6f;
}

SPA_END

#endif
