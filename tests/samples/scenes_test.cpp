// SPDX-License-Identifier: Apache-2.0
// The scenes: what they hold, and that nothing of it is lost on the way through a file.
#include "../../formats/import/import.h"
#include "../../libspa/core/error.h"
#include "../../samples/scenes.h"
#include "../container/temporary_folder.h"
#include "topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace {

using namespace spa;
using import::SceneResult;
using samples::make_scene;

std::vector<std::string> names() {
    std::vector<std::string> result;
    for (const samples::Sample& scene : samples::list_scenes()) result.emplace_back(scene.name);
    return result;
}

std::uint32_t node_of(const Scene& scene, std::string_view name) {
    const auto found = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                    [&](const SceneNode& node) { return node.name == name; });
    return found == scene.nodes.end() ? no_index : std::uint32_t(found - scene.nodes.begin());
}

// The triangles of a node in its local space; vertices that only they use.
Model mesh_of(const Scene& scene, std::uint32_t node) {
    Model mesh;
    const Affine to_local = inverse(scene.nodes[node].to_world);
    std::vector<std::uint32_t> number(scene.model.positions.size(), no_index);
    for (std::size_t i = 0; i < scene.model.triangles.size(); ++i)
        if (scene.triangle_nodes[i] == node)
            for (const std::uint32_t v : scene.model.triangles[i].vertex) number[v] = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (number[v] == no_index) continue;
        number[v] = std::uint32_t(mesh.positions.size());
        mesh.positions.push_back(to_float(transform_point(to_local, to_double(scene.model.positions[v]))));
        mesh.normals.push_back(to_float(normal_matrix(to_local.linear) * to_double(scene.model.normals[v])));
        mesh.uvs.push_back(scene.model.uvs[v]);
    }
    for (std::size_t i = 0; i < scene.model.triangles.size(); ++i) {
        if (scene.triangle_nodes[i] != node) continue;
        const auto [a, b, c] = scene.model.triangles[i].vertex;
        mesh.triangles.push_back({{number[a], number[b], number[c]}});
    }
    return mesh;
}

void expect_near(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b, float tolerance) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_LE(length(a[i] - b[i]), tolerance) << i;
}

bool is_near(const Affine& a, const Affine& b) {
    double most = length(a.translation - b.translation);
    for (int i = 0; i < 3; ++i) most = std::max(most, length(a.linear.row[i] - b.linear.row[i]));
    return most <= 1e-12;
}

SceneResult through_a_file(const Scene& scene) {
    const test::TemporaryFolder folder;
    const std::string path = folder.path() + "/scene.glb";
    samples::write_glb(scene, path);
    return import::read_scene(path);
}

// Everything that a file keeps. Positions are rounded in the local space of their node.
void expect_same(const Scene& a, const Scene& b) {
    ASSERT_EQ(a.nodes.size(), b.nodes.size());
    for (std::size_t i = 0; i < a.nodes.size(); ++i) {
        SCOPED_TRACE(a.nodes[i].name);
        EXPECT_EQ(a.nodes[i].name, b.nodes[i].name);
        EXPECT_TRUE(is_near(a.nodes[i].to_world, b.nodes[i].to_world));
        const std::uint32_t parent = a.nodes[i].parent, other = b.nodes[i].parent;
        EXPECT_EQ(parent == no_index ? "" : a.nodes[parent].name,
                  other == no_index ? "" : b.nodes[other].name);
    }
    expect_near(a.model.positions, b.model.positions, 3e-7F);
    expect_near(a.model.normals, b.model.normals, 1e-6F);
    ASSERT_EQ(a.model.triangles.size(), b.model.triangles.size());
    for (std::size_t i = 0; i < a.model.triangles.size(); ++i) {
        ASSERT_EQ(a.model.triangles[i].vertex, b.model.triangles[i].vertex);
        ASSERT_EQ(a.nodes[a.triangle_nodes[i]].name, b.nodes[b.triangle_nodes[i]].name);
        const Material& material = a.model.materials[a.model.triangle_materials[i]];
        const Material& other = b.model.materials[b.model.triangle_materials[i]];
        ASSERT_EQ(material.name, other.name);
        ASSERT_EQ(material.base_color, other.base_color);
        ASSERT_EQ(material.double_sided, other.double_sided);
        ASSERT_EQ(material.texture == no_index, other.texture == no_index);
    }
    ASSERT_EQ(a.cameras.size(), b.cameras.size());
    for (std::size_t i = 0; i < a.cameras.size(); ++i) {
        EXPECT_EQ(a.cameras[i].name, b.cameras[i].name);
        EXPECT_EQ(a.cameras[i].to_world, b.cameras[i].to_world);
        EXPECT_EQ(a.cameras[i].vertical_fov, b.cameras[i].vertical_fov);
    }
    ASSERT_EQ(a.lights.size(), b.lights.size());
    for (std::size_t i = 0; i < a.lights.size(); ++i) {
        EXPECT_EQ(a.lights[i].name, b.lights[i].name);
        EXPECT_EQ(a.lights[i].kind, b.lights[i].kind);
        EXPECT_EQ(a.lights[i].position, b.lights[i].position);
        EXPECT_LE(length(a.lights[i].direction - b.lights[i].direction), 1e-12);
        EXPECT_LE(length(a.lights[i].intensity - b.lights[i].intensity), 1e-6F);
        EXPECT_EQ(a.lights[i].inner_cone, b.lights[i].inner_cone);
        EXPECT_EQ(a.lights[i].outer_cone, b.lights[i].outer_cone);
    }
}

