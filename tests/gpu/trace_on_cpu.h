// SPDX-License-Identifier: Apache-2.0
// shaders/trace_ray.h in C++: what the GPU's results are compared with.
#pragma once

#include "rays.h"

#include <cstdint>
#include <span>
#include <vector>

#define RAY_WORD(index) rays[index]
#define RESULT_WORD(index) results[index]
#define TRACE_BUFFERS const uint *rays, uint *results,
#include "shaders/trace_ray.h"

namespace spa::test {

// words.size() = rays.size() * RAY_WORDS.
void write_rays(std::span<const TestRay> rays, std::span<std::uint32_t> words);

// RESULT_WORDS a ray. method: METHOD_...
std::vector<std::uint32_t> trace_on_cpu(const shader::SpaMap& map, std::span<const std::uint32_t> ray_words,
                                        std::uint32_t method);

} // namespace spa::test
