// SPDX-License-Identifier: Apache-2.0
// Files and folders that appear whole or not at all: written under a temporary name in the folder they are
// meant for, then renamed. POSIX.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spa::tools {

// Says before any work starts what would go wrong after it. Throws Error: input_output if the folder is
// missing or may not be written to, or if `path` is something other than a regular file; usage if it is the
// same file as one of `inputs`.
void check_output_file(const std::filesystem::path& path, std::span<const std::filesystem::path> inputs = {});

// As check_output_file, for a folder that may exist already.
void check_output_folder(const std::filesystem::path& path);

// A temporary file beside `path`, removed unless committed.
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
};

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
