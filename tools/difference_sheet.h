// SPDX-License-Identifier: Apache-2.0
// Two maps and where they differ, as one labelled picture.
#pragma once

#include "picture.h"

#include "../libspa/core/spherical_map.h"

#include <string>

namespace spa::tools {

// One row a surface that either map has: both colours, then the differences of depth, normals and colour. The
// maps must have passed the container's checks and be comparable (measure::compare without `structure`).
Picture difference_sheet(const SphericalMap& a, const SphericalMap& b, const std::string& title);

} // namespace spa::tools
