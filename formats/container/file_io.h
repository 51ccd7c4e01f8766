// SPDX-License-Identifier: Apache-2.0
// Files as the container needs them. One implementation for POSIX, one with nothing but the standard library.
#pragma once

#include "source.h"
#include "status.h"

#include <memory>
#include <string>

namespace spa::container {

// An open file, closed by its destructor.
class InputFile {
public:
    virtual ~InputFile() = default;
    InputFile() = default;
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    // A regular file has a size; a pipe or a device can only be read in order.
    [[nodiscard]] virtual bool is_regular() const = 0;
    [[nodiscard]] virtual std::uint64_t size() const = 0;
    // The whole file mapped into memory for as long as this object lives; empty where that is not possible.
    virtual std::span<const std::byte> map() = 0;
    // The next out.size() bytes; false at the end of the file or on an error.
    virtual bool read(std::span<std::byte> out) = 0;
    // The system's error of the last read; 0 where there was none (the end of the file is none).
    [[nodiscard]] virtual int error() const = 0;
};

// Sets `file`; cannot_open with the system's error otherwise. May throw std::bad_alloc.
Status open_input(const std::string& path, std::unique_ptr<InputFile>& file);

// Writes the pieces one after the other into a new file beside `path`, flushes it to the disk and renames it
// to `path`, replacing what was there. On failure (cannot_write with the system's error) `path` is as it was
// and nothing is left behind. If `path` is a device or a pipe it is written to directly.
Status write_file(const std::string& path, std::span<const std::span<const std::byte>> pieces);

} // namespace spa::container
