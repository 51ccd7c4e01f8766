// SPDX-License-Identifier: Apache-2.0
// Camera transform of the orbit baker: three vertices of one triangle, seen by one camera, placed in that
// camera's own one-pixel tile.

// With NAIVE every triangle is drawn for one camera, else each (triangle, camera) pair of a list.
#ifndef NAIVE
layout(std430, binding = 2) readonly buffer PairBuffer { uvec2 pairs[]; };
#endif

layout(location = 0) uniform uint first_camera;
layout(location = 1) uniform uint tiles_per_row;  // powers of two: the tiles' centres are exact
layout(location = 2) uniform uint tile_rows;
layout(location = 3) uniform uint back_tiles; // tile of a back-facing triangle = camera + back_tiles

// Pixels per unit length. The rasteriser snaps vertices to 1/256 pixel, here 1.2e-7 of the radius, which is what
// single precision loses in the transform anyway; a larger pixel would move edges visibly, a smaller one
// gains nothing.
const float zoom = 16384.0;

flat out uint item;
flat out uint camera;
invariant gl_Position;
out float gl_ClipDistance[4];

void main() {
#ifdef NAIVE
    item = uint(gl_VertexID) / 3u;
    camera = first_camera;
#else
    uvec2 pair = pairs[uint(gl_VertexID) / 3u];
    item = pair.x;
    camera = pair.y;
#endif
    uint base = 3u * (uint(gl_VertexID) % 3u);
    vec3 p = vec3(corners[item].position[base], corners[item].position[base + 1u],
                  corners[item].position[base + 2u]);
    Camera view = cameras[camera];
    // Orthographic view. All expressions are the same for all triangles, so triangles that share a corner agree
    // on where it is and leave no gap.
    precise float x = zoom * dot(vec3(view.right[0], view.right[1], view.right[2]), p);
    precise float y = zoom * dot(vec3(view.up[0], view.up[1], view.up[2]), p);
    float distance_from_center =
        dot(vec3(float(view.direction[0]), float(view.direction[1]), float(view.direction[2])), p);

    uint tile = camera - first_camera;
    if ((corners[item].material & back_facing_bit) != 0u) tile += back_tiles;
    vec2 size = vec2(tiles_per_row, tile_rows);
    vec2 pixel = vec2(tile % tiles_per_row, tile / tiles_per_row) + 0.5;
    // The axis, x = y = 0, falls on the pixel's centre. Depth: 0 at the origin, the far plane; 0.5 on the sphere.
    precise vec2 tile_center = 2.0 * pixel / size - 1.0;
    precise vec2 position = tile_center + 2.0 * vec2(x, y) / size;
    gl_Position = vec4(position, 0.5 * distance_from_center, 1.0);
    gl_ClipDistance[0] = 0.5 + x;
    gl_ClipDistance[1] = 0.5 - x;
    gl_ClipDistance[2] = 0.5 + y;
    gl_ClipDistance[3] = 0.5 - y;
}
