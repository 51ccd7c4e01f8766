// SPDX-License-Identifier: Apache-2.0
// Which triangles between samples must not be interpolated over. Source: ../../docs/baking.md, "Mixed
// triangles".
#pragma once

#include "surface_end.h"

#include <cstddef>
#include <vector>

namespace spa::bake {

// One byte an edge of an octahedral grid, by its number (../core/folds.h): 1 where the samples at its ends
// have the same number of intervals, the same of these reach the centre, and each end of an interval matches
// that of the other sample (ends_match). From exact depths, not their codes. O(samples). Deterministic;
// parallel over rows in the caller's arena.
std::vector<std::uint8_t> match_edges(const SurfaceGrid& surfaces, const FaceNormal& face_normal);

// One bit a triangle of a grid of N cells a side, 1 = mixed, in the layout of ../core/cell_triangles.h: a
// triangle is pure if all its edges match. O(samples).
std::vector<std::byte> mixed_triangles(std::uint32_t cells, const std::vector<std::uint8_t>& matching_edges);

// The two in one.
std::vector<std::byte> mixed_triangles(const SurfaceGrid& surfaces, const FaceNormal& face_normal);

} // namespace spa::bake
