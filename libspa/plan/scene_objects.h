// SPDX-License-Identifier: Apache-2.0
// The objects of a scene: what a map can take the place of.
#pragma once

#include "../mesh/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace spa::plan {

// A topmost node with triangles of its own. All that the nodes below it draw belongs to it too, because a map
// takes the place of a node and of all below it.
struct SceneObject {
    std::uint32_t node = 0; // index into Scene::nodes
    // Index into the objects: the first one that draws the same in its node's local space, materials
    // included; one map serves both. no_index: none before it does.
    std::uint32_t same_as = no_index;
    std::vector<std::uint32_t> triangles; // indices into the model's, ascending
    std::uint64_t vertices = 0;           // that they use
    Vec3d center;                         // of their box in the world
    double radius = 0;                    // of the sphere about `center` that holds them, in the world
    bool invertible = false;              // whether the node's transform has an inverse, as a map needs
};

// In the order of their nodes. A triangle whose node has no object above it does not exist. O(triangles +
// nodes) time but for instances: each is compared with at most 16 others.
std::vector<SceneObject> find_objects(const Scene& scene);

// For each triangle of the scene its object.
std::vector<std::uint32_t> object_of_triangles(const Scene& scene, const std::vector<SceneObject>& objects);

// What the object draws, in its node's local space, with the textures that it uses; winding as seen from
// there. object.invertible has to hold. O(object.triangles) and the textures' texels.
Model object_model(const Scene& scene, const SceneObject& object);

// Bytes of the object's triangles while they are rendered: positions, normals, uvs and colours of vertices as
// far as the scene has them, indices, a material index, and hierarchy_bytes a triangle. Textures do not
// count: objects may share them.
std::uint64_t triangle_bytes(const Scene& scene, const SceneObject& object);
// Of a bottom-level hierarchy, a triangle: what a GPU's driver asks for without compaction is 60 to 130.
constexpr std::uint64_t hierarchy_bytes = 100;

} // namespace spa::plan
