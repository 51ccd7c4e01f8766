// SPDX-License-Identifier: Apache-2.0
// Reading the asset and the files it refers to, without leaving the asset's folder.
#pragma once

#include "import.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spa::import {

// A file as it was read.
struct FileContent {
    std::vector<std::byte> bytes;
    FileState state;
};

inline constexpr std::uint64_t whole_file = std::numeric_limits<std::uint64_t>::max();

// The content of a file, or its first `most` bytes. Throws Error: input_output if there is none, it cannot be
// opened or read, is not a regular file, changes meanwhile or has more than limits.file_bytes to read.
FileContent read_file(const std::filesystem::path& path, const Limits& limits,
                      std::uint64_t most = whole_file);

// The asset: the file that the user named.
struct Asset {
    std::filesystem::path path;
    FileContent file;
    std::filesystem::path real_folder; // of the path, symbolic links resolved; references stay inside
};

// Appends the warning unless the same text is already there. A report holds so many and then a line that says
// that there are more: a damaged file can give one for each of its bytes.
inline constexpr std::size_t max_warnings = 100;
void add_warning(Report& report, std::string warning);

// Where a reference inside an asset leads.
struct Reference {
    std::string name;           // decoded, '/' as separator, relative to the asset's folder
    std::filesystem::path path; // the asset's folder / name
};

// A reference is a percent-encoded URI (glTF) or a plain file name (MTL).
enum class Encoding { uri, file_name };

// Where a reference leads; '/' and '\' both separate. A '%' that starts no escape stands for itself. Throws
// Error(invalid_data) for an empty reference, an absolute path, a path that climbs out of the folder with
// "..", a drive letter, a URL and a control character. The message starts with `asset`, the path of the
// file that holds the reference. Does not touch the file system.
Reference resolve_reference(const std::filesystem::path& asset, std::string_view reference,
                            Encoding encoding);

// How many different files an asset may refer to.
inline constexpr std::size_t max_references = 16384;

// The files that an asset refers to, as they are read.
class References {
public:
    // Records the asset as the first source. All arguments outlive this.
    References(const Asset& asset, const Limits& limits, Report& report);

    // The content of the file that a reference leads to, which is recorded as a source; nothing if there is
    // no such file. Throws Error: invalid_data if symbolic links lead out of the asset's folder and
    // limits.follow_links is not set and for more than max_references files, input_output as read_file does
    // and when more than limits.total_bytes are read in all.
    std::optional<FileContent> read(const Reference& reference);

    // The same of the first `most` bytes of a file that is no source.
    std::optional<FileContent> read_head(const Reference& reference, std::uint64_t most);

    // Records a name under which there is no file.
    void add_missing(const std::string& name);

private:
    std::optional<FileContent> read(const Reference& reference, std::uint64_t most);
    void add_source(std::string name, const FileContent& file);
    void check_count() const;

    const Asset& asset_;
    const Limits& limits_;
    Report& report_;
    std::uint64_t bytes_; // read so far
};

// %41 becomes 'A'; a '%' that starts no escape stands for itself.
std::string percent_decode(std::string_view text);

} // namespace spa::import
