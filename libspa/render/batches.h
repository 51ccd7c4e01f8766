// SPDX-License-Identifier: Apache-2.0
// A frame in pieces, none of which keeps the device busy for long: some systems stop a device that does not
// answer for a few seconds, and progress is told between them.
#pragma once

#include "shaders/data.h"

#include <cstdint>
#include <optional>

namespace spa::render {

constexpr std::uint64_t max_pixels = 1U << 26U;

enum class Pass : std::uint32_t { primary = SPA_PASS_PRIMARY, secondary = SPA_PASS_SECONDARY };

struct Batch {
    Pass pass = Pass::primary;
    std::uint32_t first_row = 0, end_row = 0;
    std::uint32_t first_sample = 0, end_sample = 0; // one in the primary pass
    std::uint32_t primary_ray = 0;                  // number in its pixel
};

// For each primary ray of a pixel: that ray for all pixels, then the secondary rays of all pixels. A pixel's
// samples come in their order, so how the work is cut does not change their sum.
class Batches {
public:
    // seconds: that a batch should take.
    Batches(std::uint32_t width, std::uint32_t height, std::uint32_t antialias, std::uint32_t samples,
            double seconds);

    // Of one primary ray a pixel that was traced before: the secondary rays from `first` up to `end`.
    static Batches of_samples(std::uint32_t width, std::uint32_t height, std::uint32_t first,
                              std::uint32_t end, double seconds);

    // None: that was all.
    std::optional<Batch> next();
    // How long the last one took; the next are made larger or smaller by that.
    void took(double seconds);
    [[nodiscard]] double share_done() const { return double(done_) / double(total_); }

private:
    [[nodiscard]] std::uint64_t rays_of(const Batch& batch) const;

    std::uint32_t width_, height_, antialias_, samples_;
    std::uint32_t first_sample_ = 0;
    double seconds_;
    Batch last_;
    bool begun_ = false;
    bool secondary_ = false;         // some were traced
    std::uint64_t done_ = 0, total_; // rays
    double budget_[2];               // rays a batch of a pass
};

} // namespace spa::render
