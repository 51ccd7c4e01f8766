// SPDX-License-Identifier: Apache-2.0
// What is rendered: the triangles of a model with the nodes that they come from, cameras and lights. All in
// world space, right-handed, +Y up, in metres. import::read_scene (formats/import/import.h) reads scenes,
// samples::make_scene (samples/samples.h) makes some.
//
// A node is an object to those who know its name: a map can take the place of all that the node and the nodes
// below it draw. The map's object space is then the node's local space, and SceneNode::to_world its instance
// transform.
#pragma once

#include "../core/affine.h"
#include "model.h"
#include "rig.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace spa {

// Names may be empty and may occur more than once.
struct SceneNode {
    std::string name;
    std::uint32_t parent = no_index; // index into Scene::nodes; no_index: a root
    Affine to_world;                 // from the node's local space; may be mirrored, sheared and singular
    Affine to_parent{};              // the same to its parent's space, or to the world where it has none
    std::uint32_t source = no_index; // its index in the file (glTF: nodes); instances have their node's
};

// A pinhole camera at the origin of its space: looks along -Z, +Y is up in the image, +X right. A ray through
// the point (x, y) of the image plane, both in [-1, 1] from left to right and from bottom to top, has the
// direction (aspect * tan(vertical_fov / 2) * x, tan(vertical_fov / 2) * y, -1). The image's size gives the
// aspect ratio.
struct Camera {
    std::string name;
    Affine to_world;         // finite; a scale does not change the picture as long as it is uniform
    double vertical_fov = 0; // radians, in (0, pi)
};

enum class LightKind : std::uint8_t { point, directional, spot };

// Without extent, so shadows have hard edges. What a diffuse surface of albedo a sends out under one light is
// a / pi * E with the irradiance E = intensity * cos / distance^2 (point, spot) or intensity * cos
// (directional); cos between normal and the way to the light, 0 if negative. Candela and lux of glTF are
// taken as W/sr and W/m^2.
struct Light {
    std::string name;
    LightKind kind = LightKind::point;
    Vec3d position;            // point, spot
    Vec3d direction{0, 0, -1}; // spot, directional: unit, the way that the light goes
    Vec3f intensity;           // linear RGB, not negative: W/sr (point, spot) or W/m^2 (directional)
    double inner_cone = 0;     // spot: radians from the axis; full intensity inside
    double outer_cone = 0;     // spot: none outside; 0 <= inner_cone < outer_cone <= pi/2
};

struct Scene {
    Model model;                               // the triangles of all nodes
    std::vector<std::uint32_t> triangle_nodes; // one entry a triangle: index into nodes
    std::vector<SceneNode> nodes;              // each parent before its children
    std::vector<Camera> cameras;
    std::vector<Light> lights;
    Rig rig{}; // empty unless it was asked for
};

// How much of a spot light's intensity goes in a direction at the cosine `cosine` from its axis, as
// KHR_lights_punctual recommends: 1 inside the inner cone, 0 outside the outer one, the square of a linear
// ramp in the cosine between them.
inline double spot_share(const Light& light, double cosine) {
    const double outer = std::cos(light.outer_cone);
    const double inner = std::cos(light.inner_cone);
    if (cosine >= inner) return 1;
    if (cosine <= outer) return 0;
    const double ramp = (cosine - outer) / (inner - outer);
    return ramp * ramp;
}

} // namespace spa
