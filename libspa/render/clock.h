// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace spa::render {

// By the clock on the wall.
template <class Work>
double seconds_of(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace spa::render
