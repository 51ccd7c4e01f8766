// SPDX-License-Identifier: Apache-2.0
#include "gnuplot.h"

#include "../libspa/core/error.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace spa::tools {

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { (void)std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

File temporary_file() {
    File file(std::tmpfile());
    if (!file) throw Error(ExitCode::input_output, "no temporary file for gnuplot can be made");
    return file;
}

struct Actions {
    posix_spawn_file_actions_t list{};
    Actions() { posix_spawn_file_actions_init(&list); }
    ~Actions() { posix_spawn_file_actions_destroy(&list); }
    Actions(const Actions&) = delete;
    Actions& operator=(const Actions&) = delete;
};

} // namespace

std::string gnuplot_text(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
    return quoted + "'";
}

std::vector<std::byte> run_gnuplot(const std::string& script) {
    const File in = temporary_file();
    const File out = temporary_file();
    if (std::fwrite(script.data(), 1, script.size(), in.get()) != script.size() || std::fflush(in.get()) != 0)
        throw Error(ExitCode::input_output, "the script for gnuplot cannot be written");
    std::rewind(in.get());
    Actions actions;
    posix_spawn_file_actions_adddup2(&actions.list, fileno(in.get()), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions.list, fileno(out.get()), STDOUT_FILENO);
    std::string name = "gnuplot";
    std::array<char*, 2> arguments{name.data(), nullptr};
    pid_t child = 0;
    const int failure = posix_spawnp(&child, name.c_str(), &actions.list, nullptr, arguments.data(), environ);
    if (failure != 0)
        throw Error(ExitCode::unsupported,
                    "plots need gnuplot, which is not found (Debian: apt-get install gnuplot-nox)");
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        throw Error(WIFEXITED(status) && WEXITSTATUS(status) == 127 ? ExitCode::unsupported
                                                                    : ExitCode::internal,
                    "gnuplot failed");
    std::vector<std::byte> bytes;
    std::array<std::byte, 65536> block{};
    std::rewind(out.get());
    for (std::size_t n = 0; (n = std::fread(block.data(), 1, block.size(), out.get())) > 0;)
        bytes.insert(bytes.end(), block.begin(), block.begin() + std::ptrdiff_t(n));
    return bytes;
}

void require_gnuplot() { (void)run_gnuplot("exit\n"); }

} // namespace spa::tools
