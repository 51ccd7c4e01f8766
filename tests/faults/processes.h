// SPDX-License-Identifier: Apache-2.0
// Processes below another one. Linux.
#pragma once

#include <cstddef>
#include <sys/types.h>
#include <vector>

namespace spa::test {

std::vector<pid_t> children_of(pid_t parent);

// Sends a signal to a child of `parent`; never to another process that has got its number meanwhile. False if
// there is no such child.
bool signal_child(pid_t parent, pid_t child, int number);

// While one lives, processes whose parent ended become children of this process. They are not lost that way,
// and a test can wait for them.
class Orphanage {
public:
    Orphanage();
    ~Orphanage(); // kills those that are left
    Orphanage(const Orphanage&) = delete;
    Orphanage& operator=(const Orphanage&) = delete;

    // Whether all children of this process have ended; waits for them for half a minute, which is more than
    // they need on any machine. To be called when no Process runs.
    static bool all_have_ended();
};

} // namespace spa::test
