// SPDX-License-Identifier: Apache-2.0
// Defects of the data itself that do no harm to the picture, or that only animations have: warnings.
#pragma once

#include "gltf_accessor.h"
#include "gltf_schema.h"

namespace spa::import::gltf {

// Accessors may share their data, so that a small document could have it read again and again.
class CheckBudget {
public:
    explicit CheckBudget(const Context& context) : left_(4 * context.limits.vertices), context_(context) {}

    // Before so many numbers are read. False if it would be too much: they are not checked, with a warning.
    bool spend(std::uint64_t numbers);

private:
    std::uint64_t left_;
    const Context& context_;
};

// Warns of accessors whose min and max are not those of their elements. Linear in the data of the accessors
// that have them.
void check_bounds(const tinygltf::Model& model, Buffers& buffers, CheckBudget& budget,
                  const Context& context);

// Warns of vertex colours of floats outside [0, 1].
void check_colors(const tinygltf::Model& model, Buffers& buffers, CheckBudget& budget,
                  const Context& context);

// Warns of animations whose times are negative or do not grow. Wants the document, as the model holds no
// animations.
void check_animation_times(const Json& document, const tinygltf::Model& model, Buffers& buffers,
                           CheckBudget& budget, const Context& context);

} // namespace spa::import::gltf
