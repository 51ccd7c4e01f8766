// SPDX-License-Identifier: Apache-2.0
// Primitive modes and index types into triangles; then what is left of them.
#pragma once

#include "../../libspa/mesh/model.h"
#include "gltf_accessor.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace spa::import::gltf {

// Appends the triangles of a list, strip or fan (`mode`: TINYGLTF_MODE_...) as indices of the primitive's own
// vertices. `indices` null: vertices 0, 1, 2, ... Throws Error for an index out of range; a rest that makes
// no triangle is warned of.
void append_triangles(const Elements* indices, std::size_t vertices, int mode, const std::string& where,
                      const Context& context, std::vector<Triangle>& triangles);

// The vertices that the triangles from `first` on use, ascending; the triangles then index into that list.
std::vector<std::uint32_t> renumber_used(std::vector<Triangle>& triangles, std::size_t first);

enum class Fate : std::uint8_t { kept, degenerate, non_finite };
// Of a triangle of these positions: degenerate if it has equal corners or no area.
Fate fate_of(const Triangle& triangle, std::span<const Vec3f> positions);

// Drops the triangles from `first` on that are not kept, and counts them; the others get `base` added to
// their indices. `is_mirrored(triangle)`, from any thread: swap two corners.
template <class IsMirrored>
void finish_triangles(Model& model, std::size_t first, std::size_t base, Report& report,
                      IsMirrored is_mirrored) {
    const std::span<Triangle> triangles = std::span(model.triangles).subspan(first);
    const std::span<const Vec3f> positions = std::span<const Vec3f>(model.positions).subspan(base);
    const auto offset = static_cast<std::uint32_t>(base);
    std::vector<Fate> fates(triangles.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, triangles.size(), 16384), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            fates[i] = fate_of(triangles[i], positions);
            const auto [a, b, c] = triangles[i].vertex;
            if (is_mirrored(triangles[i]))
                triangles[i] = {{a + offset, c + offset, b + offset}};
            else
                triangles[i] = {{a + offset, b + offset, c + offset}};
        }
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (fates[i] == Fate::kept) triangles[kept++] = triangles[i];
        if (fates[i] == Fate::degenerate) ++report.dropped_degenerate;
        if (fates[i] == Fate::non_finite) ++report.dropped_non_finite;
    }
    model.triangles.resize(first + kept);
}

// From vertex `base` and triangle `first` to the end of the model. Flat shading: every triangle gets vertices
// of its own with its normal. Returns which vertex each of the new ones was.
std::vector<std::uint32_t> make_flat(Model& model, std::size_t base, std::size_t first);
// Vertices that no triangle uses go. Returns which vertex each that is left was; empty: all are left.
std::vector<std::uint32_t> drop_unused_vertices(Model& model, std::size_t base, std::size_t first);
// Normals that are zero or not finite are computed from the triangles. Returns their vertices, ascending.
std::vector<std::uint32_t> repair_normals(Model& model, std::size_t base, std::size_t first);

} // namespace spa::import::gltf
