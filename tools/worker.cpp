// SPDX-License-Identifier: Apache-2.0
#include "worker.h"

#include "interrupt.h"

#include "../libspa/core/error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <vector>

#ifdef __linux__
#include <sys/prctl.h>
#endif

namespace spa::tools {

namespace {

constexpr auto grace = std::chrono::seconds(2); // from SIGTERM to SIGKILL
constexpr std::size_t kept_diagnostics = 2048;
// A result has the report of a bake and a small picture.
constexpr std::size_t longest_result = std::size_t(64) << 20U;

struct Pipe {
    int read_end = -1, write_end = -1;
};

Pipe make_pipe() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
        throw Error(ExitCode::input_output,
                    "the system gives no pipe: " + std::generic_category().message(errno) +
                        "; use fewer --jobs");
    return {ends[0], ends[1]};
}

// Private memory in use, as RLIMIT_DATA counts it.
std::uint64_t private_bytes() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmData:")) return std::strtoull(line.c_str() + 7, nullptr, 10) << 10U;
    return 0;
}

void limit_memory(std::uint64_t bytes) {
    rlimit limit{};
    if (getrlimit(RLIMIT_DATA, &limit) != 0) return;
    limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, private_bytes() + bytes);
    setrlimit(RLIMIT_DATA, &limit);
}

void prefer_as_victim() { std::ofstream("/proc/self/oom_score_adj") << 500; }

void die_with(pid_t parent) {
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(1); // it went before the call
#else
    static_cast<void>(parent);
#endif
}

void write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t count = write(descriptor, text.data(), text.size());
        if (count < 0 && errno != EINTR) return;
        if (count > 0) text.remove_prefix(std::size_t(count));
    }
}

[[noreturn]] void become_worker(const std::function<std::string()>& task, const WorkerLimits& limits,
                                const Pipe& result, const Pipe& output, pid_t parent) {
    die_with(parent);
    forget_interrupts();
    const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
    dup2(nothing, STDIN_FILENO);
    dup2(output.write_end, STDOUT_FILENO);
    dup2(output.write_end, STDERR_FILENO);
    prefer_as_victim();
    limit_memory(limits.memory_bytes);
    write_all(result.write_end, task());
    // Without what belongs to the parent: its buffers, its temporary files.
    _exit(0);
}

// Appends what there is; false at the end.
bool read_some(int descriptor, std::string& text) {
    std::array<char, 65536> buffer{};
    const ssize_t count = read(descriptor, buffer.data(), buffer.size());
    if (count < 0) return errno == EINTR || errno == EAGAIN;
    text.append(buffer.data(), std::size_t(count));
    return count > 0;
}

void close_end(int& descriptor) {
    if (descriptor >= 0) close(descriptor);
    descriptor = -1;
}

} // namespace

WorkerPool::~WorkerPool() {
    signal_all(SIGKILL);
    while (!workers_.empty()) collect(workers_.begin());
}

void WorkerPool::start(std::size_t id, const std::function<std::string()>& task, const WorkerLimits& limits) {
    Pipe result = make_pipe();
    Pipe output;
    try {
        output = make_pipe();
    } catch (...) {
        close(result.read_end);
        close(result.write_end);
        throw;
    }
    const pid_t parent = getpid();
    const pid_t process = fork();
    if (process == 0) become_worker(task, limits, result, output, parent);
    const int number = errno;
    close(result.write_end);
    close(output.write_end);
    if (process < 0) {
        close(result.read_end);
        close(output.read_end);
        throw Error(ExitCode::input_output,
                    "the system gives no process: " + std::generic_category().message(number) +
                        "; use fewer --jobs");
    }
    Worker worker;
    worker.id = id;
    worker.process = process;
    worker.result = result.read_end;
    worker.output = output.read_end;
    worker.started = Clock::now();
    if (limits.timeout) worker.deadline = worker.started + *limits.timeout;
    workers_.push_back(std::move(worker));
}

std::optional<WorkerEnd> WorkerPool::wait(std::chrono::milliseconds at_most) {
    const Clock::time_point until = Clock::now() + at_most;
    for (bool is_last = false;;) {
        const auto ended = std::find_if(workers_.begin(), workers_.end(), [](const Worker& worker) {
            return worker.result < 0 && worker.output < 0;
        });
        if (ended != workers_.end()) return collect(ended);
        if (is_last) return {};
        enforce_deadlines(Clock::now());
        if (!read_until(until)) return {};
        is_last = Clock::now() >= until;
    }
}

bool WorkerPool::read_until(Clock::time_point until) {
    std::vector<pollfd> waiting;
    for (const Worker& worker : workers_) {
        until = std::min(until, worker.deadline);
        waiting.push_back({worker.result, POLLIN, 0}); // poll() passes over descriptors below 0
        waiting.push_back({worker.output, POLLIN, 0});
    }
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
    const int count = poll(waiting.data(), waiting.size(), int(std::max<long>(left, 0)));
    if (count <= 0) return count == 0 || errno != EINTR;
    auto events = waiting.begin();
    for (Worker& worker : workers_) {
        std::string& result = worker.end.result;
        if ((events++)->revents != 0 && (!read_some(worker.result, result) || result.size() > longest_result))
            close_end(worker.result);
        std::string& text = worker.end.diagnostics;
        if ((events++)->revents != 0 && !read_some(worker.output, text)) close_end(worker.output);
        if (text.size() > kept_diagnostics) text.erase(0, text.size() - kept_diagnostics);
    }
    return true;
}

void WorkerPool::signal_all(int number) {
    for (const Worker& worker : workers_) kill(worker.process, number);
}

void WorkerPool::enforce_deadlines(Clock::time_point now) {
    for (Worker& worker : workers_) {
        if (now < worker.deadline) continue;
        kill(worker.process, worker.end.timed_out ? SIGKILL : SIGTERM);
        worker.deadline = worker.end.timed_out ? Clock::time_point::max() : now + grace;
        worker.end.timed_out = true;
    }
}

WorkerEnd WorkerPool::collect(std::list<Worker>::iterator worker) {
    close_end(worker->result);
    close_end(worker->output);
    int status = 0;
    rusage usage{};
    while (wait4(worker->process, &status, 0, &usage) < 0 && errno == EINTR) {
    }
    WorkerEnd end = std::move(worker->end);
    end.id = worker->id;
    end.seconds = std::chrono::duration<double>(Clock::now() - worker->started).count();
    end.peak_memory_bytes = std::uint64_t(usage.ru_maxrss) << 10U;
    end.completed = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
    workers_.erase(worker);
    return end;
}

} // namespace spa::tools
