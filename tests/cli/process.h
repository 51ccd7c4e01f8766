// SPDX-License-Identifier: Apache-2.0
// Runs the built command as a user would: another process, its own streams.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace spa::test {

struct Outcome {
    int exit_code = -1; // -1 if a signal ended it
    int signal = 0;     // 0 if none did
    std::string out, err;
};

// Runs `spa` with these arguments in `folder`, with `input` on standard input, and waits for it.
Outcome run_spa(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                const std::string& input = "");

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
