// SPDX-License-Identifier: Apache-2.0
// How far two pictures are apart.
#pragma once

#include "../../libspa/core/vector.h"

#include <cstddef>
#include <span>

namespace spa::test {

// Pixels where some channel differs by more than `share` of the larger value and more than `least`.
std::size_t differing(std::span<const Vec3f> a, std::span<const Vec3f> b, float share, float least = 1e-6F);

// Mean of all channels.
double mean(std::span<const Vec3f> picture);

// sqrt of the mean square of a - b, all channels.
double root_mean_square(std::span<const Vec3f> a, std::span<const Vec3f> b);

bool same_bits(std::span<const Vec3f> a, std::span<const Vec3f> b);

} // namespace spa::test
