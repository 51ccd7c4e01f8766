// SPDX-License-Identifier: Apache-2.0
// Work in processes of its own, so that what crashes, hangs or eats memory takes nothing else along. POSIX.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <list>
#include <optional>
#include <string>
#include <sys/types.h>

namespace spa::tools {

struct WorkerLimits {
    std::uint64_t memory_bytes = 0;              // of private memory, more than it is born with (RLIMIT_DATA)
    std::optional<std::chrono::seconds> timeout; // then it is asked to stop (SIGTERM), 2 s later killed
};

// How a worker ended.
struct WorkerEnd {
    std::size_t id = 0;      // that it was started with
    bool completed = false;  // the task returned
    std::string result;      // what it returned
    std::string diagnostics; // the last of what it wrote to standard output and standard error
    int signal = 0;          // that ended it; 0 = none
    bool timed_out = false;
    std::uint64_t peak_memory_bytes = 0; // resident
    double seconds = 0;
};

// Runs tasks in forks of this process: a fork costs a millisecond, a new start of the command two hundred. No
// other thread of this process may be at work, as it would be gone from the fork with the locks that it
// holds; those that libraries start when they are loaded, and that sleep, do no harm. Children die with their
// parent.
class WorkerPool {
public:
    // From now on SIGCHLD does what it does by default: a process that was started with it ignored would
    // never learn how its children ended.
    WorkerPool();
    ~WorkerPool(); // kills what still runs
    WorkerPool(const WorkerPool&) = delete;
    WorkerPool& operator=(const WorkerPool&) = delete;

    // Starts task() in a child. Its standard input is empty. The task must not throw. Throws
    // Error{input_output} if the system gives no process or pipe.
    void start(std::size_t id, const std::function<std::string()>& task, const WorkerLimits& limits);

    // One that ended; none if none did for `at_most`, or at once when a signal arrives.
    std::optional<WorkerEnd> wait(std::chrono::milliseconds at_most);

    [[nodiscard]] std::size_t running() const { return workers_.size(); }
    void signal_all(int number);
    // Asks all to stop (SIGTERM); 2 s later those that have not are killed.
    void stop_all();

private:
    using Clock = std::chrono::steady_clock;
    struct Worker {
        std::size_t id = 0;
        pid_t process = 0;
        int result = -1, output = -1; // read ends; -1: at its end
        WorkerEnd end;
        Clock::time_point started, deadline = Clock::time_point::max();
        bool asked_to_stop = false;
    };
    // Reads what the workers say, waiting for some until then. False if a signal arrived.
    bool read_until(Clock::time_point until);
    void stop(Worker& worker, Clock::time_point now);
    void enforce_deadlines(Clock::time_point now);
    [[noreturn]] void become_worker(const std::function<std::string()>& task, const WorkerLimits& limits,
                                    int result, int output);
    WorkerEnd collect(std::list<Worker>::iterator worker);

    std::list<Worker> workers_;
};

} // namespace spa::tools
