// SPDX-License-Identifier: Apache-2.0
#include "processes.h"

#include <chrono>
#include <csignal>
#include <fstream>
#include <string>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace spa::test {

std::vector<pid_t> children_of(pid_t parent) {
    const std::string id = std::to_string(parent);
    std::ifstream file("/proc/" + id + "/task/" + id + "/children");
    std::vector<pid_t> children;
    for (pid_t child = 0; file >> child;) children.push_back(child);
    return children;
}

bool signal_child(pid_t parent, pid_t child, int number) {
    // Not pidfd_open(): the header of the C library is not one for C++.
    const int descriptor = int(syscall(SYS_pidfd_open, child, 0));
    if (descriptor < 0) return false;
    // If it is the parent's child now, it was so when the descriptor was made: the number was not free
    // between.
    bool sent = false;
    for (const pid_t id : children_of(parent))
        if (id == child) sent = syscall(SYS_pidfd_send_signal, descriptor, number, nullptr, 0) == 0;
    close(descriptor);
    return sent;
}

Orphanage::Orphanage() { prctl(PR_SET_CHILD_SUBREAPER, 1); }

Orphanage::~Orphanage() {
    for (const pid_t child : children_of(getpid()))
        if (signal_child(getpid(), child, SIGKILL)) waitpid(child, nullptr, 0);
    prctl(PR_SET_CHILD_SUBREAPER, 0);
}

bool Orphanage::all_have_ended() {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    for (;;) {
        const pid_t ended = waitpid(-1, nullptr, WNOHANG);
        if (ended < 0) return true;
        if (ended > 0) continue;
        if (std::chrono::steady_clock::now() > deadline) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

} // namespace spa::test
