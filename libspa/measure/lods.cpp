// SPDX-License-Identifier: Apache-2.0
#include "lods.h"

#include "../mesh/weld.h"

#include <meshoptimizer.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace spa::measure {
namespace {

struct Mesh {
    std::vector<Vec3f> positions, normals;
    std::vector<unsigned> indices;
};

// Unites vertices of equal position, and drops triangles that lose their area.
Mesh united(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
            std::span<const Triangle> triangles) {
    constexpr float same_normal = 0.9998F; // cosine
    const std::vector<std::uint32_t> first = weld_positions(positions);
    Mesh mesh;
    std::vector<std::uint32_t> vertex_of(positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v) {
        if (first[v] == v) {
            vertex_of[v] = std::uint32_t(mesh.positions.size());
            mesh.positions.push_back(positions[v]);
            mesh.normals.push_back(normals[v]);
            continue;
        }
        vertex_of[v] = vertex_of[first[v]];
        if (dot(normals[first[v]], normals[v]) < same_normal) mesh.normals[vertex_of[v]] = {};
    }
    for (const Triangle& t : triangles) {
        const unsigned a = vertex_of[t.vertex[0]], b = vertex_of[t.vertex[1]], c = vertex_of[t.vertex[2]];
        if (a != b && b != c && c != a) mesh.indices.insert(mesh.indices.end(), {a, b, c});
    }
    return mesh;
}

// Returns the simplifier's own error, in the units of the positions.
double collapse(const Mesh& mesh, double target_error, std::vector<unsigned>& indices) {
    const float* const positions = &mesh.positions.front().x;
    const float scale = meshopt_simplifyScale(positions, mesh.positions.size(), sizeof(Vec3f));
    indices.resize(mesh.indices.size());
    float error = 0;
    indices.resize(meshopt_simplify(indices.data(), mesh.indices.data(), mesh.indices.size(), positions,
                                    mesh.positions.size(), sizeof(Vec3f), 0, float(target_error / scale), 0,
                                    &error));
    return double(error) * scale;
}

// The vertices that the indices use, in the order of their use.
Mesh compact(const Mesh& mesh, std::vector<unsigned> indices) {
    meshopt_optimizeVertexCache(indices.data(), indices.data(), indices.size(), mesh.positions.size());
    Mesh result;
    std::vector<unsigned> place(mesh.positions.size(), no_index);
    for (unsigned& index : indices) {
        unsigned& at = place[index];
        if (at == no_index) {
            at = unsigned(result.positions.size());
            result.positions.push_back(mesh.positions[index]);
            result.normals.push_back(mesh.normals[index]);
        }
        index = at;
    }
    result.indices = std::move(indices);
    return result;
}

} // namespace

std::vector<Lod> simplify(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                          std::span<const Triangle> triangles, std::span<const double> target_errors) {
    std::vector<Lod> lods(target_errors.size());
    Mesh mesh = united(positions, normals, triangles);
    if (mesh.indices.empty() || lods.empty()) return lods;
    constexpr std::size_t many_triangles = 300000;
    if (mesh.indices.size() / 3 > many_triangles) {
        std::vector<unsigned> indices;
        collapse(mesh, target_errors.back() / 16, indices);
        if (!indices.empty()) mesh = compact(mesh, std::move(indices));
    }
    tbb::parallel_for(std::size_t(0), lods.size(), [&](std::size_t i) {
        Lod& lod = lods[i];
        lod.target_error = target_errors[i];
        std::vector<unsigned> indices;
        lod.error = collapse(mesh, lod.target_error, indices);
        Mesh simple = compact(mesh, std::move(indices));
        lod.positions = std::move(simple.positions);
        lod.normals = std::move(simple.normals);
        lod.triangles.resize(simple.indices.size() / 3);
        for (std::size_t t = 0; t < lod.triangles.size(); ++t)
            std::copy_n(&simple.indices[3 * t], 3, lod.triangles[t].vertex.begin());
    });
    return lods;
}

} // namespace spa::measure
