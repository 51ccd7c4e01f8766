// SPDX-License-Identifier: Apache-2.0
// Buffers in memory of their own.
#pragma once

#include "com.h"

#include <cstdint>

namespace spa::dxr {

enum class BufferUse {
    data,      // read by shaders
    structure, // acceleration structures
    scratch,   // of their builds
    upload,    // written by the CPU
};

// size > 0. Throws Error.
Com<ID3D12Resource> make_buffer(ID3D12Device5* device, std::uint64_t size, BufferUse use);

// The smallest multiple of alignment, a power of two, >= value.
constexpr std::uint64_t align(std::uint64_t value, std::uint64_t alignment) {
    return (value + alignment - 1) & ~(alignment - 1);
}

} // namespace spa::dxr
