// SPDX-License-Identifier: Apache-2.0
// Small glTF documents made on the spot.
#pragma once

#include "../import_mesh/scratch.h"

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace spa::test {

using Json = nlohmann::json;
using import::Result;

template <class T>
constexpr int component_type = 0;
template <>
inline constexpr int component_type<std::int8_t> = 5120;
template <>
inline constexpr int component_type<std::uint8_t> = 5121;
template <>
inline constexpr int component_type<std::int16_t> = 5122;
template <>
inline constexpr int component_type<std::uint16_t> = 5123;
template <>
inline constexpr int component_type<std::uint32_t> = 5125;
template <>
inline constexpr int component_type<float> = 5126;

class GltfBuilder {
public:
    Json json{{"asset", {{"version", "2.0"}}}}; // buffers are added by text() and glb()

    // Appends bytes, aligned to 4, and a buffer view of them; returns its index.
    int add_view(std::string_view bytes, int stride = 0);

    template <class T>
    int add_accessor(const std::vector<T>& values, const char* type, bool normalized = false) {
        const int view = add_view({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
        return add_accessor(view, 0, component_type<T>, values.size() / components(type), type, normalized);
    }
    int add_accessor(int view, std::size_t offset, int component, std::size_t count, const char* type,
                     bool normalized = false);

    // A mesh of one primitive, a node that draws it and a scene; `attributes`: names and accessors.
    Json& add_mesh(const Json& attributes, int indices = -1);

    [[nodiscard]] std::string text() const; // the buffer as a base64 "data:" URI
    [[nodiscard]] std::string glb() const;

    static std::size_t components(const std::string& type);

private:
    std::string bin_;
    [[nodiscard]] Json finished() const;
};

// A triangle (0,0,0) (1,0,0) (0,1,0) with a normal each, drawn by node 0.
GltfBuilder triangle();

std::string base64(std::string_view bytes);

// Imports a document, written as a GLB and as glTF with a "data:" URI; both must give the same model.
Result import_both(const GltfBuilder& builder);

// The message of the Error(invalid_data); "imported" if there is none.
std::string refusal(const GltfBuilder& builder);

void expect_near(Vec3f a, Vec3f b, float tolerance = 1e-6F);

} // namespace spa::test
