// SPDX-License-Identifier: Apache-2.0
// Parts to trace: made from a function of the sample, at random, or baked.
#pragma once

#include "../../libspa/core/spherical_map.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace spa::test {

// A part and the bytes of its images. Movable; the views stay valid.
struct OwnedPart {
    Part part;
    std::vector<std::unique_ptr<std::byte[]>> pixels;
};

struct MadeInterval {
    double outer = 0, inner = 0; // r/R; inner 0: reaches the centre
    Vec3d outer_normal, inner_normal;
};

struct MadePart {
    std::uint32_t cells = 8; // N
    std::uint32_t layers = 1;
    ElementFormat depth = ElementFormat::f32;
    ElementFormat normal = ElementFormat::oct16;
    bool inner_normals = true;
    double mixed_share = 0; // of triangles marked as mixed
    bool center_inside = false;
    std::uint32_t seed = 1;
};

// What stands in the direction of a sample, |g|_1 = 1, from outside in; asked once for samples that are the
// same point. Depths are rounded to codes so that the intervals stay in order.
using MakeIntervals = std::function<std::vector<MadeInterval>(Vec3d g)>;

OwnedPart make_part(const MadePart& made, const MakeIntervals& intervals);

// Depths, holes, ends, normals and mixed triangles at random.
OwnedPart random_part(const MadePart& made);

// Samples of libspa/samples by name, baked from the centre of their bounds.
struct BakedPart {
    std::string_view sample;
    int level = 2;
    std::uint32_t cells = 32;
    std::uint32_t layers = 1;
    ElementFormat depth = ElementFormat::u16;
    Mapping mapping = Mapping::octahedral; // latlong: 2 cells x cells
};
OwnedPart baked_part(const BakedPart& baked);

struct NamedPart {
    std::string name;
    OwnedPart owned;
};

// The maps of the attack: smooth, sharp, open, layered, random; every depth code; the smallest grid, sizes
// that are no powers of two; folds of every kind (fold_maps.h).
std::vector<NamedPart> attacked_parts();

} // namespace spa::test
