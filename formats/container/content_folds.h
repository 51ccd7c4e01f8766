// SPDX-License-Identifier: Apache-2.0
// The rules about fold records: ../SPA.md, "Folds".
#pragma once

#include "structure.h"

namespace spa::container {

// The records of a part of the map that `structure` describes, whose lengths, depths and mixed triangles are
// checked. index: of the part. O(records + edges with records * layers).
Status check_folds(const Structure& structure, std::uint32_t index, const Part& part);

} // namespace spa::container