TEST(Scenes, HaveABootCamerasAndLights) {
    for (const std::string& name : names()) {
        SCOPED_TRACE(name);
        const Scene scene = make_scene(name, 0);
        ASSERT_EQ(scene.triangle_nodes.size(), scene.model.triangles.size());
        EXPECT_EQ(scene.model.normals.size(), scene.model.positions.size());
        EXPECT_EQ(scene.model.uvs.size(), scene.model.positions.size());
        EXPECT_NE(node_of(scene, "floor"), no_index);
        EXPECT_NE(node_of(scene, "boot"), no_index);
        ASSERT_FALSE(scene.cameras.empty());
        ASSERT_FALSE(scene.lights.empty());
        for (const Camera& camera : scene.cameras) {
            EXPECT_TRUE(is_finite(camera.to_world));
            EXPECT_NEAR(determinant(camera.to_world.linear), 1, 1e-12);
            EXPECT_NEAR(camera.to_world.linear.row[1].x, 0, 1e-12) << "the horizon is level";
            EXPECT_GT(camera.to_world.linear.row[1].y, 0) << "up is up";
        }
        for (const Light& light : scene.lights) {
            EXPECT_TRUE(is_finite(light.position) && is_finite(light.intensity));
            EXPECT_GT(light.intensity.x, 0);
        }
        for (const Vec3f& n : scene.model.normals) ASSERT_NEAR(length(n), 1, 1e-5);
        std::set<std::string> all;
        for (const SceneNode& node : scene.nodes) EXPECT_TRUE(all.insert(node.name).second) << node.name;
    }
}

TEST(Scenes, TheBootIsTheSampleInItsLocalSpace) {
    for (const std::string& name : names())
        for (const int level : {0, 3}) {
            SCOPED_TRACE(name);
            const Scene scene = make_scene(name, level);
            const std::uint32_t node = node_of(scene, "boot");
            ASSERT_NE(node, no_index);
            const Model boot = samples::make_sample("boot", level), mesh = mesh_of(scene, node);
            expect_near(mesh.positions, boot.positions, 1e-6F);
            expect_near(mesh.normals, boot.normals, 1e-6F);
            EXPECT_EQ(mesh.uvs, boot.uvs);
            ASSERT_EQ(mesh.triangles.size(), boot.triangles.size());
            for (std::size_t i = 0; i < boot.triangles.size(); ++i)
                ASSERT_EQ(mesh.triangles[i].vertex, boot.triangles[i].vertex);
        }
}

