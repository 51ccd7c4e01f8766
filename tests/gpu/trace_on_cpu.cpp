// SPDX-License-Identifier: Apache-2.0
#include "trace_on_cpu.h"

#include <algorithm>
#include <array>
#include <bit>

namespace spa::test {

void write_rays(std::span<const TestRay> rays, std::span<std::uint32_t> words) {
    auto out = words.begin();
    for (const TestRay& test : rays) {
        const shader::SpaRay& ray = test.ray;
        for (const float value : {ray.origin.x, ray.origin.y, ray.origin.z, ray.t_min, ray.direction.x,
                                  ray.direction.y, ray.direction.z, ray.t_max})
            *out++ = std::bit_cast<std::uint32_t>(value);
        *out++ = test.flags;
        *out++ = test.options;
    }
}

std::vector<std::uint32_t> trace_on_cpu(const shader::SpaMap& map, std::span<const std::uint32_t> ray_words,
                                        std::uint32_t method) {
    const auto count = std::uint32_t(ray_words.size() / RAY_WORDS);
    std::vector<std::uint32_t> results(std::size_t(count) * RESULT_WORDS);
    for (std::uint32_t i = 0; i < count; ++i)
        shader::trace_ray(ray_words.data(), results.data(), map, i, method);
    return results;
}

} // namespace spa::test
