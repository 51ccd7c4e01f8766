// SPDX-License-Identifier: Apache-2.0
#include "spirv_file.h"

#include "../../libspa/core/error.h"

#include <fstream>

namespace spa::test {

std::vector<std::uint32_t> read_spirv(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    const auto bytes = file ? std::streamoff(file.tellg()) : 0;
    std::vector<std::uint32_t> words(std::size_t(bytes) / sizeof(std::uint32_t));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(words.data()), bytes);
    if (!file || words.empty()) throw Error(ExitCode::internal, path.string() + ": cannot be read");
    return words;
}

} // namespace spa::test
