// SPDX-License-Identifier: Apache-2.0
// Where a map is wrong, and by how much, as one labelled picture.
#pragma once

#include "picture.h"

#include "../libspa/measure/measure_map.h"

#include <string>

namespace spa::tools {

// One row a surface: its colours, then the distance of every texel to the source, the error of its normal and
// of its colour on logarithmic scales; texels that are missing or too many are marked.
Picture heat_sheet(const Part& part, const measure::Measurement& measurement, const std::string& title);

} // namespace spa::tools
