// SPDX-License-Identifier: Apache-2.0
// How the vertices of a scene follow its nodes, and how animations move those. Every vertex is placed by
// bones: of a skinned mesh the joints of its skin; of any other mesh one bone alone, the node that draws it,
// so that both are posed (pose.h) by the same sum.
#pragma once

#include "../core/rotation.h"

#include <cstdint>
#include <string>
#include <vector>

namespace spa {

// A node as vertices follow it.
struct Bone {
    std::uint32_t node = 0;           // index into Scene::nodes
    std::uint32_t skin = 0xFFFFFFFFu; // index in the file; no_index: the node draws the mesh itself
    std::uint32_t joint = 0;          // index among the joints of the skin
    Affine inverse_bind;              // from the space of Rig::positions to the node's local space
};

struct Influence {
    std::uint32_t bone = 0; // index into Rig::bones; a vertex may name one twice
    float weight = 0;       // finite, not 0, negative only if the file has it so; those of a vertex sum to 1
};

enum class Interpolation : std::uint8_t { linear, step, cubic_spline };

// A value over time: three numbers a key, or the four of a quaternion x y z w; cubic_spline has in-tangent,
// value and out-tangent.
struct Curve {
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;  // seconds, finite, ascending; empty: the value rests
    std::vector<float> values; // finite
};

// What an animation does to a node: the parts of its local transform T * R * S that have no curve rest.
struct Track {
    std::uint32_t node = 0; // index into Scene::nodes
    Vec3d translation, scale{1, 1, 1};
    Quaternion rotation;
    Curve translations, rotations, scales;
};

struct Animation {
    std::string name;          // may be empty and occur more than once
    std::vector<Track> tracks; // at most one a node
    double seconds = 0;        // the last key of all curves
};

struct Rig {
    std::vector<Bone> bones;
    // Of vertex v of the model: influences[first[v]] to influences[first[v + 1] - 1].
    std::vector<std::uint32_t> first;
    std::vector<Influence> influences;
    // Of the vertices before bones move them, as many as the model has.
    std::vector<Vec3f> positions, normals;
    std::vector<Animation> animations;

    [[nodiscard]] bool empty() const { return bones.empty(); }
};

} // namespace spa
