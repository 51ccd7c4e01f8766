// SPDX-License-Identifier: Apache-2.0
// How a mesh and its maps look, side by side.
#pragma once

#include "picture.h"

#include "../libspa/measure/layers_summary.h"

namespace spa::tools {

// Pixels of LayerView::side: four rays a pixel of the sheet.
constexpr std::uint32_t layers_view_side = 752;

// The source, one depth and layers with folds as a camera sees them, each map with its error: |dt| along the
// rays on a logarithmic scale, and marks where one alone is hit. mesh.benchmark has a view.
Picture layers_sheet(const measure::LayersMesh& mesh);

} // namespace spa::tools
