// SPDX-License-Identifier: Apache-2.0
// Where the bytes of a `.spa` file come from: memory, or something that delivers them in order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace spa::container {

// Fills `out` with the next out.size() bytes. Returns false where there are fewer, or on an error.
using ReadExactly = std::function<bool(std::span<std::byte> out)>;

// Bytes that are a view of something that lives long enough, or held here.
struct Bytes {
    std::span<const std::byte> view;
    std::vector<std::byte> held; // empty, or what `view` shows; a move keeps the address
};

// Reads a file from front to back, once.
class Source {
public:
    explicit Source(std::span<const std::byte> file) : file_(file) {}
    explicit Source(const ReadExactly& read) : read_(&read) {}

    // The next `count` bytes. False where the source ends before; `out` then has what there was, if that is
    // known. Memory is taken as the bytes arrive, not as they are announced. May throw std::bad_alloc.
    bool take(std::uint64_t count, Bytes& out);
    // Whether the source is a stream: it cannot say how long it is.
    [[nodiscard]] bool is_stream() const { return read_ != nullptr; }
    [[nodiscard]] std::uint64_t position() const { return position_; }

private:
    bool take_from_stream(std::uint64_t count, std::vector<std::byte>& out);

    std::span<const std::byte> file_;
    const ReadExactly* read_ = nullptr;
    std::uint64_t position_ = 0;
};

} // namespace spa::container
