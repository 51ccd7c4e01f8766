// SPDX-License-Identifier: Apache-2.0
// Primitive modes and index types into triangles; then what is left of them.
#pragma once

#include "../../libspa/mesh/model.h"
#include "gltf_accessor.h"

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

// Drops the triangles from `first` on that have equal corners, no area or a corner that is not finite, and
// counts them; the others get `base` added to their indices. `is_mirrored(triangle)`: swap two corners.
template <class IsMirrored>
void finish_triangles(Model& model, std::size_t first, std::size_t base, Report& report,
                      IsMirrored is_mirrored) {
    std::size_t kept = first;
    for (std::size_t i = first; i < model.triangles.size(); ++i) {
        const Triangle local = model.triangles[i];
        const auto [a, b, c] = local.vertex;
        if (a == b || b == c || c == a) {
            ++report.dropped_degenerate;
            continue;
        }
        const Vec3f pa = model.positions[base + a], pb = model.positions[base + b],
                    pc = model.positions[base + c];
        if (!is_finite(pa) || !is_finite(pb) || !is_finite(pc)) {
            ++report.dropped_non_finite;
            continue;
        }
        const Vec3d normal = cross(to_double(pb) - to_double(pa), to_double(pc) - to_double(pa));
        if (normal == Vec3d{}) {
            ++report.dropped_degenerate;
            continue;
        }
        const auto offset = static_cast<std::uint32_t>(base);
        Triangle out{{a + offset, b + offset, c + offset}};
        if (is_mirrored(local)) std::swap(out.vertex[1], out.vertex[2]);
        model.triangles[kept++] = out;
    }
    model.triangles.resize(kept);
}

// From vertex `base` and triangle `first` to the end of the model. Flat shading: every triangle gets vertices
// of its own with its normal.
void make_flat(Model& model, std::size_t base, std::size_t first);
// Vertices that no triangle uses go.
void drop_unused_vertices(Model& model, std::size_t base, std::size_t first);
// Normals that are zero or not finite are computed from the triangles. Returns how many there were.
std::size_t repair_normals(Model& model, std::size_t base, std::size_t first);

} // namespace spa::import::gltf
