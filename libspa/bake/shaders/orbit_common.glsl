// SPDX-License-Identifier: Apache-2.0
// What both stages of the orbit baker read. The structures mirror those of orbit_scene.h.

// One view: a camera on the unit sphere in the direction of `ray`, aimed at the origin.
struct Camera {
    double ray[3];     // the sample's direction as the map defines it, not normalised
    double ray_length; // its length
    float right[3];    // unit, perpendicular to each other and to the ray
    float up[3];
    float solid_angle; // that the sample stands for
    float padding;
};

struct Corners {
    float position[9]; // three corners, xyz each
    float normal[9];
    float uv[6];
    float color[12];
    uint triangle; // index into the model's triangles
    uint material; // index; the top bit is set if the triangle's front faces the centre
};

layout(std430, binding = 0) readonly buffer CornersBuffer { Corners corners[]; };
layout(std430, binding = 1) readonly buffer CameraBuffer { Camera cameras[]; };

const uint back_facing_bit = 0x80000000u;
