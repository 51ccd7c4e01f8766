// SPDX-License-Identifier: Apache-2.0
// Runs the built command as a user would: another process, its own streams.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <sys/resource.h>
#include <sys/types.h>
#include <utility>
#include <vector>

namespace spa::test {

struct Outcome {
    int exit_code = -1; // -1 if a signal ended it
    int signal = 0;     // 0 if none did
    std::string out, err;
    long peak_kibibytes = 0; // resident, of the largest of it and its children
};

// In what the process that is started differs from this one.
struct Surroundings {
    std::vector<std::pair<int, rlim_t>> limits = {}; // such as {RLIMIT_AS, bytes}
    bool obeys_permissions = false;                  // also as the superuser
    bool leads_group = false;                        // of processes
    std::vector<int> ignored_signals = {};
    std::vector<int> closed = {}; // of the descriptors 0 to 2
};

// `spa`, started and not waited for.
class Process {
public:
    // With these arguments in `folder`, and `input` on standard input.
    Process(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
            std::string input = "", const Surroundings& surroundings = {});
    ~Process(); // kills it unless wait() has returned
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    [[nodiscard]] pid_t id() const { return id_; }
    // out and err as far as they have arrived.
    [[nodiscard]] const Outcome& so_far() const { return outcome_; }
    // Until the condition holds, which is looked at when something has arrived and each millisecond. False if
    // the process closed its streams before, as it does when it ends.
    bool until(const std::function<bool()>& condition);
    // To its end.
    Outcome wait();

private:
    struct Streams;
    void exchange(int at_most_milliseconds);

    pid_t id_ = -1;
    std::string input_;
    std::unique_ptr<Streams> streams_;
    Outcome outcome_;
};

// Runs `spa` and waits for it.
Outcome run_spa(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                const std::string& input = "", const Surroundings& surroundings = {});

// As run_spa, and sends `signal` as soon as something has arrived on standard error.
Outcome interrupt_spa(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                      int signal);

// A new empty folder, removed with everything in it.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    // Names of everything in it, hidden entries too, sorted, folders with their content as "folder/name".
    [[nodiscard]] std::vector<std::string> names() const;

private:
    std::filesystem::path path_;
};

std::string read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, const std::string& bytes);

} // namespace spa::test
