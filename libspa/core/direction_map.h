// SPDX-License-Identifier: Apache-2.0
// Direction maps: which unit direction belongs to which texel. Everything about poles, seams and folds is
// in this one place.
//
// Axes are those of the part's frame, right-handed, +Y up and +Z to the front as in glTF. Row 0 is the top
// of the picture; both maps show the object upright and not mirrored, as seen from outside.
//
// latlong (the paper's): width x height texels, sampled at texel centres.
//   phi = 2 pi (x + 0.5)/width - pi, theta = pi (y + 0.5)/height,
//   u = (sin theta sin phi, cos theta, sin theta cos phi): the middle column is +Z, the top row +Y.
//
// octahedral (Engelhardt & Dachsbacher 2008; Cigolle et al. 2014): N cells a side, N even, sampled at the
// (N+1) x (N+1) cell corners ("vertices"), so width = height = N + 1.
//   s = 2 x/N - 1, t = 1 - 2 y/N, z = 1 - |s| - |t|;
//   z >= 0: g = (s, t, z), else g = ((1 - |t|) sign s, (1 - |s|) sign t, z); |g|_1 = 1; u = g/|g|.
//   The border is identified with itself: (s, 1) ~ (-s, 1), (s, -1) ~ (-s, -1), (1, t) ~ (1, -t),
//   (-1, t) ~ (-1, -t), and the four corners are one point (-Z). Identified vertices have bit-equal
//   directions here.
#pragma once

#include "vector.h"

#include <cstdint>

namespace spa {

// The numeric values are those of the file format.
enum class Mapping : std::uint32_t { latlong = 1, octahedral = 2 };

// "latlong" or "octahedral"; "unknown" for a value that is not a Mapping.
const char* name(Mapping mapping);

// The samples of one image. Octahedral: width = height = N + 1.
struct Grid {
    Mapping mapping = Mapping::octahedral;
    std::uint32_t width = 0, height = 0;
    friend constexpr bool operator==(const Grid&, const Grid&) = default;
};

// latlong: width, height >= 1; octahedral: width = height = N + 1 with N even and >= 2.
constexpr bool is_valid(const Grid& grid) {
    if (grid.mapping == Mapping::latlong) return grid.width >= 1 && grid.height >= 1;
    return grid.mapping == Mapping::octahedral && grid.width == grid.height && grid.width >= 3 &&
           grid.width % 2 == 1;
}

struct TexelIndex {
    std::uint32_t x = 0, y = 0;
    friend constexpr bool operator==(const TexelIndex&, const TexelIndex&) = default;
};

// Direction through a sample, not normalised: |g|_1 = 1 for octahedral maps, |g|_2 = 1 for latlong.
// Bit-equal for identified octahedral border vertices.
Vec3d sample_direction(const Grid& grid, TexelIndex texel);

// Unit direction at a fractional position; (x, y) = integers are the samples. Positions outside the map
// are not wrapped.
Vec3d direction_at(const Grid& grid, Vec2d position);

// The fractional position of a direction of any length > 0: the inverse of direction_at. latlong: x is in
// [-0.5, width - 0.5). The zero vector gives the position of +Z.
Vec2d position_of(const Grid& grid, Vec3d direction);

// The sample that an index up to one map size outside the map means: over the seam and the poles, or over
// the octahedral fold.
TexelIndex wrap(const Grid& grid, std::int64_t x, std::int64_t y);

// For each set of identified samples the one with the smallest row-major index; other samples: themselves.
TexelIndex canonical(const Grid& grid, TexelIndex texel);

// Solid angle in steradian that a sample stands for. Identified border samples share theirs, so the sum
// over all samples is close to 4 pi.
double solid_angle(const Grid& grid, TexelIndex texel);

} // namespace spa
