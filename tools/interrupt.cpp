// SPDX-License-Identifier: Apache-2.0
#include "interrupt.h"

#include "../libspa/bake/crossings.h"

namespace spa::tools {

namespace {

constexpr std::array handled_signals{SIGINT, SIGTERM, SIGHUP, SIGPIPE};

// A signal handler can reach nothing but static storage.
volatile std::sig_atomic_t received_signal = 0;

extern "C" void remember_signal(int number) { received_signal = number; }

} // namespace

InterruptGuard::InterruptGuard() {
    for (std::size_t i = 0; i < handled_signals.size(); ++i) {
        struct sigaction action {};
        sigemptyset(&action.sa_mask);
        action.sa_flags = SA_RESTART;
        if (handled_signals[i] == SIGPIPE)
            action.sa_handler = SIG_IGN;
        else
            action.sa_handler = remember_signal;
        sigaction(handled_signals[i], &action, &previous_[i]);
    }
}

InterruptGuard::~InterruptGuard() {
    for (std::size_t i = 0; i < handled_signals.size(); ++i)
        sigaction(handled_signals[i], &previous_[i], nullptr);
}

void InterruptGuard::check() {
    if (received_signal != 0) throw bake::Cancelled{};
}

void forget_interrupts() {
    for (const int number : handled_signals) static_cast<void>(std::signal(number, SIG_DFL));
    received_signal = 0;
}

int interrupt_signal() { return int(received_signal); }

} // namespace spa::tools
