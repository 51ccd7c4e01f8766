// SPDX-License-Identifier: Apache-2.0
// Animations of nodes: glTF 2.0, 3.11.
#pragma once

#include "../../libspa/mesh/rig.h"
#include "gltf_accessor.h"
#include "gltf_scene.h"
#include "gltf_schema.h"

#include <cstdint>
#include <span>
#include <vector>

namespace spa::import::gltf {

// The document's animations, for each of the places where a node stands. Throws Error(invalid_data) with the
// place of the first defect: times that are not finite or do not grow, keys of another number or type than
// the times and the path want, values that are not finite, two channels for one thing, an animated node with
// a matrix; and for curves that take more than `most_bytes`. Channels that move no place are passed over; of
// those for weights and without a node it warns. The document passed check_animations.
std::vector<Animation> read_animations(const Json& document, const tinygltf::Model& model,
                                       std::span<const Place> places, Buffers& buffers,
                                       std::uint64_t most_bytes, const Context& context);

} // namespace spa::import::gltf
