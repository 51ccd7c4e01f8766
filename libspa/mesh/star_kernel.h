// SPDX-License-Identifier: Apache-2.0
// The star kernel of a mesh: the points behind the planes of all its faces. From one of them every line meets
// a closed surface once, so a spherical map around it holds all of the surface in one layer.
#pragma once

#include "model.h"

#include "../core/vector.h"

#include <cstdint>
#include <optional>
#include <span>

namespace spa {

struct StarKernel {
    double depth = 0; // radius of the largest ball in the kernel
    Vec3d point;      // of the points at least half as deep as that, the nearest to where was asked
};

// Nothing if the kernel is empty or thinner than 1e-6 of the model's radius, which is what the rounding of
// positions does to a plane.
//
// The largest ball is a linear program of four variables, the point a quadratic one of three; both are unique
// but for rounding, so the order of triangles does not matter. Few planes decide them: a program of some is
// solved, then the planes that its answer breaks most are added, until none is broken. Sampled planes come
// first, which is where most models end that have no kernel. O(triangles) for each of a few rounds; parallel
// in the caller's arena, the same result for any number of threads.
//
// turned: of Components, or empty; faces so marked count as wound the other way. A model all of whose faces
// point inwards has the kernel of the one with all of them turned. Triangles that are thinner than 1e-5 of
// the model's radius are left out: their planes say nothing. Duplicates change nothing. On open meshes a
// point of the kernel still has every face before it, but two of them may lie one behind the other.
std::optional<StarKernel> star_kernel(const Model& model, Vec3d near,
                                      std::span<const std::uint8_t> turned = {});

} // namespace spa
