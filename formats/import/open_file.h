// SPDX-License-Identifier: Apache-2.0
// A regular file opened for reading, which does not change while it is read.
#pragma once

#include "import.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace spa::import {

// Everything is asked of the descriptor, never of the name again: what is judged is what is read.
class OpenFile {
public:
    // Nothing if there is no such file. Throws Error(input_output) if it cannot be opened or is not a regular
    // file; never waits, as opening a pipe would.
    static std::optional<OpenFile> open(const std::filesystem::path& path);

    OpenFile(OpenFile&& other) noexcept;
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    OpenFile& operator=(OpenFile&&) = delete;
    ~OpenFile();

    // As it was when it was opened.
    [[nodiscard]] const FileState& state() const { return state_; }

    // Where the file is, symbolic links resolved; empty if the system does not say.
    [[nodiscard]] std::filesystem::path real_path() const;

    // The first `most` bytes, all if there are fewer. Throws Error(input_output) if they cannot be read or
    // the file is no longer as it was when it was opened.
    [[nodiscard]] std::vector<std::byte> read(std::uint64_t most) const;

private:
    OpenFile(std::filesystem::path path, int descriptor);

    std::filesystem::path path_;
    int descriptor_;
    FileState state_;
};

// Where a folder is, symbolic links resolved; empty if there is none of this name.
std::filesystem::path real_folder(const std::filesystem::path& folder);

} // namespace spa::import