TEST(Scenes, TheBootStandsOnSomethingAndIsInNoWall) {
    for (const std::string& name : names()) {
        SCOPED_TRACE(name);
        const Scene scene = make_scene(name, 3);
        const std::uint32_t boot = node_of(scene, "boot"), plinth = node_of(scene, "plinth");
        Vec3f low{9, 9, 9}, floor_high{-9, -9, -9};
        const auto below = plinth != no_index ? plinth : node_of(scene, "floor");
        for (std::size_t i = 0; i < scene.model.triangles.size(); ++i)
            for (const std::uint32_t v : scene.model.triangles[i].vertex) {
                const Vec3f p = scene.model.positions[v];
                if (scene.triangle_nodes[i] == boot)
                    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                if (scene.triangle_nodes[i] == below) floor_high.y = std::max(floor_high.y, p.y);
            }
        EXPECT_NEAR(low.y, floor_high.y, 1e-6);
        if (name.starts_with("corner")) {
            EXPECT_GT(low.x, 0);
        }
        if (!name.starts_with("colonnade")) {
            EXPECT_GT(low.z, 0);
        }
    }
}

TEST(Scenes, WallsAndColumnsAreWatertight) {
    for (const std::string& name : names()) {
        const Scene scene = make_scene(name, 0);
        std::size_t others = 0;
        for (std::uint32_t node = 0; node < scene.nodes.size(); ++node) {
            // Boots are open at the top; what is scaled is a sample, and has lost digits on the way.
            const Vec3d& row = scene.nodes[node].to_world.linear.row[1];
            if (scene.nodes[node].name.ends_with("boot") || std::abs(length(row) - 1) > 1e-9) continue;
            if (scene.nodes[node].name.starts_with("boot")) continue;
            Model mesh = mesh_of(scene, node);
            if (mesh.triangles.empty()) continue;
            SCOPED_TRACE(name + ", " + scene.nodes[node].name);
            others += mesh.triangles.size();
            // The local mesh is what was made, but for rounding: weld by rounding once more.
            for (Vec3f& p : mesh.positions)
                p = Vec3f{std::round(p.x * 1e5F), std::round(p.y * 1e5F), std::round(p.z * 1e5F)} +
                    Vec3f{}; // no negative zeros
            const test::Topology topology = test::topology_of(mesh);
            EXPECT_EQ(topology.border_edges, 0U);
            EXPECT_EQ(topology.repeated_edges, 0U);
            EXPECT_GT(topology.volume, 0) << "faces look outwards";
            for (const Triangle& t : mesh.triangles) {
                const Vec3d a = to_double(mesh.positions[t.vertex[0]]);
                const Vec3d b = to_double(mesh.positions[t.vertex[1]]);
                const Vec3d c = to_double(mesh.positions[t.vertex[2]]);
                const Vec3d facing = cross(b - a, c - a);
                for (const std::uint32_t v : t.vertex) ASSERT_GT(dot(facing, to_double(mesh.normals[v])), 0);
            }
        }
        if (name.starts_with("colonnade")) {
            EXPECT_GE(others, 2000U);
            EXPECT_LE(others, 6000U);
        }
    }
}

TEST(Scenes, ComeBackFromAFile) {
    for (const std::string& name : names())
        for (const int level : {0, 3}) {
            SCOPED_TRACE(name);
            const Scene scene = make_scene(name, level);
            const SceneResult result = through_a_file(scene);
            EXPECT_TRUE(result.report.warnings.empty()) << result.report.warnings.front();
            expect_same(scene, result.scene);
        }
}

