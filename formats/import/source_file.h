// SPDX-License-Identifier: Apache-2.0
// Reading the asset and the files it refers to, without leaving the asset's folder.
#pragma once

#include "import.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace spa::import {

// The whole content of a file. Throws Error: input_output if it cannot be opened or read, is not a regular
// file or is larger than limits.file_bytes.
std::vector<std::byte> read_file(const std::filesystem::path& path, const Limits& limits);

// The record of a file of this content under this name.
SourceFile describe_source(std::string name, std::span<const std::byte> bytes);

// Appends the record unless one of the same name is already there.
void add_source(Report& report, std::string name, std::span<const std::byte> bytes);

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
// file that holds the reference. Does not touch the file system; symbolic links are followed later.
Reference resolve_reference(const std::filesystem::path& asset, std::string_view reference,
                            Encoding encoding);

// %41 becomes 'A'; a '%' that starts no escape stands for itself.
std::string percent_decode(std::string_view text);

} // namespace spa::import
