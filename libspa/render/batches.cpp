// SPDX-License-Identifier: Apache-2.0
#include "batches.h"

#include <algorithm>

namespace spa::render {
namespace {

constexpr double first_rays = 16384;
constexpr double most_rays = 1U << 30U;
// What keeps a GPU busy. Samples of a pixel follow each other in one thread, so pixels go before samples.
constexpr double enough_pixels = 1U << 20U;

} // namespace

Batches::Batches(std::uint32_t width, std::uint32_t height, std::uint32_t antialias, std::uint32_t samples,
                 double seconds)
    : width_(width), height_(height), antialias_(antialias), samples_(samples), seconds_(seconds),
      total_(std::uint64_t(width) * height * antialias * (1 + std::uint64_t(samples))), budget_{first_rays,
                                                                                                first_rays} {}

Batches Batches::of_samples(std::uint32_t width, std::uint32_t height, std::uint32_t first, std::uint32_t end,
                            double seconds) {
    Batches batches(width, height, 1, end, seconds);
    batches.first_sample_ = batches.last_.first_sample = first;
    batches.last_.pass = Pass::secondary;
    return batches;
}

std::uint64_t Batches::rays_of(const Batch& batch) const {
    const std::uint64_t samples = batch.pass == Pass::primary ? 1 : batch.end_sample - batch.first_sample;
    return std::uint64_t(width_) * (batch.end_row - batch.first_row) * samples;
}

std::optional<Batch> Batches::next() {
    Batch batch = last_;
    if (begun_) {
        // The next samples of the rows; the next rows; the next pass; the next primary ray.
        if (batch.pass == Pass::secondary && batch.end_sample < samples_) {
            batch.first_sample = batch.end_sample;
        } else {
            batch.first_sample = first_sample_;
            batch.first_row = batch.end_row;
        }
        if (batch.first_row == height_) {
            batch.first_row = 0;
            if (batch.pass == Pass::primary && samples_ > 0) {
                batch.pass = Pass::secondary;
            } else {
                batch.pass = Pass::primary;
                ++batch.primary_ray;
            }
        }
        if (batch.primary_ray == antialias_) return std::nullopt;
    }
    begun_ = true;

    const std::uint32_t samples = batch.pass == Pass::primary ? 1 : samples_;
    const double rays = budget_[std::size_t(batch.pass)];
    if (batch.first_sample == first_sample_) {
        // Whole workgroups of rows; at the end of the picture what is left.
        const double pixels = std::max(rays / samples, std::min(rays, enough_pixels));
        const double rows = std::clamp(pixels / width_, double(SPA_GROUP_SIZE), double(height_));
        const std::uint32_t whole = std::uint32_t(rows) / SPA_GROUP_SIZE * SPA_GROUP_SIZE;
        batch.end_row = batch.first_row +
                        std::min(std::max(whole, std::uint32_t(SPA_GROUP_SIZE)), height_ - batch.first_row);
    }
    const double of_row = double(width_) * (batch.end_row - batch.first_row);
    const double count = std::clamp(rays / of_row, 1.0, double(samples - batch.first_sample));
    batch.end_sample = batch.first_sample + std::uint32_t(count);
    last_ = batch;
    return batch;
}

void Batches::took(double seconds) {
    const std::uint64_t rays = rays_of(last_);
    done_ += rays;
    double& budget = budget_[std::size_t(last_.pass)];
    const double better = double(rays) * seconds_ / std::max(seconds, 1e-4);
    budget = std::clamp(better, std::max(budget / 4, 64.0), std::min(budget * 4, most_rays));
    // A first guess of what secondary rays cost.
    if (last_.pass == Pass::secondary) secondary_ = true;
    if (!secondary_) budget_[std::size_t(Pass::secondary)] = std::max(first_rays, budget / 4);
}

} // namespace spa::render
