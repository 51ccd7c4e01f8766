// SPDX-License-Identifier: Apache-2.0
// XXH3, 64 bits, seed 0: the checksum of everything in a `.spa` file. It finds accidents, not attackers.
#pragma once

#include "format.h"

#include <memory>

namespace spa::container {

std::uint64_t checksum(std::span<const std::byte> bytes);

// The checksum of the header, its checksum field (the last 8 bytes) taken as zero, and the table.
std::uint64_t table_checksum(std::span<const std::byte, header_size> header,
                             std::span<const std::byte> table);

// The checksum of bytes that come in pieces. Throws std::bad_alloc when constructed without memory.
class RunningChecksum {
public:
    RunningChecksum();
    ~RunningChecksum();
    RunningChecksum(const RunningChecksum&) = delete;
    RunningChecksum& operator=(const RunningChecksum&) = delete;

    void add(std::span<const std::byte> bytes);
    [[nodiscard]] std::uint64_t value() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace spa::container
