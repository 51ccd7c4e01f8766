// SPDX-License-Identifier: Apache-2.0
#include "progress.h"

#include "text.h"

#include <algorithm>
#include <condition_variable>
#include <iostream>
#include <mutex>
#include <unistd.h>

namespace spa::tools {

namespace {
constexpr auto first_after = std::chrono::seconds(1);
constexpr auto bar_every = std::chrono::milliseconds(100);
constexpr auto line_every = std::chrono::seconds(5);
constexpr int bar_cells = 30;
} // namespace

bool stderr_is_terminal() { return isatty(STDERR_FILENO) == 1; }

ProgressReport::ProgressReport(std::string task, bool quiet)
    : task_(std::move(task)), quiet_(quiet), terminal_(stderr_is_terminal()),
      next_(Clock::now() + first_after) {}

ProgressReport::~ProgressReport() {
    if (bar_drawn_) std::cerr << "\r\x1b[K" << std::flush;
}

void ProgressReport::update(double share) {
    if (quiet_) return;
    const Clock::time_point now = Clock::now();
    if (now < next_) return;
    share = std::clamp(share, 0.0, 1.0);
    const std::string done = pad_left(std::to_string(int(share * 100)), 3) + " %";
    if (terminal_) {
        const int full = int(share * bar_cells);
        std::cerr << "\r\x1b[K" << task_ << " [" << std::string(std::size_t(full), '#')
                  << std::string(std::size_t(bar_cells - full), '.') << "] " << done << std::flush;
        bar_drawn_ = true;
        next_ = now + bar_every;
    } else {
        std::cerr << "spa: " << task_ << ": " << done << std::endl;
        next_ = now + line_every;
    }
}

SlowStep::SlowStep(const std::string& task, bool quiet) {
    if (quiet) return;
    thread_ = std::jthread([task](const std::stop_token& stop) {
        const bool terminal = isatty(STDERR_FILENO) == 1;
        std::mutex mutex;
        std::condition_variable_any stopped;
        std::unique_lock lock(mutex);
        const auto never = [] { return false; };
        stopped.wait_for(lock, stop, first_after, never);
        if (stop.stop_requested()) return;
        std::cerr << (terminal ? task + " ..." : "spa: " + task + "\n") << std::flush;
        stopped.wait(lock, stop, never);
        if (terminal) std::cerr << "\r\x1b[K" << std::flush;
    });
}

} // namespace spa::tools
