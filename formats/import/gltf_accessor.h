// SPDX-License-Identifier: Apache-2.0
// Elements of accessors as floats or indices: any component type, stride, normalisation and sparse values.
#pragma once

#include "gltf_buffers.h"
#include "tinygltf.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace spa::import::gltf {

// Elements in memory that are not (all) described by an accessor's own view, e.g. decoded by Draco.
struct Elements {
    std::span<const std::byte> bytes; // empty: all zero
    std::size_t stride = 0;
    std::size_t count = 0;
    int component_type = TINYGLTF_COMPONENT_TYPE_FLOAT;
    std::size_t components = 1;
    bool normalized = false;
};

// The elements of an accessor, without its sparse values. The accessor passed check_accessors.
Elements elements_of(const tinygltf::Accessor& accessor, Buffers& buffers);

// Writes `wanted` floats of each element at out, out + out_stride, ... A component that the element lacks is
// left as it is. `subset`: the indices of the elements to read, in order; empty: all.
void read_floats(const Elements& elements, std::span<const std::uint32_t> subset, std::size_t wanted,
                 float* out, std::size_t out_stride);

// The same for an accessor, sparse values included.
void read_floats(const tinygltf::Accessor& accessor, Buffers& buffers, std::span<const std::uint32_t> subset,
                 std::size_t wanted, float* out, std::size_t out_stride, const Context& context);

// Integers as they are: joints. Wants an integer component type.
void read_integers(const Elements& elements, std::span<const std::uint32_t> subset, std::size_t wanted,
                   std::uint32_t* out, std::size_t out_stride);

} // namespace spa::import::gltf
