// SPDX-License-Identifier: Apache-2.0
#include "trace.h"

namespace spa::trace {

void closest_hits(const TraceMap& map, std::span<const Ray> rays, std::uint32_t flags, std::span<Hit> hits) {
    for (std::size_t i = 0; i < rays.size(); ++i) closest_hit(map, rays[i], flags, hits[i]);
}

void occluded(const TraceMap& map, std::span<const Ray> rays, std::uint32_t flags,
              std::span<std::uint8_t> blocked) {
    for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = occluded(map, rays[i], flags) ? 1 : 0;
}

const char* stream_target() { return "scalar"; }

} // namespace spa::trace
