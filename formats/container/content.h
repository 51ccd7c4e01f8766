// SPDX-License-Identifier: Apache-2.0
// The rules about pixels: which codes images may hold, how those of a part's layers relate, and what is said
// about the triangles between them.
#pragma once

#include "structure.h"

namespace spa::container {

// `map` holds the images of `structure`, decoded. Statuses give offsets in the decoded sections. O(samples).
Status check_content(const Structure& structure, const SphericalMap& map);

// Metadata is UTF-8 and one JSON object. `section` is its index.
Status check_metadata(const Structure& structure, std::size_t section, std::string_view text);

} // namespace spa::container
