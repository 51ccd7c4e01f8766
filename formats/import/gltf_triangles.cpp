// SPDX-License-Identifier: Apache-2.0
#include "gltf_triangles.h"

#include <algorithm>
#include <cstring>

namespace spa::import::gltf {
namespace {

std::size_t triangle_count(std::size_t corners, int mode) {
    if (mode == TINYGLTF_MODE_TRIANGLES) return corners / 3;
    return corners < 3 ? 0 : corners - 2;
}

template <class Index>
void append(std::size_t count, int mode, std::vector<Triangle>& triangles, Index index) {
    const std::size_t first = triangles.size();
    triangles.resize(first + count);
    Triangle* out = triangles.data() + first;
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        for (std::size_t i = 0; i < count; ++i) out[i] = {{index(3 * i), index(3 * i + 1), index(3 * i + 2)}};
        return;
    }
    // glTF 2.0, 3.7.2.1: strip {i, i + (1 + i % 2), i + (2 - i % 2)}, fan {i + 1, i + 2, 0}.
    for (std::size_t i = 0; i < count; ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
            out[i] = {{index(i), index(i + 1 + i % 2), index(i + 2 - i % 2)}};
        else
            out[i] = {{index(i + 1), index(i + 2), index(0)}};
    }
}

template <class T>
void append_indexed(const Elements& indices, std::size_t vertices, int mode, const std::string& where,
                    const Context& context, std::vector<Triangle>& triangles) {
    std::uint32_t largest = 0;
    const auto index = [&](std::size_t i) {
        T value{};
        std::memcpy(&value, indices.bytes.data() + i * sizeof(T), sizeof value);
        largest = std::max<std::uint32_t>(largest, value);
        return static_cast<std::uint32_t>(value);
    };
    append(triangle_count(indices.count, mode), mode, triangles, index);
    if (largest < vertices) return;
    for (std::size_t i = 0; i < indices.count; ++i)
        if (index(i) >= vertices)
            fail(context, where,
                 "index " + std::to_string(index(i)) + " at position " + std::to_string(i) +
                     " is out of range (" + std::to_string(vertices) + " vertices)");
}

} // namespace

void append_triangles(const Elements* indices, std::size_t vertices, int mode, const std::string& where,
                      const Context& context, std::vector<Triangle>& triangles) {
    const std::size_t corners = indices != nullptr ? indices->count : vertices;
    if (corners < 3 || (mode == TINYGLTF_MODE_TRIANGLES && corners % 3 != 0))
        warn(context, where, std::to_string(corners) + " corners leave a rest that makes no triangle");
    if (indices == nullptr)
        append(triangle_count(corners, mode), mode, triangles,
               [](std::size_t i) { return static_cast<std::uint32_t>(i); });
    else if (indices->component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE)
        append_indexed<std::uint8_t>(*indices, vertices, mode, where, context, triangles);
    else if (indices->component_type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
        append_indexed<std::uint16_t>(*indices, vertices, mode, where, context, triangles);
    else
        append_indexed<std::uint32_t>(*indices, vertices, mode, where, context, triangles);
}

std::vector<std::uint32_t> renumber_used(std::vector<Triangle>& triangles, std::size_t first) {
    std::vector<std::uint32_t> used;
    used.reserve((triangles.size() - first) * 3);
    for (std::size_t i = first; i < triangles.size(); ++i)
        used.insert(used.end(), triangles[i].vertex.begin(), triangles[i].vertex.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (std::size_t i = first; i < triangles.size(); ++i)
        for (std::uint32_t& vertex : triangles[i].vertex)
            vertex =
                static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), vertex) - used.begin());
    return used;
}

namespace {

// The model's vertices from `base` on become those at `from`, which index the old ones.
template <class T>
void gather(std::vector<T>& values, std::size_t base, std::span<const std::uint32_t> from) {
    if (values.size() <= base) return;
    std::vector<T> picked(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) picked[i] = values[from[i]];
    values.resize(base + from.size());
    std::copy(picked.begin(), picked.end(), values.begin() + static_cast<std::ptrdiff_t>(base));
}

Vec3d area_normal(const Model& model, const Triangle& triangle) {
    const Vec3d a = to_double(model.positions[triangle.vertex[0]]);
    return cross(to_double(model.positions[triangle.vertex[1]]) - a,
                 to_double(model.positions[triangle.vertex[2]]) - a);
}

} // namespace

