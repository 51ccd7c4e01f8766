// SPDX-License-Identifier: Apache-2.0
// The smallest map of several parts that is as exact as asked for.
#pragma once

#include "search.h"

#include "../mesh/partition.h"

namespace spa::plan {

// Bakes a map of these pieces at each of request.cells, the smallest first, with all else as in
// request.options (the most exact of each list, frame and centre of each piece by itself), and traces fewer
// rays or, for metrics of surfaces, measures in full. The first that meets the target is measured in full; if
// that says otherwise the search goes on. Unlike search() it tries no layers, bits, frames or centres, and
// bakes each size anew. partition: of at least two pieces. Throws as search does.
SearchResult search_parts(const Model& model, const Partition& partition, const SearchRequest& request,
                          const bake::Progress& progress = {});

} // namespace spa::plan
