// SPDX-License-Identifier: Apache-2.0
// The glTF 2.0 JSON schema as far as the reader relies on it, with the extensions it reads: which properties
// an object has, of which type, range and length, and which array an index points into.
#pragma once

#include "gltf_context.h"

#include <nlohmann/json.hpp>

namespace spa::import::gltf {

using Json = nlohmann::json;

// Whether `word` is one of the blank-separated `words`.
bool is_one_of(std::string_view words, std::string_view word);

// Checks the types and ranges of every known property of the document and that every index is in range.
// Unknown properties are ignored, empty arrays that may be left out are warned of. Integers that are written
// as 1.0 become integers. Throws Error(invalid_data) with the place of the first defect.
void check_schema(Json& document, const Context& context);

// Throws Error(invalid_data) for more objects than a real document has: each takes up to a kilobyte, whatever
// it says. The document may be any JSON.
void check_counts(const Json& document, const Context& context);

// Takes out what nobody reads but tinygltf would keep in memory: "extras", unknown extensions and
// unknown members of the others.
void remove_unread(Json& document);

// The same for cameras and KHR_lights_punctual, which only a scene needs; the document passed check_schema.
// The indices of lights remain to be checked.
void check_scene_schema(Json& document, const Context& context);

} // namespace spa::import::gltf
