// SPDX-License-Identifier: Apache-2.0
// One file, or more, for each numbered issue.
#pragma once

#include "file_parts.h"

#include "../../formats/container/limits.h"
#include "../../formats/container/status.h"

#include <functional>
#include <map>

namespace spa::test {

// One part, two layers, META at section 1, no compression.
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

// A last section "FOLD" of a kind that no reader knows.
FileBytes with_unknown_section(std::uint32_t flags, std::uint16_t minor = container::version_minor);

// Depths as f32, the middle one of layer 0 as given.
FileBytes with_f32_depth(float value);

// Files that a checker with default limits refuses with exactly this issue.
std::multimap<container::Issue, std::function<FileBytes()>> file_fixtures();

// Limits under which good_file() is refused with exactly this issue.
std::map<container::Issue, container::Limits> limit_fixtures();

} // namespace spa::test
