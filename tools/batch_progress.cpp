// SPDX-License-Identifier: Apache-2.0
#include "batch_progress.h"

#include "progress.h"
#include "text.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace spa::tools {

namespace {

constexpr auto bar_every = std::chrono::milliseconds(100);
constexpr int bar_cells = 24;

double seconds_between(std::chrono::steady_clock::time_point from, std::chrono::steady_clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
}

std::string outcome_text(const AssetResult& result) {
    switch (result.status) {
    case AssetStatus::baked: {
        std::string text = std::string("baked (") + name(result.reason) + ")";
        if (result.facts.bytes == 0) return "to bake (" + std::string(name(result.reason)) + ")"; // dry run
        text += ", " + fixed(result.seconds, 2) + " s, " + byte_count(result.facts.bytes);
        const std::size_t warnings = result.warnings.size();
        if (warnings > 0)
            text += ", " + std::to_string(warnings) + (warnings == 1 ? " warning" : " warnings");
        return text;
    }
    case AssetStatus::up_to_date: return "up to date";
    case AssetStatus::failed:
        return "failed, exit " + std::to_string(int(result.exit_code)) + ": " + one_line(result.error);
    case AssetStatus::not_started: break;
    }
    return "not finished";
}

} // namespace

BatchProgress::BatchProgress(std::size_t assets, std::uint64_t weight, bool quiet)
    : assets_(assets), weight_(weight), quiet_(quiet), terminal_(stderr_is_terminal()), start_(Clock::now()),
      next_(start_) {}

BatchProgress::~BatchProgress() {
    if (!quiet_ && terminal_) std::cerr << "\r\x1b[K" << std::flush;
}

void BatchProgress::done(const BatchAsset& asset, const AssetResult& result, std::uint64_t weight) {
    ++done_;
    done_weight_ += weight;
    if (result.status == AssetStatus::baked) ++baked_;
    const bool failed = result.status == AssetStatus::failed;
    if (failed) ++failed_;
    if (quiet_) return;
    const std::string line = one_line(asset.name) + ": " + outcome_text(result) + "\n";
    if (!terminal_)
        std::cerr << "spa: [" << done_ << "/" << assets_ << "] " << line;
    else if (failed)
        std::cerr << "\r\x1b[Kspa: " << line;
    update();
}

void BatchProgress::update() {
    const Clock::time_point now = Clock::now();
    if (quiet_ || !terminal_ || now < next_) return;
    next_ = now + bar_every;
    draw(now);
}

void BatchProgress::draw(Clock::time_point now) {
    const double share = weight_ == 0 ? 1 : double(done_weight_) / double(weight_);
    const double elapsed = seconds_between(start_, now);
    const auto full = std::size_t(std::clamp(share, 0.0, 1.0) * bar_cells);
    std::cerr << "\r\x1b[K[" << std::string(full, '#') << std::string(bar_cells - full, '.') << "] " << done_
              << "/" << assets_;
    if (failed_ > 0) std::cerr << ", " << failed_ << " failed";
    if (elapsed >= 1 && done_ > 0) {
        std::cerr << ", " << significant(double(done_) / elapsed, 2) << "/s";
        if (share > 0) std::cerr << ", " << duration_text(elapsed * (1 - share) / share) << " left";
    }
    std::cerr << std::flush;
}

std::string duration_text(double seconds) {
    const auto whole = std::uint64_t(std::ceil(seconds));
    if (whole < 120) return std::to_string(whole) + " s";
    const std::uint64_t minutes = (whole + 30) / 60;
    if (minutes < 120) return std::to_string(minutes) + " min";
    const std::string rest = std::to_string(minutes % 60);
    return std::to_string(minutes / 60) + " h " + (rest.size() < 2 ? "0" : "") + rest + " min";
}

} // namespace spa::tools
