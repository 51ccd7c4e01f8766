// SPDX-License-Identifier: Apache-2.0
// Loads and stores of little-endian values at any address, on any machine.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace spa::container {

namespace detail {
template <std::size_t size>
struct UnsignedOf;
template <>
struct UnsignedOf<1> {
    using Type = std::uint8_t;
};
template <>
struct UnsignedOf<2> {
    using Type = std::uint16_t;
};
template <>
struct UnsignedOf<4> {
    using Type = std::uint32_t;
};
template <>
struct UnsignedOf<8> {
    using Type = std::uint64_t;
};
} // namespace detail

// T: an integer or floating-point type of 1, 2, 4 or 8 bytes. `in` holds sizeof(T) bytes.
template <class T>
T load(const std::byte* in) {
    static_assert(std::is_arithmetic_v<T>);
    using Bits = typename detail::UnsignedOf<sizeof(T)>::Type;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) bits |= std::to_integer<std::uint64_t>(in[i]) << (8 * i);
    return std::bit_cast<T>(Bits(bits));
}

template <class T>
void store(std::byte* out, T value) {
    static_assert(std::is_arithmetic_v<T>);
    using Bits = typename detail::UnsignedOf<sizeof(T)>::Type;
    const auto bits = std::uint64_t(std::bit_cast<Bits>(value));
    for (std::size_t i = 0; i < sizeof(T); ++i) out[i] = std::byte((bits >> (8 * i)) & 0xFFU);
}

} // namespace spa::container
