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

// Only calls that are allowed between fork and exec.
[[noreturn]] void become_spa(const std::vector<char*>& arguments, const char* folder, const Pipe& in,
                             const Pipe& out, const Pipe& err) {
    dup2(in.read_end, STDIN_FILENO);
    dup2(out.write_end, STDOUT_FILENO);
    dup2(err.write_end, STDERR_FILENO);
    for (const Pipe* pipe : {&in, &out, &err}) {
        close(pipe->read_end);
        close(pipe->write_end);
    }
    if (chdir(folder) == 0) execv(SPA_BINARY, arguments.data());
    _exit(127);
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

// Both at once: a process that fills one pipe while the other is waited for would hang.
void exchange(Pipe& in, Pipe& out, Pipe& err, std::string_view input, Outcome& outcome, pid_t child,
              int signal_on_stderr) {
    while (out.read_end >= 0 || err.read_end >= 0) {
        if (input.empty()) Pipe::close_end(in.write_end);
        std::array<pollfd, 3> waiting{
            {{out.read_end, POLLIN, 0}, {err.read_end, POLLIN, 0}, {in.write_end, POLLOUT, 0}}};
        if (poll(waiting.data(), waiting.size(), -1) < 0) continue;
        if (waiting[0].revents != 0 && !read_some(out.read_end, outcome.out)) Pipe::close_end(out.read_end);
        if (waiting[1].revents != 0 && !read_some(err.read_end, outcome.err)) Pipe::close_end(err.read_end);
        if (waiting[2].revents != 0) {
            const ssize_t written =
                write(in.write_end, input.data(), std::min<std::size_t>(input.size(), 4096));
            input.remove_prefix(written < 0 ? input.size() : std::size_t(written));
        }
        if (signal_on_stderr != 0 && !outcome.err.empty()) {
            kill(child, signal_on_stderr);
            signal_on_stderr = 0;
        }
    }
}

Outcome run(const std::vector<std::string>& arguments, const fs::path& folder, std::string_view input,
            int signal) {
    std::signal(SIGPIPE, SIG_IGN); // the command may end without reading its input
    std::vector<std::string> texts{"spa"};
    texts.insert(texts.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    pointers.reserve(texts.size() + 1);
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);

    Pipe in;
    Pipe out;
    Pipe err;
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("fork() failed");
    if (child == 0) become_spa(pointers, folder.c_str(), in, out, err);
    Pipe::close_end(in.read_end);
    Pipe::close_end(out.write_end);
    Pipe::close_end(err.write_end);

    Outcome outcome;
    exchange(in, out, err, input, outcome, child, signal);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
    return outcome;
}

} // namespace

Outcome run_spa(const std::vector<std::string>& arguments, const fs::path& folder, const std::string& input) {
    return run(arguments, folder, input, 0);
}

Outcome interrupt_spa(const std::vector<std::string>& arguments, const fs::path& folder, int signal) {
    return run(arguments, folder, "", signal);
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
