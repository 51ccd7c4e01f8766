// SPDX-License-Identifier: Apache-2.0
// The outermost crossing of a sample while it is being looked for.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdint>

namespace spa::bake {

// Where the outermost crossing of a sample is. Of two that meet the same ray the larger one is outside.
class OutermostHit {
public:
    OutermostHit() = default; // the ray meets nothing
    // radius: r/R in (0, 1]. Positive floats order like their bits; of equal ones the smallest triangle wins.
    OutermostHit(float radius, std::uint32_t triangle)
        : key_(std::uint64_t(std::bit_cast<std::uint32_t>(radius)) << 32U | (0xFFFFFFFFU - triangle)) {}

    [[nodiscard]] bool empty() const { return key_ == 0; }
    [[nodiscard]] float radius() const { return std::bit_cast<float>(std::uint32_t(key_ >> 32U)); }
    [[nodiscard]] std::uint32_t triangle() const { return 0xFFFFFFFFU - std::uint32_t(key_ & 0xFFFFFFFFU); }
    void keep_outermost(OutermostHit other) { key_ = std::max(key_, other.key_); }
    // The same while other threads do it too.
    void keep_outermost_atomically(OutermostHit other) {
        const std::atomic_ref<std::uint64_t> best(key_);
        std::uint64_t seen = best.load(std::memory_order_relaxed);
        while (seen < other.key_ &&
               !best.compare_exchange_weak(seen, other.key_, std::memory_order_relaxed)) {
        }
    }

private:
    std::uint64_t key_ = 0;
};

} // namespace spa::bake
