// SPDX-License-Identifier: Apache-2.0
#include "gltf_check_values.h"

#include "gltf_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace spa::import::gltf {
namespace {

constexpr std::size_t most_components = 16;

struct Bounds {
    std::array<double, most_components> lower{}, upper{};
};

template <class T>
Bounds bounds_of(const Elements& elements) {
    std::array<T, most_components> lower{}, upper{};
    std::memcpy(lower.data(), elements.bytes.data(), elements.components * sizeof(T));
    upper = lower;
    const std::byte* from = elements.bytes.data();
    for (std::size_t i = 0; i < elements.count; ++i, from += elements.stride)
        for (std::size_t c = 0; c < elements.components; ++c) {
            T value{};
            std::memcpy(&value, from + c * sizeof(T), sizeof value);
            lower[c] = std::min(lower[c], value);
            upper[c] = std::max(upper[c], value);
        }
    Bounds bounds;
    for (std::size_t c = 0; c < elements.components; ++c) {
        bounds.lower[c] = static_cast<double>(lower[c]);
        bounds.upper[c] = static_cast<double>(upper[c]);
    }
    return bounds;
}

Bounds bounds_of(const Elements& elements) {
    switch (elements.component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return bounds_of<std::int8_t>(elements);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return bounds_of<std::uint8_t>(elements);
    case TINYGLTF_COMPONENT_TYPE_SHORT: return bounds_of<std::int16_t>(elements);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return bounds_of<std::uint16_t>(elements);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return bounds_of<std::uint32_t>(elements);
    default: return bounds_of<float>(elements);
    }
}

// Exporters print bounds with few digits, so a small part of the extent is forgiven.
bool differs(std::span<const double> claimed, const std::array<double, most_components>& found,
             const Bounds& bounds) {
    for (std::size_t c = 0; c < claimed.size() && c < most_components; ++c) {
        const double extent = bounds.upper[c] - bounds.lower[c];
        const double slack = 1e-4 * std::max(extent, std::abs(found[c]));
        if (!(std::abs(claimed[c] - found[c]) <= slack)) return true;
    }
    return false;
}

} // namespace

bool CheckBudget::spend(std::uint64_t numbers) {
    if (numbers <= left_) {
        left_ -= numbers;
        return true;
    }
    warn(context_, "accessors", "share more data than is checked; some of their values are not");
    return false;
}

void check_bounds(const tinygltf::Model& model, Buffers& buffers, CheckBudget& budget,
                  const Context& context) {
    for (std::size_t i = 0; i < model.accessors.size(); ++i) {
        const tinygltf::Accessor& accessor = model.accessors[i];
        if (accessor.bufferView < 0 || accessor.sparse.isSparse) continue;
        if (accessor.minValues.empty() && accessor.maxValues.empty()) continue;
        const Elements elements = elements_of(accessor, buffers);
        if (!budget.spend(elements.count * elements.components)) return;
        const Bounds bounds = bounds_of(elements);
        // Integers are checked where they are used; normalised ones may state their bounds either way.
        if (accessor.normalized) continue;
        if (differs(accessor.minValues, bounds.lower, bounds))
            warn(context, at("accessors", i) + ".min", "is not the minimum of its elements");
        if (differs(accessor.maxValues, bounds.upper, bounds))
            warn(context, at("accessors", i) + ".max", "is not the maximum of its elements");
    }
}

void check_colors(const tinygltf::Model& model, Buffers& buffers, CheckBudget& budget,
                  const Context& context) {
    std::vector<bool> seen(model.accessors.size());
    for (const tinygltf::Mesh& mesh : model.meshes)
        for (const tinygltf::Primitive& primitive : mesh.primitives)
            for (const auto& [name, index] : primitive.attributes) {
                const auto i = static_cast<std::size_t>(index);
                const tinygltf::Accessor& accessor = model.accessors[i];
                if (name.rfind("COLOR_", 0) != 0 || seen[i]) continue;
                seen[i] = true;
                if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT || accessor.bufferView < 0)
                    continue;
                const Elements elements = elements_of(accessor, buffers);
                if (!budget.spend(elements.count * elements.components)) return;
                const Bounds bounds = bounds_of(elements);
                if (*std::min_element(bounds.lower.begin(), bounds.lower.end()) < 0.0 ||
                    *std::max_element(bounds.upper.begin(), bounds.upper.end()) > 1.0)
                    warn(context, at("accessors", i), "holds " + name + " with values outside [0, 1]");
            }
}

void check_animation_times(const Json& document, const tinygltf::Model& model, Buffers& buffers,
                           CheckBudget& budget, const Context& context) {
    const Json& animations = member_of(document, "animations");
    for (std::size_t i = 0; i < animations.size(); ++i) {
        const Json& samplers = animations[i]["samplers"];
        for (std::size_t j = 0; j < samplers.size(); ++j) {
            const tinygltf::Accessor& accessor = model.accessors[integer_of(samplers[j], "input")];
            const std::string where = at("animations", i) + "." + at("samplers", j) + ".input";
            if (accessor.type != TINYGLTF_TYPE_SCALAR ||
                accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) {
                warn(context, where, "is not a SCALAR of floats");
                continue;
            }
            if (accessor.bufferView < 0 || accessor.sparse.isSparse) continue;
            if (!budget.spend(accessor.count)) return;
            std::vector<float> times(accessor.count);
            read_floats(elements_of(accessor, buffers), {}, 1, times.data(), 1);
            if (times.front() < 0) warn(context, where, "has a negative time");
            if (std::adjacent_find(times.begin(), times.end(), [](float a, float b) { return !(a < b); }) !=
                times.end())
                warn(context, where, "has times that do not grow");
        }
    }
}

} // namespace spa::import::gltf
