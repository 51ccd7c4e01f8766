// SPDX-License-Identifier: Apache-2.0
#include "gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

namespace spa::import::gltf {
namespace {

template <class T>
T load(const std::byte* from) {
    T value{};
    std::memcpy(&value, from, sizeof value);
    return value;
}

// glTF 2.0, 3.11 "Animations" holds the equations for normalised integers.
template <class T>
struct Fraction {
    float operator()(T value) const {
        constexpr float top = static_cast<float>(std::numeric_limits<T>::max());
        return std::max(static_cast<float>(value) / top, -1.0F);
    }
};

template <class To>
struct Widen {
    template <class T>
    To operator()(T value) const {
        return static_cast<To>(value);
    }
};

template <class T, class Out, class Convert>
void copy_elements(const Elements& elements, std::span<const std::uint32_t> subset, std::size_t wanted,
                   Out* out, std::size_t out_stride, Convert convert) {
    const std::size_t components = std::min(wanted, elements.components);
    const auto copy_one = [&](std::size_t index, Out* to) {
        const std::byte* from = elements.bytes.data() + index * elements.stride;
        for (std::size_t c = 0; c < components; ++c) to[c] = convert(load<T>(from + c * sizeof(T)));
    };
    if (!subset.empty()) {
        for (std::size_t i = 0; i < subset.size(); ++i) copy_one(subset[i], out + i * out_stride);
        return;
    }
    // The compiler unrolls the inner loop for the common widths.
    if (components == 3 && wanted == 3) {
        const std::byte* from = elements.bytes.data();
        for (std::size_t i = 0; i < elements.count; ++i, from += elements.stride, out += out_stride)
            for (std::size_t c = 0; c < 3; ++c) out[c] = convert(load<T>(from + c * sizeof(T)));
        return;
    }
    for (std::size_t i = 0; i < elements.count; ++i) copy_one(i, out + i * out_stride);
}

template <class T>
void copy_floats(const Elements& elements, std::span<const std::uint32_t> subset, std::size_t wanted,
                 float* out, std::size_t out_stride) {
    if (elements.normalized)
        copy_elements<T>(elements, subset, wanted, out, out_stride, Fraction<T>{});
    else
        copy_elements<T>(elements, subset, wanted, out, out_stride, Widen<float>{});
}

void zero(std::size_t count, std::size_t wanted, float* out, std::size_t out_stride) {
    for (std::size_t i = 0; i < count; ++i) std::fill_n(out + i * out_stride, wanted, 0.0F);
}

std::vector<std::uint32_t> sparse_indices(const tinygltf::Accessor& accessor, Buffers& buffers,
                                          const Context& context) {
    const auto count = static_cast<std::size_t>(accessor.sparse.count);
    const auto size = static_cast<std::size_t>(
        tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.sparse.indices.componentType)));
    const auto offset = static_cast<std::size_t>(accessor.sparse.indices.byteOffset);
    const auto view = static_cast<std::size_t>(accessor.sparse.indices.bufferView);
    std::vector<std::uint32_t> indices(count);
    read_integers(
        {buffers.view(view).subspan(offset), size, count, accessor.sparse.indices.componentType, 1, false},
        {}, 1, indices.data(), 1);
    for (std::size_t i = 0; i < count; ++i)
        if (indices[i] >= accessor.count || (i > 0 && indices[i] <= indices[i - 1]))
            fail(context, at("bufferViews", view),
                 "sparse index " + std::to_string(indices[i]) + " at position " + std::to_string(i) +
                     " is out of range or not ascending (" + std::to_string(accessor.count) + " elements)");
    return indices;
}

void apply_sparse(const tinygltf::Accessor& accessor, Buffers& buffers, std::size_t wanted, float* out,
                  std::size_t out_stride, const Context& context) {
    const std::vector<std::uint32_t> indices = sparse_indices(accessor, buffers, context);
    Elements values = elements_of(accessor, buffers);
    const auto view = static_cast<std::size_t>(accessor.sparse.values.bufferView);
    values.bytes = buffers.view(view).subspan(static_cast<std::size_t>(accessor.sparse.values.byteOffset));
    values.stride = values.components * static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(
                                            static_cast<std::uint32_t>(accessor.componentType)));
    values.count = indices.size();
    std::vector<float> replaced(indices.size() * wanted);
    read_floats(values, {}, wanted, replaced.data(), wanted);
    for (std::size_t i = 0; i < indices.size(); ++i)
        std::copy_n(replaced.begin() + static_cast<std::ptrdiff_t>(i * wanted),
                    std::min(wanted, values.components), out + indices[i] * out_stride);
}

} // namespace

