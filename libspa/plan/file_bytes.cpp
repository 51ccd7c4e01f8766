// SPDX-License-Identifier: Apache-2.0
#include "file_bytes.h"

#include "../../formats/container/writer.h"
#include "../core/error.h"

namespace spa::plan {

std::uint64_t file_bytes(const SphericalMap& map, bool compress) {
    container::WriteOptions options;
    options.compression = compress ? container::Compression::zstd : container::Compression::none;
    std::vector<std::byte> bytes;
    const container::Status status = container::write(map, options, bytes);
    if (!status.ok())
        throw Error(ExitCode::internal, "a map in memory cannot be written; please report it with the "
                                        "command line");
    return bytes.size();
}

} // namespace spa::plan
