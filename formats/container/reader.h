// SPDX-License-Identifier: Apache-2.0
// Readers of `.spa` files. Safe for any bytes: every function returns a status, none throws, nothing is
// allocated that the limits do not allow, and a file that is not right in every respect asked for gives no
// map at all.
#pragma once

#include "check.h"
#include "format.h"
#include "source.h"

#include <memory>
#include <string>

namespace spa::container {

struct ReadOptions {
    Limits limits = {};
    // full: also every checksum and every code; for files of unknown origin. structure: for files that were
    // checked before; images without compression are then not touched before they are used.
    CheckDepth depth = CheckDepth::full;
    // Map a file instead of reading it: images without compression are used where they lie. The process gets
    // SIGBUS if another one shortens the file meanwhile, and sees what another one writes into it after the
    // check: set false for files that somebody you do not trust can write to.
    bool map_file = true;
};

struct Version {
    std::uint16_t major = 0, minor = 0;
};

// A spherical map and the memory behind its views. Movable; the views stay valid.
class File {
public:
    File() noexcept;
    ~File();
    File(File&&) noexcept;
    File& operator=(File&&) noexcept;
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    // No parts where nothing was read.
    [[nodiscard]] const SphericalMap& map() const;
    [[nodiscard]] Version version() const;
    [[nodiscard]] std::uint64_t length() const; // bytes of the file
    // The section table, unknown sections included.
    [[nodiscard]] std::span<const SectionEntry> sections() const;

    struct Contents;

private:
    friend Status open(const std::string&, File&, const ReadOptions&) noexcept;
    friend Status open(std::span<const std::byte>, File&, const ReadOptions&) noexcept;
    friend Status read(const ReadExactly&, File&, const ReadOptions&) noexcept;
    std::unique_ptr<Contents> contents_;
};

// Opens a file. What is not a regular file (a pipe) is read as a stream. On failure `file` is left empty.
Status open(const std::string& path, File& file, const ReadOptions& options = {}) noexcept;

// Opens a file in memory, which must outlive `file`. Images without compression stay where they are.
Status open(std::span<const std::byte> bytes, File& file, const ReadOptions& options = {}) noexcept;

// Reads a file from a stream, from front to back, and not a byte more than the file has. What follows in the
// stream is the caller's business.
Status read(const ReadExactly& read_exactly, File& file, const ReadOptions& options = {}) noexcept;

// The metadata alone: checks header, table, parts and metadata as a full check does, and touches no image, so
// that it costs microseconds whatever the size of the maps. On failure `metadata` is left empty.
Status read_metadata(const std::string& path, std::string& metadata, const Limits& limits = {}) noexcept;

} // namespace spa::container
