// SPDX-License-Identifier: Apache-2.0
// Parts with fold records: by hand, at random, and baked from what has borders and silhouettes.
#pragma once

#include "maps.h"

#include "../../libspa/core/folds.h"

#include <cstdint>
#include <vector>

namespace spa::test {

// records: of edges in any order, those of one edge in theirs.
void set_folds(OwnedPart& owned, std::vector<FoldRecord> records);

// Gives every edge of the part records at random, such that what they leave matches, but for a share of them
// that are changed into anything.
void add_random_folds(OwnedPart& owned, double nonsense, std::uint32_t seed);

std::vector<NamedPart> made_fold_parts();
std::vector<NamedPart> random_fold_parts();
std::vector<NamedPart> baked_fold_parts();

} // namespace spa::test
