// SPDX-License-Identifier: Apache-2.0
// Rays against one map. All of it in map space: the part's frame, the centre at the origin, in units of R
// (space.h brings rays there). Nothing here allocates or throws; any ray may be given.
#pragma once

#include "ray.h"
#include "trace_map.h"

#include <cstdint>
#include <span>

namespace spa::trace {

// One ray, by the text that GPUs run (../../shaders/spa_projective.h). octahedral maps only: on others every
// ray misses. Returns hit.valid(). flags: TraceFlags.
bool closest_hit(const TraceMap& map, const Ray& ray, std::uint32_t flags, Hit& hit);

// Whether anything is hit. flags as above.
bool occluded(const TraceMap& map, const Ray& ray, std::uint32_t flags);

// Many rays at once, by SIMD across rays: the same answers as closest_hit to the bit, several times as fast.
// hits.size() = rays.size(). One thread; no order of the rays is needed.
void closest_hits(const TraceMap& map, std::span<const Ray> rays, std::uint32_t flags, std::span<Hit> hits);

// The same for occlusion: blocked[i] = 1 where ray i hits something, else 0.
void occluded(const TraceMap& map, std::span<const Ray> rays, std::uint32_t flags,
              std::span<std::uint8_t> blocked);

// The instruction set that closest_hits uses on this processor, such as "AVX3".
const char* stream_target();

} // namespace spa::trace