// Lights and cameras without nodes, a hierarchy, mirrors, shears, vertices that nodes share.
TEST(SceneGlb, KeepsWhatNoSampleHas) {
    Scene scene;
    Material glass;
    glass.name = "glass";
    glass.base_color = {0.5F, 0.25F, 1, 1};
    scene.model.materials = {glass};
    scene.model.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.5F}};
    scene.model.normals.assign(4, {0, 0, 1});
    scene.model.triangles = {{{0, 1, 2}}, {{1, 3, 2}}, {{0, 1, 3}}};
    scene.model.triangle_materials = {0, 0, 0};
    scene.nodes = {{"root", no_index, {{{{2, 0, 0}, {0.5, 1, 0}, {0, 0, 3}}}, {1, 2, 3}}},
                   {"", 0, {{{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 4, 0}}},
                   {"twin", 1, {}},
                   {"twin", no_index, {{}, {7, 0, 0}}}};
    scene.triangle_nodes = {1, 2, 1};
    Light spot;
    spot.name = "spot";
    spot.kind = LightKind::spot;
    spot.position = {1, 2, 3};
    spot.direction = normalize(Vec3d{1, -2, 0.5});
    spot.intensity = {10, 5, 2.5F};
    spot.inner_cone = 0.1;
    spot.outer_cone = 0.4;
    Light sun = spot;
    sun.kind = LightKind::directional;
    sun.name.clear();
    sun.position = {};
    sun.direction = {0, -1, 0};
    sun.inner_cone = sun.outer_cone = 0;
    Light twin;
    twin.name = "twin";
    twin.position = {7, 0, 0};
    twin.intensity = {0, 0, 0};
    scene.lights = {spot, sun, twin};
    Camera camera;
    camera.name = "eye";
    camera.to_world = {{}, {0, 0, 5}};
    camera.vertical_fov = 0.5;
    scene.cameras = {camera};

    const Scene back = through_a_file(scene).scene;
    ASSERT_EQ(back.nodes.size(), scene.nodes.size() + 3) << "for the camera and two lights; the twin has one";
    expect_same(back, through_a_file(back).scene);
    ASSERT_EQ(back.lights.size(), 3U);
    EXPECT_TRUE(is_near(back.nodes[node_of(back, "root")].to_world, scene.nodes[0].to_world));
    const auto by_name = [&](std::string_view name) {
        return *std::find_if(back.lights.begin(), back.lights.end(),
                             [&](const Light& light) { return light.name == name; });
    };
    EXPECT_LE(length(by_name("spot").direction - spot.direction), 1e-12);
    EXPECT_EQ(by_name("spot").intensity, spot.intensity);
    EXPECT_EQ(by_name("spot").outer_cone, 0.4);
    EXPECT_EQ(by_name("").direction, sun.direction);
    EXPECT_EQ(by_name("twin").position, twin.position);
    // The same triangles in the same places, facing the same way.
    ASSERT_EQ(back.model.triangles.size(), 3U);
    std::set<std::pair<std::string, int>> found;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            float most = 0;
            for (unsigned c = 0; c < 3; ++c)
                most = std::max(most, length(back.model.positions[back.model.triangles[i].vertex.at(c)] -
                                             scene.model.positions[scene.model.triangles[k].vertex.at(c)]));
            if (most < 1e-5F) found.insert({back.nodes[back.triangle_nodes[i]].name, int(k)});
        }
    EXPECT_EQ(found, (std::set<std::pair<std::string, int>>{{"", 0}, {"twin", 1}, {"", 2}}));
}

TEST(SceneGlb, SameSceneSameBytes) {
    for (const std::string& name : names())
        EXPECT_EQ(samples::to_glb(make_scene(name, 1)), samples::to_glb(make_scene(name, 1))) << name;
}

TEST(SceneGlb, RefusesABrokenScene) {
    const auto refuses = [](auto breaks) {
        Scene scene = make_scene("corner", 0);
        breaks(scene);
        try {
            (void)samples::to_glb(scene);
            return false;
        } catch (const Error& error) {
            return error.code() == ExitCode::internal;
        }
    };
    EXPECT_FALSE(refuses([](Scene&) {}));
    EXPECT_TRUE(refuses([](Scene& scene) { scene.triangle_nodes.pop_back(); }));
    EXPECT_TRUE(refuses([](Scene& scene) { scene.triangle_nodes[0] = 99; }));
    EXPECT_TRUE(refuses([](Scene& scene) { scene.nodes[0].parent = 0; }));
    EXPECT_TRUE(refuses([](Scene& scene) { scene.nodes[0].to_world.linear.row[1] = {}; }));
    EXPECT_TRUE(refuses([](Scene& scene) { scene.model.triangles[0].vertex[0] = 1U << 30U; }));
    EXPECT_TRUE(refuses([](Scene& scene) { scene.model.triangle_materials[0] = 9; }));
}

TEST(Scenes, AnUnknownNameOrLevelIsRefused) {
    for (const auto& [name, level] : {std::pair{"corner-e", 0}, {"boot", 0}, {"corner", -1}, {"corner", 7}}) {
        try {
            (void)make_scene(name, level);
            ADD_FAILURE() << name;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::usage);
        }
    }
    EXPECT_EQ(samples::find_scene("boot"), nullptr);
    for (const std::string& name : names()) EXPECT_EQ(samples::find_sample(name), nullptr) << name;
}

} // namespace
