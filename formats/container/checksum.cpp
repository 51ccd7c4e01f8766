// SPDX-License-Identifier: Apache-2.0
#include "checksum.h"

#include <algorithm>

// Inlined, so that users of the library need no xxhash of their own.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace spa::container {

struct RunningChecksum::State {
    XXH3_state_t xxh;
};

RunningChecksum::RunningChecksum() : state_(std::make_unique<State>()) { XXH3_64bits_reset(&state_->xxh); }
RunningChecksum::~RunningChecksum() = default;

void RunningChecksum::add(std::span<const std::byte> bytes) {
    XXH3_64bits_update(&state_->xxh, bytes.data(), bytes.size());
}
std::uint64_t RunningChecksum::value() const { return XXH3_64bits_digest(&state_->xxh); }

std::uint64_t checksum(std::span<const std::byte> bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

std::uint64_t table_checksum(std::span<const std::byte, header_size> header,
                             std::span<const std::byte> table) {
    constexpr std::size_t field_size = 8;
    constexpr std::array<std::byte, field_size> zero{};
    RunningChecksum sum;
    sum.add(header.first(header_size - field_size));
    sum.add(zero);
    sum.add(table);
    return sum.value();
}

} // namespace spa::container
