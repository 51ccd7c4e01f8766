// SPDX-License-Identifier: Apache-2.0
// The number of threads a bake may use.
#pragma once

#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace spa::bake {

// threads: 0 = all cores; more than there are cores means all of them.
inline int arena_concurrency(unsigned threads) {
    const auto cores = unsigned(tbb::info::default_concurrency());
    return int(threads == 0 ? cores : std::min(threads, cores));
}

} // namespace spa::bake
