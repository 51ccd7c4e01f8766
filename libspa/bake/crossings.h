// SPDX-License-Identifier: Apache-2.0
// What a baker measures, before anything is packed into layers: where the line from the centre through each
// sample's direction crosses the surface. Both bakers deliver exactly this; everything after it is shared.
//
// Bakers work in normalised space: the part's frame divided by its radius, so that the bounding sphere is the
// unit sphere at the origin and a distance is already r/R.
#pragma once

#include "../core/direction_map.h"
#include "../mesh/model.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace spa::bake {

// The model seen from the centre of a part. `model` outlives it.
struct CenteredModel {
    const Model* model = nullptr;
    std::vector<Vec3f> positions; // normalised space, one a vertex, |p| <= 1, multiples of 2^-24
    std::vector<Vec3f> normals;   // unit, frame space, one a vertex
    // The frame turns front faces into back faces (its determinant is negative): swap two corners.
    bool mirrored = false;
};

struct Crossing {
    float radius = 0;           // r/R in (0, 1]
    std::uint32_t triangle = 0; // index into Model::triangles
    Vec3f normal; // interpolated vertex normal, unit, never flipped: on the triangle's front, so
                  // towards the sphere if front_facing, towards the centre if not
    std::array<std::uint8_t, 4> color{}; // sRGB, straight alpha: material alpha (mask and opaque: 255)
    bool front_facing = true; // the triangle's front faces the sphere: coming from outside, the ray enters
};

// Crossings of sample i (row-major): crossings[first[i]] .. crossings[first[i + 1]), outermost first.
struct CrossingGrid {
    Grid grid;
    std::vector<std::uint64_t> first; // samples + 1
    std::vector<Crossing> crossings;
};

// Called now and then with the share done in [0,1]; returns false to cancel, which makes the bake throw
// Cancelled. Called from one thread at a time.
using Progress = std::function<bool(double)>;
struct Cancelled {};

struct CastOptions {
    bool outermost_only = true; // at most one crossing a sample, of either facing
    unsigned threads = 0;       // 0 = all cores
    Progress progress{};        // may be empty
};

// Rules all casters follow, so that they agree:
// - A crossing is where the ray from the origin along sample_direction meets a triangle, edges and corners
//   included, borders of open surfaces too. Whether it does, and where, follows from the edge functions in
//   sample_rays.h, in double precision without contraction: positions are floats, so ties are rare rays that
//   models and grids of simple fractions meet all the time, and the sign of a rounded zero must not decide.
//   Nothing is culled: a ray tracer needs the geometry whatever its winding.
// - AlphaMode::mask: no crossing where alpha < alpha_cutoff. AlphaMode::blend: none where the 8-bit alpha
//   rounds to 0. Alpha = base_color * vertex colour * texture, filtered as the colour.
// - Texture level of detail: log2 of the texels (of level 0) along the side of a square of area
//   footprint / triangle area * triangle area in texels, with footprint = solid_angle(sample) * radius^2 /
//   max(cos, 0.05), cos between the direction and the triangle's plane normal, all in normalised space; areas
//   per triangle. <= 0 is magnification: bilinear (nearest if the material says so); else trilinear.
// - Two crossings of one sample with the same facing whose radii differ by less than 1e-6 are one: the line
//   met a shared edge or a duplicate face. The smallest triangle index wins.
// - Equal radii at outermost_only: the smallest triangle index wins.
constexpr float merge_distance = 1e-6F;

} // namespace spa::bake
