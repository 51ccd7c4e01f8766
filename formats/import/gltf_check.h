// SPDX-License-Identifier: Apache-2.0
// What the glTF specification demands beyond the schema. Each function wants a document that passed
// check_schema; it throws Error for a defect that leaves no single meaning and warns of the others.
#pragma once

#include "gltf_schema.h"

#include <cstdint>

namespace spa::import::gltf {

// Bytes of one component of an accessor, and how many an element has.
constexpr std::size_t component_size(std::uint64_t component_type) {
    switch (component_type) {
    case 5120: // BYTE
    case 5121: // UNSIGNED_BYTE
        return 1;
    case 5122: // SHORT
    case 5123: // UNSIGNED_SHORT
        return 2;
    default: return 4; // UNSIGNED_INT, FLOAT
    }
}
std::size_t component_count(std::string_view type);

// The unsigned integer member `key` of an object, or `missing`.
std::uint64_t integer_of(const Json& object, const char* key, std::uint64_t missing = 0);
// The array or object member `key`, or an empty one.
const Json& member_of(const Json& object, const char* key);

// Version and required extensions. Throws Error(unsupported) for a required extension that is not read.
void check_asset(const Json& document, const Context& context);

// Ranges of buffer views, accessors and compressed views; images.
void check_buffer_views(const Json& document, const Context& context);
void check_accessors(const Json& document, const Context& context);
void check_images(const Json& document, const Context& context);

// Attributes and indices of primitives; skins; instancing.
void check_meshes(const Json& document, const Context& context);
void check_skins(const Json& document, const Context& context);

// Transforms, loops, depth, several parents; what scenes list.
void check_nodes(const Json& document, const Context& context);
void check_scenes(const Json& document, const Context& context);
void check_animations(const Json& document, const Context& context);

} // namespace spa::import::gltf