Elements elements_of(const tinygltf::Accessor& accessor, Buffers& buffers) {
    Elements elements;
    elements.count = accessor.count;
    elements.component_type = accessor.componentType;
    elements.components =
        static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
    elements.normalized = accessor.normalized;
    elements.stride = elements.components * static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(
                                                static_cast<std::uint32_t>(accessor.componentType)));
    if (accessor.bufferView >= 0) {
        const auto view = static_cast<std::size_t>(accessor.bufferView);
        elements.bytes = buffers.view(view).subspan(accessor.byteOffset);
        if (buffers.stride(view) != 0) elements.stride = buffers.stride(view);
    }
    return elements;
}

void read_floats(const Elements& elements, std::span<const std::uint32_t> subset, std::size_t wanted,
                 float* out, std::size_t out_stride) {
    if (elements.bytes.empty()) {
        zero(subset.empty() ? elements.count : subset.size(), std::min(wanted, elements.components), out,
             out_stride);
        return;
    }
    // Floats side by side on both sides are most of what real files hold.
    const bool packed = wanted == elements.components && out_stride == wanted &&
                        elements.stride == wanted * sizeof(float) && subset.empty();
    if (elements.component_type == TINYGLTF_COMPONENT_TYPE_FLOAT && packed) {
        std::memcpy(out, elements.bytes.data(), elements.count * elements.stride);
        return;
    }
    switch (elements.component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
        return copy_floats<std::int8_t>(elements, subset, wanted, out, out_stride);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return copy_floats<std::uint8_t>(elements, subset, wanted, out, out_stride);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
        return copy_floats<std::int16_t>(elements, subset, wanted, out, out_stride);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return copy_floats<std::uint16_t>(elements, subset, wanted, out, out_stride);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
        return copy_floats<std::uint32_t>(elements, subset, wanted, out, out_stride);
    default: return copy_elements<float>(elements, subset, wanted, out, out_stride, Widen<float>{});
    }
}

void read_floats(const tinygltf::Accessor& accessor, Buffers& buffers, std::span<const std::uint32_t> subset,
                 std::size_t wanted, float* out, std::size_t out_stride, const Context& context) {
    const Elements elements = elements_of(accessor, buffers);
    if (!accessor.sparse.isSparse) {
        read_floats(elements, subset, wanted, out, out_stride);
        return;
    }
    if (subset.empty()) {
        read_floats(elements, subset, wanted, out, out_stride);
        apply_sparse(accessor, buffers, wanted, out, out_stride, context);
        return;
    }
    const std::size_t components = std::min(wanted, elements.components);
    std::vector<float> all(elements.count * components);
    read_floats(elements, {}, components, all.data(), components);
    apply_sparse(accessor, buffers, components, all.data(), components, context);
    for (std::size_t i = 0; i < subset.size(); ++i)
        std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(subset[i] * components), components,
                    out + i * out_stride);
}

void read_integers(const Elements& elements, std::span<const std::uint32_t> subset, std::size_t wanted,
                   std::uint32_t* out, std::size_t out_stride) {
    constexpr Widen<std::uint32_t> widen;
    if (elements.bytes.empty()) {
        const std::size_t count = subset.empty() ? elements.count : subset.size();
        for (std::size_t i = 0; i < count; ++i) std::fill_n(out + i * out_stride, wanted, 0U);
        return;
    }
    switch (elements.component_type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return copy_elements<std::uint8_t>(elements, subset, wanted, out, out_stride, widen);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return copy_elements<std::uint16_t>(elements, subset, wanted, out, out_stride, widen);
    default: return copy_elements<std::uint32_t>(elements, subset, wanted, out, out_stride, widen);
    }
}

} // namespace spa::import::gltf
