// SPDX-License-Identifier: Apache-2.0
// Against positions worked out by hand from the masks of Loop's thesis.
#include "../../libspa/core/error.h"
#include "../../libspa/mesh/subdivide.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using spa::ControlMesh;
using spa::subdivide_loop;
using spa::Vec2d;
using spa::Vec3d;

void expect_near(Vec3d a, Vec3d b) { EXPECT_LT(length(a - b), 1e-15) << a.x << ' ' << a.y << ' ' << a.z; }

bool has_point(const std::vector<Vec3d>& points, Vec3d p) {
    return std::any_of(points.begin(), points.end(), [&](Vec3d q) { return length(p - q) < 1e-15; });
}

ControlMesh tetrahedron() {
    ControlMesh mesh;
    mesh.positions = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    mesh.triangles = {{{0, 1, 2}}, {{0, 2, 3}}, {{0, 3, 1}}, {{1, 3, 2}}};
    return mesh;
}

TEST(Loop, ClosedMeshFollowsTheInteriorMasks) {
    const ControlMesh coarse = tetrahedron();
    const ControlMesh fine = subdivide_loop(coarse, 1);
    ASSERT_EQ(fine.positions.size(), 10U);
    ASSERT_EQ(fine.triangles.size(), 16U);
    EXPECT_TRUE(fine.uvs.empty());
    for (std::size_t v = 0; v < 4; ++v) {
        // Valence 3: 7/16 of the vertex, 3/16 of each neighbour.
        Vec3d expected = coarse.positions[v] * (7.0 / 16);
        for (std::size_t n = 0; n < 4; ++n)
            if (n != v) expected = expected + coarse.positions[n] * (3.0 / 16);
        expect_near(fine.positions[v], expected);
        for (std::size_t n = v + 1; n < 4; ++n) {
            Vec3d middle = (coarse.positions[v] + coarse.positions[n]) * (3.0 / 8);
            for (std::size_t o = 0; o < 4; ++o)
                if (o != v && o != n) middle = middle + coarse.positions[o] * (1.0 / 8);
            EXPECT_TRUE(has_point(fine.positions, middle));
        }
    }
}

TEST(Loop, BorderFollowsTheCurveMasksAndUvsFollowPositions) {
    ControlMesh square;
    square.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    square.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
    for (const Vec3d& p : square.positions) square.uvs.push_back({p.x, p.y});
    const ControlMesh fine = subdivide_loop(square, 1);
    ASSERT_EQ(fine.positions.size(), 9U);
    expect_near(fine.positions[0], {1.0 / 8, 1.0 / 8, 0});
    expect_near(fine.positions[1], {7.0 / 8, 1.0 / 8, 0});
    EXPECT_TRUE(has_point(fine.positions, {0.5, 0, 0}));
    EXPECT_TRUE(has_point(fine.positions, {0.5, 0.5, 0})) << "the inner edge";
    const ControlMesh finest = subdivide_loop(square, 3);
    ASSERT_EQ(finest.uvs.size(), finest.positions.size());
    for (std::size_t i = 0; i < finest.uvs.size(); ++i) {
        EXPECT_EQ(finest.uvs[i].x, finest.positions[i].x);
        EXPECT_EQ(finest.uvs[i].y, finest.positions[i].y);
    }
}

TEST(Loop, LevelZeroChangesNothing) {
    const ControlMesh mesh = tetrahedron();
    const ControlMesh same = subdivide_loop(mesh, 0);
    EXPECT_EQ(same.positions, mesh.positions);
    EXPECT_EQ(same.triangles.size(), mesh.triangles.size());
}

TEST(Loop, RefusesWhatIsNotAManifold) {
    ControlMesh three_on_an_edge;
    three_on_an_edge.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
    three_on_an_edge.triangles = {{{0, 1, 2}}, {{1, 0, 3}}, {{0, 1, 4}}};
    EXPECT_THROW(subdivide_loop(three_on_an_edge, 1), spa::Error);
    ControlMesh out_of_range = tetrahedron();
    out_of_range.triangles[0].vertex[0] = 4;
    EXPECT_THROW(subdivide_loop(out_of_range, 1), spa::Error);
    ControlMesh short_uvs = tetrahedron();
    short_uvs.uvs = {Vec2d{}};
    EXPECT_THROW(subdivide_loop(short_uvs, 1), spa::Error);
}

} // namespace
