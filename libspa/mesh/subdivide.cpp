// SPDX-License-Identifier: Apache-2.0
#include "subdivide.h"

#include "../core/error.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

namespace spa {
namespace {

struct Traits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

HalfedgeMesh to_halfedge_mesh(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles) {
    HalfedgeMesh mesh;
    mesh.reserve(points.size(), 2 * triangles.size(), triangles.size());
    for (const Vec3d& p : points) mesh.add_vertex({p.x, p.y, p.z});
    for (const Triangle& triangle : triangles) {
        for (const std::uint32_t index : triangle.vertex) {
            if (index >= points.size())
                throw Error(ExitCode::internal, "Loop subdivision: a vertex index is out of range");
        }
        const HalfedgeMesh::VertexHandle corner[3] = {mesh.vertex_handle(triangle.vertex[0]),
                                                      mesh.vertex_handle(triangle.vertex[1]),
                                                      mesh.vertex_handle(triangle.vertex[2])};
        if (!mesh.add_face(corner[0], corner[1], corner[2]).is_valid())
            throw Error(ExitCode::internal,
                        "Loop subdivision: the mesh is not an oriented manifold; it cannot be subdivided");
    }
    return mesh;
}

std::vector<Vec3d> points_of(const HalfedgeMesh& mesh) {
    std::vector<Vec3d> points;
    points.reserve(mesh.n_vertices());
    for (const auto vertex : mesh.vertices()) {
        const OpenMesh::Vec3d p = mesh.point(vertex);
        points.push_back({p[0], p[1], p[2]});
    }
    return points;
}

HalfedgeMesh subdivided(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles,
                        unsigned levels) {
    HalfedgeMesh mesh = to_halfedge_mesh(points, triangles);
    OpenMesh::Subdivider::Uniform::LoopT<HalfedgeMesh> loop;
    loop.attach(mesh);
    loop(levels);
    loop.detach();
    return mesh;
}

std::vector<Triangle> triangles_of(const HalfedgeMesh& mesh) {
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.n_faces());
    for (const auto face : mesh.faces()) {
        Triangle triangle;
        std::size_t corner = 0;
        for (const auto vertex : mesh.fv_range(face))
            triangle.vertex.at(corner++) = static_cast<std::uint32_t>(vertex.idx());
        triangles.push_back(triangle);
    }
    return triangles;
}

} // namespace

ControlMesh subdivide_loop(const ControlMesh& mesh, unsigned levels) {
    if (!mesh.uvs.empty() && mesh.uvs.size() != mesh.positions.size())
        throw Error(ExitCode::internal, "Loop subdivision: uvs and positions differ in length");
    ControlMesh result;
    {
        const HalfedgeMesh fine = subdivided(mesh.positions, mesh.triangles, levels);
        result.positions = points_of(fine);
        result.triangles = triangles_of(fine);
    }
    if (!mesh.uvs.empty()) {
        // LoopT moves points only. The same topology numbers its new vertices the same way, so a second run
        // over the texture plane gives the matching coordinates.
        std::vector<Vec3d> plane;
        plane.reserve(mesh.uvs.size());
        for (const Vec2d& uv : mesh.uvs) plane.push_back({uv.x, uv.y, 0});
        for (const Vec3d& p : points_of(subdivided(plane, mesh.triangles, levels)))
            result.uvs.push_back({p.x, p.y});
    }
    return result;
}

} // namespace spa
