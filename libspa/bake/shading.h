// SPDX-License-Identifier: Apache-2.0
// What a surface looks like at a point: texture filtering, alpha and the interpolated normal, on the CPU.
#pragma once

#include "crossings.h"

#include "../core/element_format.h"

#include <array>

namespace spa::bake {

struct SurfaceColor {
    std::array<std::uint8_t, 4> srgba{}; // as in Crossing::color
    bool visible = true;                 // false: masked out or fully transparent, no surface here
};

// Shades points of one model. Immutable; one serves all threads. Refers to the model.
class Shader {
public:
    explicit Shader(const CenteredModel& model);

    // True if some point of the triangle may be invisible, so that its colour must be known to know whether
    // it is crossed at all.
    [[nodiscard]] bool needs_alpha(std::uint32_t triangle) const;

    // barycentric: weights of the triangle's corners, sum 1. footprint: area that the sample stands for in
    // the triangle's plane, in normalised space (see crossings.h for both rules).
    [[nodiscard]] SurfaceColor color(std::uint32_t triangle, Vec3d barycentric, double footprint) const;

    // The interpolated vertex normal; where that vanishes the plane's normal.
    [[nodiscard]] Vec3f normal(std::uint32_t triangle, Vec3d barycentric) const;

private:
    [[nodiscard]] Vec4f sample(const Material& material, std::uint32_t triangle, Vec3d barycentric,
                               double footprint) const;

    const CenteredModel* centered_;
    std::array<float, 256> linear_{}; // sRGB code -> linear
    SrgbEncoder srgb_;
};

} // namespace spa::bake
