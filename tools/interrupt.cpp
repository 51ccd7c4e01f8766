// SPDX-License-Identifier: Apache-2.0
#include "interrupt.h"

#include "../libspa/bake/crossings.h"

namespace spa::tools {

namespace {

constexpr std::array interrupts{SIGINT, SIGTERM, SIGHUP};
constexpr std::array ignored_signals{SIGPIPE, SIGXFSZ};

// A signal handler can reach nothing but static storage.
volatile std::sig_atomic_t received_signal = 0;

extern "C" void remember_signal(int number) { received_signal = number; }

struct sigaction action_of(int number) {
    struct sigaction action {};
    sigaction(number, nullptr, &action);
    return action;
}

} // namespace

InterruptGuard::InterruptGuard() {
    struct sigaction action {};
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    auto previous = previous_.begin();
    for (const int number : interrupts) {
        *previous = action_of(number);
        action.sa_handler = previous++->sa_handler == SIG_IGN ? SIG_IGN : remember_signal;
        sigaction(number, &action, nullptr);
    }
    action.sa_handler = SIG_IGN;
    for (const int number : ignored_signals) sigaction(number, &action, &*previous++);
}

InterruptGuard::~InterruptGuard() {
    auto previous = previous_.begin();
    for (const int number : interrupts) sigaction(number, &*previous++, nullptr);
    for (const int number : ignored_signals) sigaction(number, &*previous++, nullptr);
}

void InterruptGuard::check() {
    if (received_signal != 0) throw bake::Cancelled{};
}

InterruptHold::InterruptHold() {
    sigset_t held;
    sigemptyset(&held);
    for (const int number : interrupts) sigaddset(&held, number);
    pthread_sigmask(SIG_BLOCK, &held, &previous_);
}

void InterruptHold::end() const { pthread_sigmask(SIG_SETMASK, &previous_, nullptr); }

void forget_interrupts() {
    for (const int number : interrupts)
        if (number == SIGTERM || action_of(number).sa_handler != SIG_IGN)
            static_cast<void>(std::signal(number, SIG_DFL));
    for (const int number : ignored_signals) static_cast<void>(std::signal(number, SIG_DFL));
    received_signal = 0;
}

int interrupt_signal() { return int(received_signal); }

} // namespace spa::tools
