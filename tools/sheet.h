// SPDX-License-Identifier: Apache-2.0
// The contact sheet: all images of a map in one labelled picture.
#pragma once

#include "picture.h"

#include "../libspa/core/spherical_map.h"

#include <string>

namespace spa::tools {

// One row a surface (part, layer, side): colour, depth, normals, coverage. At most 1600 pixels wide.
// The map must have passed the container's checks.
Picture contact_sheet(const SphericalMap& map, const std::string& file_name);

} // namespace spa::tools
