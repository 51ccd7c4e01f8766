// SPDX-License-Identifier: Apache-2.0
// Progress on stderr: a bar on a terminal, a plain line now and then elsewhere, nothing in the first second.
#pragma once

#include <chrono>
#include <string>
#include <thread>

namespace spa::tools {

// Where plain lines would break a promise of silence, progress is for terminals only.
bool stderr_is_terminal();

class ProgressReport {
public:
    // task: such as "baking boot.glb".
    ProgressReport(std::string task, bool quiet);
    ~ProgressReport(); // removes the bar
    ProgressReport(const ProgressReport&) = delete;
    ProgressReport& operator=(const ProgressReport&) = delete;

    // share in [0,1]; from one thread at a time.
    void update(double share);

private:
    using Clock = std::chrono::steady_clock;
    std::string task_;
    bool quiet_;
    bool terminal_;
    bool bar_drawn_ = false;
    Clock::time_point next_; // nothing is written before
};

// For a step that cannot tell how far it is: while one lives, and after its first second, stderr says once
// what goes on.
class SlowStep {
public:
    SlowStep(const std::string& task, bool quiet);

private:
    std::jthread thread_; // its destructor asks it to stop and waits
};

} // namespace spa::tools
