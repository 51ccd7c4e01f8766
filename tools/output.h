// SPDX-License-Identifier: Apache-2.0
// Files and folders that appear whole or not at all: written under a temporary name in the folder they are
// meant for, then renamed. POSIX.
#pragma once

#include "../libspa/core/error.h"

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spa::tools {

// What the system says against an output. Everything here throws it where Error{input_output} is said.
class OutputError : public Error {
public:
    // number: of <cerrno>; 0 = none.
    OutputError(const std::string& message, int number)
        : Error(ExitCode::input_output, message), number_(number) {}
    // The place is full, read-only or broken: the next output there will fare no better.
    [[nodiscard]] bool concerns_all() const;

private:
    int number_;
};

// Whether the folder of an output has to be there, or will be made (make_folders_of).
enum class OutputFolder : bool { is_there, is_made };

// Says before any work starts what would go wrong after it. Throws Error: input_output if the folder is
// missing or may not be written to (is_made: the first one above that is there), or if `path` is something
// other than a regular file; usage if it is the same file as one of `inputs`.
void check_output_file(const std::filesystem::path& path, std::span<const std::filesystem::path> inputs = {},
                       OutputFolder folder = OutputFolder::is_there);

// Makes the folder of `path`, and those above it, as far as they are missing. Safe beside others that do the
// same. Throws Error{input_output}.
void make_folders_of(const std::filesystem::path& path);

// As check_output_file, for a folder that may exist already.
void check_output_folder(const std::filesystem::path& path);

// A temporary file beside `path`, removed unless committed. It stays locked (flock) until then, so that
// remove_leftovers of another process can tell it from what a killed one left behind.
class StagedFile {
public:
    explicit StagedFile(std::filesystem::path path); // throws Error{input_output}
    ~StagedFile();
    StagedFile(const StagedFile&) = delete;
    StagedFile& operator=(const StagedFile&) = delete;

    [[nodiscard]] const std::filesystem::path& temporary_path() const { return temporary_; }
    // Replaces what the temporary file holds. Throws Error{input_output}.
    void write(std::span<const std::byte> bytes);
    // Renames to `path`, replacing what is there. Throws Error{input_output}.
    void commit();

private:
    std::filesystem::path path_, temporary_;
    int descriptor_ = -1;
};

// Removes the temporary files of StagedFile in `folder` whose process is gone. `is_ours`: whether files of
// this final name are to be looked at; the name is cut as StagedFile cuts it. Errors are nobody's business.
void remove_leftovers(const std::filesystem::path& folder,
                      const std::function<bool(const std::string& final_name)>& is_ours);
// As far as StagedFile keeps a name.
std::string staged_name(const std::string& final_name);

// A temporary folder beside `path`, or inside it if it exists; removed with all it holds unless committed.
class StagedFolder {
public:
    explicit StagedFolder(const std::filesystem::path& path); // throws Error{input_output}
    ~StagedFolder();
    StagedFolder(const StagedFolder&) = delete;
    StagedFolder& operator=(const StagedFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& temporary_path() const { return temporary_; }
    // name: a plain file name. Throws Error{input_output}.
    void write(const std::string& name, std::span<const std::byte> bytes);
    // One rename for a new folder; one a file for a folder that was there. Throws Error{input_output}.
    void commit();

private:
    std::filesystem::path path_, temporary_;
    bool exists_;
    std::vector<std::string> names_;
};

// Writes to stdout and makes sure that it arrived. Throws Error{input_output}.
void print(std::string_view text);

} // namespace spa::tools
