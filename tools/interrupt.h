// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and its relatives: end the work between two steps instead of in the middle of one, so that what
// was begun can be removed.
#pragma once

#include <array>
#include <csignal>
#include <stdexcept>

namespace spa::tools {

// While one lives, SIGINT, SIGTERM and SIGHUP only set a flag; SIGPIPE is ignored. At most one lives.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    // Throws bake::Cancelled if a signal came.
    static void check();

private:
    std::array<struct sigaction, 4> previous_{};
};

// For a process just forked from one that has a guard: signals do again what they did before it.
void forget_interrupts();

// Thrown where work was ended by a signal after part of it was done; the message says what is left.
class Interrupted : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// The signal that came while a guard lived; 0 = none.
int interrupt_signal();

} // namespace spa::tools
