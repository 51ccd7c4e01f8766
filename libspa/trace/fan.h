// SPDX-License-Identifier: Apache-2.0
// The paper's intersection on the CPU: the text of ../../shaders/spa_fan.h, where its options are explained.
#pragma once

#include "ray.h"
#include "trace_map.h"

#include "../../shaders/spa_fan.h"

#include <cstdint>

namespace spa::trace {

// One ray in map space against the outermost surface; both mappings. flags: TraceFlags. Returns hit.valid().
// Never allocates or throws; any ray and any options may be given. Time: one
// stored depth a test ray.
bool fan_hit(const TraceMap& map, const Ray& ray, const shader::SpaFan& options, std::uint32_t flags,
             Hit& hit);

} // namespace spa::trace
