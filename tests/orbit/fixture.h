// SPDX-License-Identifier: Apache-2.0
// Contexts and short ways to cast, for the tests of the orbit baker.
#pragma once

#include "reference.h"

#include "../../libspa/bake/orbit.h"
#include "../../libspa/core/error.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <span>
#include <string>

namespace spa::test {

// Null, and the test skipped, where this machine or build lacks the API.
inline std::unique_ptr<bake::GlContext> open_context(bake::GlApi api = bake::GlApi::automatic) {
    try {
        return bake::make_gl_context(api);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unsupported);
        // CI installs both: there a missing one is a failure, not a reason to skip.
        EXPECT_EQ(std::getenv("SPA_REQUIRE_GL"), nullptr) << error.what();
        return nullptr;
    }
}

// A test that needs a context of the automatic kind.
class OrbitTest : public testing::Test {
protected:
    void SetUp() override {
        context = open_context();
        if (!context) GTEST_SKIP() << "no headless OpenGL here";
    }

    [[nodiscard]] bake::CrossingGrid cast(const bake::CenteredModel& model, const Grid& grid, bool layers,
                                          bool naive = false) const {
        bake::CastOptions options;
        options.outermost_only = !layers;
        return bake::cast_orbit(*context, model, grid, naive, options);
    }

    std::unique_ptr<bake::GlContext> context;
};

inline Grid octahedral(std::uint32_t cells) { return {Mapping::octahedral, cells + 1, cells + 1}; }
inline Grid latlong(std::uint32_t width, std::uint32_t height) { return {Mapping::latlong, width, height}; }

inline std::string name_of(const Grid& grid) {
    return std::string(name(grid.mapping)) + std::to_string(grid.width) + "x" + std::to_string(grid.height);
}

inline std::size_t sample_count(const Grid& grid) { return std::size_t(grid.width) * grid.height; }

inline Vec3d unit_direction(const Grid& grid, std::size_t sample) {
    return normalize(
        sample_direction(grid, {std::uint32_t(sample % grid.width), std::uint32_t(sample / grid.width)}));
}

inline bool equal(const bake::Crossing& a, const bake::Crossing& b) {
    return a.radius == b.radius && a.triangle == b.triangle && a.normal == b.normal && a.color == b.color &&
           a.front_facing == b.front_facing;
}

// Calls each(sample, its crossings as a span-like pair of pointers).
template <class Each>
void for_each_sample(const bake::CrossingGrid& grid, const Each& each) {
    for (std::size_t s = 0; s + 1 < grid.first.size(); ++s) {
        each(s, std::span(grid.crossings).subspan(grid.first[s], grid.first[s + 1] - grid.first[s]));
    }
}

} // namespace spa::test
