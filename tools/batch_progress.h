// SPDX-License-Identifier: Apache-2.0
// Progress of a batch on standard error: a bar with rate and remaining time on a terminal, with what failed
// above it; one line an asset elsewhere.
#pragma once

#include "batch_report.h"

#include <chrono>
#include <cstdint>
#include <string>

namespace spa::tools {

class BatchProgress {
public:
    // weight: of all assets; done() takes it in the same unit, and remaining time follows from it.
    BatchProgress(std::size_t assets, std::uint64_t weight, bool quiet);
    ~BatchProgress(); // removes the bar
    BatchProgress(const BatchProgress&) = delete;
    BatchProgress& operator=(const BatchProgress&) = delete;

    void done(const BatchAsset& asset, const AssetResult& result, std::uint64_t weight);
    // Now and then, so that the bar's times go on.
    void update();

private:
    using Clock = std::chrono::steady_clock;
    void draw(Clock::time_point now);

    std::size_t assets_, done_ = 0, baked_ = 0, failed_ = 0;
    std::uint64_t weight_, done_weight_ = 0;
    bool quiet_, terminal_;
    Clock::time_point start_, next_;
};

// "3 s", "4 min", "2 h 05 min".
std::string duration_text(double seconds);

} // namespace spa::tools
