// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace spa::test {

// The words of a SPIR-V file. Throws Error{internal} if it cannot be read.
std::vector<std::uint32_t> read_spirv(const std::filesystem::path& path);

} // namespace spa::test
