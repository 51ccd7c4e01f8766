// SPDX-License-Identifier: Apache-2.0
// One file, or more, for each numbered issue.
#pragma once

#include "file_parts.h"

#include "../../formats/container/limits.h"
#include "../../formats/container/status.h"
#include "../../libspa/core/folds.h"

#include <functional>
#include <map>

namespace spa::test {

// One part of 4 cells a side, two layers with three crossings at each sample but those of a hole, META at
// section 1, MIXD and FOLD last, no compression.
FileBytes good_file();

// The same with something changed by `edit(FileParts&)`.
template <class Edit>
FileBytes edited(const FileBytes& file, Edit edit) {
    FileParts parts = take_apart(file);
    edit(parts);
    return put_together(parts);
}

// The depth of layer 0 stored by this scheme. The filtered one is then another image.
FileBytes compressed_file(container::Scheme scheme);

// A last section "XTRA" of a kind that no reader knows.
FileBytes with_unknown_section(std::uint32_t flags, std::uint16_t minor = container::version_minor);

// The same with a value at an offset of the entry of the section of a type that is there once.
FileBytes with_entry_value(std::uint32_t type, std::size_t field, std::uint32_t value);

// The same with these records and all triangles mixed but those of these bits.
FileBytes with_folds(const std::vector<FoldRecord>& records, const std::vector<std::uint64_t>& pure = {});

// Depths as f32, the middle one of layer 0 as given.
FileBytes with_f32_depth(float value);

// Files that a checker with default limits refuses with exactly this issue.
using Fixtures = std::multimap<container::Issue, std::function<FileBytes()>>;
Fixtures file_fixtures();
// Those of them that are about fold records.
Fixtures fold_fixtures();

// Limits under which good_file() is refused with exactly this issue.
std::map<container::Issue, container::Limits> limit_fixtures();

} // namespace spa::test
