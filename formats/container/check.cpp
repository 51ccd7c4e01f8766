// SPDX-License-Identifier: Apache-2.0
#include "check.h"

#include "load.h"

#include <new>

namespace spa::container {

Status check(std::span<const std::byte> file, const Limits& limits, CheckDepth depth) noexcept {
    try {
        if (file.size() > limits.file_bytes) return at_byte(Issue::too_many_bytes, limits.file_bytes);
        Source source(file);
        Loaded loaded;
        return load_file(source, file.size(), limits, depth,
                         depth == CheckDepth::full ? LoadPart::all : LoadPart::nothing, loaded);
    } catch (const std::bad_alloc&) {
        return at_byte(Issue::out_of_memory, 0);
    }
}

} // namespace spa::container
