// SPDX-License-Identifier: Apache-2.0
// The pyramid of nodes only saves work: a trace that looks into every cell of the ray's way gives the same.
#include "fold_maps.h"
#include "ray_classes.h"

#include "../../libspa/trace/convert.h"
#include "../../libspa/trace/trace_map.h"
#include "../../shaders/spa_projective.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace spa::test {
namespace {

// The words of a trace image in which no node says that there is nothing below it, from outside or from
// inside.
std::vector<std::uint32_t> without_pyramid(const trace::TraceMap& map) {
    std::vector<std::uint32_t> words(map.words().begin(), map.words().end());
    const shader::SpaMap& m = map.map();
    const std::uint32_t end = m.cores != 0 ? m.cores : m.samples;
    const bool ranges = (m.flags & SPA_MAP_TWO_RANGES) != 0;
    for (std::uint32_t i = m.nodes; i < end; ++i) words[i] = ranges ? 0xFFFF0000U : 0; // all w
    words[SPA_HEADER_CORES] = 0;
    return words;
}

void compare(NamedPart named) {
    SCOPED_TRACE(named.name);
    const trace::TraceMap map(named.owned.part);
    const std::vector<std::uint32_t> words = without_pyramid(map);
    const shader::SpaMap exhaustive = shader::spa_open(shader::SpaWords{words.data()});
    RayMaker rays(named.owned.part, 3);
    unsigned hits = 0;
    for (unsigned kind = 0; kind < ray_class_count; ++kind) {
        for (unsigned i = 0; i < 150; ++i) {
            const shader::SpaRay ray = trace::to_shader(rays.make(RayClass(kind)));
            const std::uint32_t flags = rays.flags();
            shader::SpaHit a = shader::spa_no_hit();
            shader::SpaHit b = shader::spa_no_hit();
            const bool hit = shader::spa_trace_projective(map.map(), ray, flags, a);
            ASSERT_EQ(hit, shader::spa_trace_projective(exhaustive, ray, flags, b)) << name(RayClass(kind));
            if (!hit) continue;
            ++hits;
            // Where a ray comes into a cell is rounded otherwise after a larger step.
            const float length = std::sqrt(shader::dot(ray.direction, ray.direction));
            ASSERT_NEAR(a.t, b.t, 1e-5F * (1 / length + std::abs(b.t))) << name(RayClass(kind));
            ASSERT_EQ(a.front, b.front);
        }
    }
    EXPECT_GT(hits, 200U);
}

TEST(Exhaustive, HandMadeFolds) {
    for (NamedPart& part : made_fold_parts()) compare(std::move(part));
}
TEST(Exhaustive, RandomFolds) {
    for (NamedPart& part : random_fold_parts()) compare(std::move(part));
}
TEST(Exhaustive, BakedFolds) {
    for (NamedPart& part : baked_fold_parts()) compare(std::move(part));
}

} // namespace
} // namespace spa::test
