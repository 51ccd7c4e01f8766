// SPDX-License-Identifier: Apache-2.0
// How long something takes.
#pragma once

#include <chrono>
#include <ctime>

namespace spa::measure {

// By the clock on the wall.
template <class Work>
double seconds_of(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// This thread's own processor time where the system tells it, else by the wall: what else the machine does
// then costs a little cache, but not whole slices of time. For work that stays on this thread.
template <class Work>
double thread_seconds_of(Work&& work) {
#ifdef CLOCK_THREAD_CPUTIME_ID
    const auto now = [] {
        timespec time{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
        return double(time.tv_sec) + double(time.tv_nsec) * 1e-9;
    };
    const double start = now();
    work();
    return now() - start;
#else
    return seconds_of(work);
#endif
}

} // namespace spa::measure
