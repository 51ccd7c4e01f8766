// SPDX-License-Identifier: Apache-2.0
// Some triangles of a model as a model of their own.
#pragma once

#include "model.h"

#include "../core/affine.h"

#include <cstdint>
#include <span>

namespace spa {

// The triangles in the order given, with the vertices, materials and textures that they use, in the order
// that they have in the whole. Without a texture there are no uvs. O(n log n) in the triangles given, or
// O(vertices of the whole) where those are fewer.
Model piece_model(const Model& whole, std::span<const std::uint32_t> triangles);

// Brings a model from the world into the local space of what stands at `to_world`, which has an inverse
// (affine.h). A mirrored transform turns the winding over, as the import did, so that front faces are front
// faces again. O(vertices + triangles).
void move_to_local(Model& model, const Affine& to_world);

} // namespace spa
