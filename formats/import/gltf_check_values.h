// SPDX-License-Identifier: Apache-2.0
// Defects of the data itself that do no harm to the picture, or that only animations have: warnings.
#pragma once

#include "gltf_accessor.h"
#include "gltf_schema.h"

namespace spa::import::gltf {

// Warns of accessors whose min and max are not those of their elements. Linear in the data of the accessors
// that have them.
void check_bounds(const tinygltf::Model& model, Buffers& buffers, const Context& context);

// Warns of vertex colours of floats outside [0, 1].
void check_colors(const tinygltf::Model& model, Buffers& buffers, const Context& context);

// Warns of animations whose times are negative or do not grow. Wants the document, as the model holds no
// animations.
void check_animation_times(const Json& document, const tinygltf::Model& model, Buffers& buffers,
                           const Context& context);

} // namespace spa::import::gltf