Fate fate_of(const Triangle& triangle, std::span<const Vec3f> positions) {
    const auto [a, b, c] = triangle.vertex;
    if (a == b || b == c || c == a) return Fate::degenerate;
    const Vec3f pa = positions[a], pb = positions[b], pc = positions[c];
    if (!is_finite(pa) || !is_finite(pb) || !is_finite(pc)) return Fate::non_finite;
    const Vec3d normal = cross(to_double(pb) - to_double(pa), to_double(pc) - to_double(pa));
    return normal == Vec3d{} ? Fate::degenerate : Fate::kept;
}

std::vector<std::uint32_t> make_flat(Model& model, std::size_t base, std::size_t first) {
    std::vector<std::uint32_t> corners;
    corners.reserve((model.triangles.size() - first) * 3);
    for (std::size_t i = first; i < model.triangles.size(); ++i)
        corners.insert(corners.end(), model.triangles[i].vertex.begin(), model.triangles[i].vertex.end());
    gather(model.positions, base, corners);
    gather(model.uvs, base, corners);
    gather(model.colors, base, corners);
    model.normals.resize(base + corners.size());
    auto next = static_cast<std::uint32_t>(base);
    for (std::size_t i = first; i < model.triangles.size(); ++i) {
        Triangle& triangle = model.triangles[i];
        for (std::uint32_t& vertex : triangle.vertex) vertex = next++;
        const Vec3f normal = to_float(normalize(area_normal(model, triangle)));
        for (const std::uint32_t vertex : triangle.vertex) model.normals[vertex] = normal;
    }
    return corners;
}

std::vector<std::uint32_t> drop_unused_vertices(Model& model, std::size_t base, std::size_t first) {
    const std::size_t count = model.positions.size() - base;
    std::vector<std::uint8_t> used(count);
    for (std::size_t i = first; i < model.triangles.size(); ++i)
        for (const std::uint32_t vertex : model.triangles[i].vertex) used[vertex - base] = 1;
    if (std::find(used.begin(), used.end(), std::uint8_t{0}) == used.end()) return {};

    std::vector<std::uint32_t> kept, number(count);
    for (std::size_t i = 0; i < count; ++i) {
        number[i] = static_cast<std::uint32_t>(base + kept.size());
        if (used[i] != 0) kept.push_back(static_cast<std::uint32_t>(base + i));
    }
    gather(model.positions, base, kept);
    gather(model.normals, base, kept);
    gather(model.uvs, base, kept);
    gather(model.colors, base, kept);
    for (std::size_t i = first; i < model.triangles.size(); ++i)
        for (std::uint32_t& vertex : model.triangles[i].vertex) vertex = number[vertex - base];
    return kept;
}

std::vector<std::uint32_t> repair_normals(Model& model, std::size_t base, std::size_t first) {
    std::vector<std::uint32_t> repaired;
    std::vector<std::uint8_t> bad(model.positions.size() - base);
    for (std::size_t i = base; i < model.normals.size(); ++i) {
        Vec3f& normal = model.normals[i];
        if (is_finite(normal) && !(normal == Vec3f{})) continue;
        normal = {};
        bad[i - base] = 1;
        repaired.push_back(static_cast<std::uint32_t>(i));
    }
    if (repaired.empty()) return repaired;
    std::vector<Vec3d> sums(bad.size());
    for (std::size_t i = first; i < model.triangles.size(); ++i) {
        const Vec3d area = area_normal(model, model.triangles[i]);
        for (const std::uint32_t vertex : model.triangles[i].vertex) {
            if (bad[vertex - base] == 0) continue;
            Vec3d& sum = sums[vertex - base];
            const Vec3d next = sum + area;
            sum = next == Vec3d{} ? area : next; // opposite faces must not cancel to nothing
        }
    }
    for (std::size_t i = 0; i < bad.size(); ++i)
        if (bad[i] != 0) model.normals[base + i] = to_float(normalize(sums[i]));
    return repaired;
}

} // namespace spa::import::gltf
