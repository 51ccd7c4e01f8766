// SPDX-License-Identifier: Apache-2.0
// Linear steps and secants on the CPU: the text of ../../shaders/spa_march.h.
#pragma once

#include "ray.h"
#include "trace_map.h"

#include "../../shaders/spa_march.h"

#include <cstdint>

namespace spa::trace {

// One ray in map space against the outermost surface; both mappings. flags: TraceFlags. Returns hit.valid().
// Never allocates or throws; any ray and any options may be given. Time: four
// stored depths a step.
bool march_hit(const TraceMap& map, const Ray& ray, const shader::SpaMarch& options, std::uint32_t flags,
               Hit& hit);

} // namespace spa::trace
