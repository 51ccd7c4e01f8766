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

struct Fragment {
    std::uint32_t camera = 0;
    Crossing crossing;
};

class Tiles {
public:
    // both_facings: two tiles a camera, one for front-facing and one for back-facing triangles.
    Tiles(const GlFunctions& gl, std::uint32_t cameras, bool both_facings);

    // Makes the empty tiles the target of a program built from shaders/orbit.*. round counts from 0; later
    // rounds draw only what lies below the crossings of the round before.
    void begin(const GlObject& program, std::uint32_t round) const;

    // Appends the crossings drawn since begin, in the order of their tiles.
    void read(std::vector<Fragment>& fragments) const;

private:
    using Pixel = std::array<std::uint32_t, 4>;

    const GlFunctions& gl_;
    std::uint32_t cameras_ = 0, tiles_ = 0, width_ = 0, height_ = 0;
    GlObject surface_, normal_;
    std::array<GlObject, 2> radius_; // depth buffers of this round and the one before, alternating
    std::array<GlObject, 2> target_; // framebuffers of surface_, normal_ and one of radius_
    GlObject sampler_;
};

} // namespace spa::bake
