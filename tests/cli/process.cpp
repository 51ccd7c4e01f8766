// SPDX-License-Identifier: Apache-2.0
#include "process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <iterator>
#include <poll.h>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

#ifdef __linux__
#include <linux/capability.h>
#include <sys/prctl.h>
#endif

namespace spa::test {

namespace fs = std::filesystem;

namespace {

struct Pipe {
    int read_end = -1, write_end = -1;
    Pipe() {
        std::array<int, 2> ends{};
        if (pipe(ends.data()) != 0) throw std::runtime_error("pipe() failed");
        read_end = ends[0];
        write_end = ends[1];
    }
    ~Pipe() {
        close_end(read_end);
        close_end(write_end);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    static void close_end(int& end) {
        if (end >= 0) close(end);
        end = -1;
    }
};

// Only calls that are allowed between fork and exec, here and below.
void take_surroundings(const Surroundings& surroundings) {
#ifdef __linux__
    if (surroundings.obeys_permissions)
        for (const int capability : {CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH})
            prctl(PR_CAPBSET_DROP, capability, 0, 0, 0);
#endif
    if (surroundings.leads_group) setpgid(0, 0);
    for (const int number : surroundings.ignored_signals) signal(number, SIG_IGN);
    for (const auto& [resource, most] : surroundings.limits) {
        const rlimit limit{most, most};
        setrlimit(static_cast<decltype(RLIMIT_AS)>(resource), &limit);
    }
    for (const int descriptor : surroundings.closed) close(descriptor);
}

// Returns false at the end of the stream.
bool read_some(int descriptor, std::string& text) {
    std::array<char, 65536> buffer{};
    const ssize_t count = read(descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) return true;
    if (count <= 0) return false;
    text.append(buffer.data(), std::size_t(count));
    return true;
}

} // namespace

struct Process::Streams {
    Pipe in, out, err;

    [[noreturn]] void become_spa(const std::vector<char*>& arguments, const char* folder,
                                 const Surroundings& surroundings) const {
        dup2(in.read_end, STDIN_FILENO);
        dup2(out.write_end, STDOUT_FILENO);
        dup2(err.write_end, STDERR_FILENO);
        for (const Pipe* pipe : {&in, &out, &err}) {
            close(pipe->read_end);
            close(pipe->write_end);
        }
        take_surroundings(surroundings);
        if (chdir(folder) == 0) execv(SPA_BINARY, arguments.data());
        _exit(127);
    }

    [[nodiscard]] bool open() const { return out.read_end >= 0 || err.read_end >= 0; }
};

Process::Process(const std::vector<std::string>& arguments, const fs::path& folder, std::string input,
                 const Surroundings& surroundings)
    : input_(std::move(input)), streams_(std::make_unique<Streams>()) {
    std::signal(SIGPIPE, SIG_IGN); // the command may end without reading its input
    std::vector<std::string> texts{"spa"};
    texts.insert(texts.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    pointers.reserve(texts.size() + 1);
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    id_ = fork();
    if (id_ < 0) throw std::runtime_error("fork() failed");
    if (id_ == 0) streams_->become_spa(pointers, folder.c_str(), surroundings);
    // As the child does, so that it is true whoever comes first.
    if (surroundings.leads_group) setpgid(id_, id_);
    Pipe::close_end(streams_->in.read_end);
    Pipe::close_end(streams_->out.write_end);
    Pipe::close_end(streams_->err.write_end);
}

Process::~Process() {
    if (id_ < 0) return;
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
}

// All at once: a process that fills one pipe while another is waited for would hang.
void Process::exchange(int at_most_milliseconds) {
    auto& [in, out, err] = *streams_;
    if (input_.empty()) Pipe::close_end(in.write_end);
    std::array<pollfd, 3> waiting{
        {{out.read_end, POLLIN, 0}, {err.read_end, POLLIN, 0}, {in.write_end, POLLOUT, 0}}};
    if (poll(waiting.data(), waiting.size(), at_most_milliseconds) <= 0) return;
    if (waiting[0].revents != 0 && !read_some(out.read_end, outcome_.out)) Pipe::close_end(out.read_end);
    if (waiting[1].revents != 0 && !read_some(err.read_end, outcome_.err)) Pipe::close_end(err.read_end);
    if (waiting[2].revents != 0) {
        const ssize_t written =
            write(in.write_end, input_.data(), std::min<std::size_t>(input_.size(), 4096));
        input_.erase(0, written < 0 ? input_.size() : std::size_t(written));
    }
}

bool Process::until(const std::function<bool()>& condition) {
    while (!condition()) {
        if (!streams_->open()) return false;
        exchange(1);
    }
    return true;
}

Outcome Process::wait() {
    while (streams_->open()) exchange(-1);
    int status = 0;
    rusage usage{};
    while (wait4(id_, &status, 0, &usage) < 0 && errno == EINTR) {
    }
    id_ = -1;
    if (WIFEXITED(status)) outcome_.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) outcome_.signal = WTERMSIG(status);
    outcome_.peak_kibibytes = usage.ru_maxrss;
    return outcome_;
}

Outcome run_spa(const std::vector<std::string>& arguments, const fs::path& folder, const std::string& input,
                const Surroundings& surroundings) {
    return Process(arguments, folder, input, surroundings).wait();
}

Outcome interrupt_spa(const std::vector<std::string>& arguments, const fs::path& folder, int signal) {
    Process process(arguments, folder);
    if (process.until([&] { return !process.so_far().err.empty(); })) kill(process.id(), signal);
    return process.wait();
}

TemporaryFolder::TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "spa-cli-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp() failed");
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

std::vector<std::string> TemporaryFolder::names() const {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path_))
        names.push_back(fs::relative(entry.path(), path_).string());
    std::sort(names.begin(), names.end());
    return names;
}

std::string read_file(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("cannot read " + path.string());
    return {std::istreambuf_iterator<char>(file), {}};
}

void write_file(const fs::path& path, const std::string& bytes) {
    std::ofstream file(path, std::ios::binary);
    file << bytes;
    if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

} // namespace spa::test
