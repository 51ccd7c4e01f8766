// SPDX-License-Identifier: Apache-2.0
// The one pass over a `.spa` file behind the checker and the readers.
#pragma once

#include "check.h"
#include "source.h"
#include "structure.h"

namespace spa::container {

// A read file: the map's views point into `buffers`, or into the memory that the source was made of.
struct Loaded {
    Structure structure;
    SphericalMap map;
    std::vector<std::vector<std::byte>> buffers;
};

// What to read after the structure has been checked.
enum class LoadPart : std::uint8_t {
    nothing,
    metadata, // with its checksum; of the images nothing is checked
    all,
};

// Reads and checks. On failure `loaded` is unspecified. Throws std::bad_alloc.
Status load_file(Source& source, std::uint64_t source_size, const Limits& limits, CheckDepth depth,
                 LoadPart part, Loaded& loaded);

// The size of a source that cannot say.
constexpr std::uint64_t unknown_size = UINT64_MAX;

} // namespace spa::container
