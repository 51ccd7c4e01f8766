// SPDX-License-Identifier: Apache-2.0
// What the orbit baker draws into: one pixel a view, packed into one framebuffer, and the depth buffers that
// peel layers off.
#pragma once

#include "crossings.h"
#include "gl_objects.h"

#include <array>
#include <cstdint>
#include <vector>

namespace spa::bake {

// outermost: the crossing of largest radius. find: the largest radius below that of the round before, without
// its crossing. pick: the crossing of the first triangle at that radius.
enum class Stage : std::uint8_t { outermost, find, pick };
constexpr std::size_t stage_count = 3;

struct Fragment {
    std::uint32_t camera = 0;
    Crossing crossing;
};

class Tiles {
public:
    // peel: for find and pick, with two tiles a camera, one a facing; else for outermost alone.
    Tiles(const GlFunctions& gl, std::uint32_t cameras, bool peel);

    // Where the shaders find a camera's tiles: sets the uniforms of a program built from shaders/orbit.*.
    void set_layout(const GlObject& program) const;

    // Makes the tiles of a stage the target of what is drawn, empty. round counts from 0.
    void begin(Stage stage, std::uint32_t round) const;

    // Appends the crossings drawn since begin(outermost or pick), in the order of their tiles.
    void read(std::vector<Fragment>& fragments) const;

private:
    using Pixel = std::array<std::uint32_t, 4>;

    const GlFunctions& gl_;
    std::uint32_t cameras_ = 0, tiles_ = 0, width_ = 0, height_ = 0;
    GlObject surface_, normal_, depth_;
    std::array<GlObject, 2> radius_; // of this round and the one before, alternating
    GlObject result_;                // framebuffer of surface, normal and depth
    std::array<GlObject, 2> find_;   // framebuffers of radius alone
    GlObject sampler_;
};

} // namespace spa::bake
