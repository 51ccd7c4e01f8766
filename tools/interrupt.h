// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and its relatives: end the work between two steps instead of in the middle of one, so that what
// was begun can be removed.
#pragma once

#include <array>
#include <csignal>
#include <stdexcept>

namespace spa::tools {

// While one lives, SIGINT, SIGTERM and SIGHUP only set a flag, but for those that were ignored before
// (nohup); SIGPIPE and SIGXFSZ are ignored, so that a write fails instead. At most one lives.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    // Throws bake::Cancelled if a signal came.
    static void check();

private:
    std::array<struct sigaction, 5> previous_{};
};

// While one lives, SIGINT, SIGTERM and SIGHUP wait. For a fork: until the child has forgotten the handlers, a
// signal to it would set a flag that nobody looks at.
class InterruptHold {
public:
    InterruptHold();
    ~InterruptHold() { end(); }
    InterruptHold(const InterruptHold&) = delete;
    InterruptHold& operator=(const InterruptHold&) = delete;
    void end() const; // before its life does

private:
    sigset_t previous_{};
};

// For a process just forked from one that has a guard: signals do again what they did before it. SIGTERM, by
// which a parent ends its child, is not ignored even if it was.
void forget_interrupts();

// Thrown where work was ended by a signal after part of it was done; the message says what is left.
class Interrupted : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// The signal that came while a guard lived; 0 = none.
int interrupt_signal();

} // namespace spa::tools
