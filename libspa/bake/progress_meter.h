// SPDX-License-Identifier: Apache-2.0
// Counts work done by many threads and passes it on to one Progress callback, one call at a time.
#pragma once

#include "crossings.h"

#include <atomic>
#include <cstdint>
#include <mutex>

namespace spa::bake {

class ProgressMeter {
public:
    ProgressMeter(const Progress& progress, std::uint64_t total) : progress_(progress), total_(total) {}

    // Safe from any thread; never blocks: if another thread is reporting, this one goes on working.
    void add(std::uint64_t amount) {
        const std::uint64_t done = done_ += amount;
        if (!progress_) return;
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (lock.owns_lock() && !progress_(double(done) / double(total_))) cancelled_ = true;
    }
    [[nodiscard]] bool cancelled() const { return cancelled_; }
    void throw_if_cancelled() const {
        if (cancelled_) throw Cancelled{};
    }

private:
    const Progress& progress_;
    const std::uint64_t total_;
    std::atomic<std::uint64_t> done_ = 0;
    std::atomic<bool> cancelled_ = false;
    std::mutex mutex_;
};

} // namespace spa::bake
