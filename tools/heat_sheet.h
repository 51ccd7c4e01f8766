// SPDX-License-Identifier: Apache-2.0
// Where a map is wrong, and by how much, as one labelled picture.
#pragma once

#include "picture.h"

#include "../libspa/measure/measure_map.h"

#include <string>
#include <vector>

namespace spa::tools {

// First the source's surface as the centre (of several parts each its own) sees it, with the worst distance
// to the map in each direction, apart for what the layers hold and what they do not. Then one row a surface:
// its colours, the distance of every texel to the source, the error of its normal and of its colour on
// logarithmic scales; texels that are missing or too many are marked.
Picture heat_sheet(const std::vector<Part>& parts, const measure::Measurement& measurement,
                   const std::string& title);

} // namespace spa::tools
