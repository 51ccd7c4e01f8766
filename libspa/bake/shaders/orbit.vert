// SPDX-License-Identifier: Apache-2.0
// Camera transform of the orbit baker: three vertices of one triangle, seen by one camera, placed in that
// camera's own one-pixel tile. The triangle is drawn larger by a sliver of a pixel, so that no rounding on the way
// to the rasteriser can lose a pixel centre that lies on an edge; the fragment shader decides such ties exactly.

// With NAIVE every triangle is drawn for one camera, else each (triangle, camera) pair of a list.
#ifndef NAIVE
layout(std430, binding = 2) readonly buffer PairBuffer { uvec2 pairs[]; };
#endif

layout(location = 0) uniform uint first_camera;
layout(location = 1) uniform uint tiles_per_row;  // powers of two: the tiles' centres are exact
layout(location = 2) uniform uint tile_rows;
layout(location = 3) uniform uint back_tiles; // tile of a back-facing triangle = camera + back_tiles

// Pixels per unit length. The rasteriser snaps vertices to 1/256 pixel, here 2.4e-7 of the radius, about what
// single precision loses in the transform anyway.
const float zoom = 16384.0;
// By how much each edge is moved outwards, in pixels: 3.8e-6 of the radius, ten times what snapping, transform
// and clipping can move it inwards.
const float margin = 1.0 / 16.0;

flat out uint item;
flat out uint camera;
out float gl_ClipDistance[4];

// Orthographic, in pixels from the axis.
vec2 seen(Camera view, uint corner) {
    uint i = 3u * corner;
    vec3 p = vec3(corners[item].position[i], corners[item].position[i + 1u], corners[item].position[i + 2u]);
    return zoom * vec2(dot(vec3(view.right[0], view.right[1], view.right[2]), p),
                       dot(vec3(view.up[0], view.up[1], view.up[2]), p));
}

float cross2(vec2 p, vec2 q) { return p.x * q.y - p.y * q.x; }

// Corner k of a triangle that holds abc and all that is within the margin of it.
vec2 enlarged(vec2 a, vec2 b, vec2 c, uint k) {
    vec2 ab = b - a;
    vec2 bc = c - b;
    vec2 ca = a - c;
    vec3 side = vec3(length(ab), length(bc), length(ca));
    float longest = max(side.x, max(side.y, side.z));
    float height = abs(cross2(ab, ca));
    if (height > 4.0 * margin * longest) {
        // Where the two edges at the corner meet when moved outwards. At this height that is at most half the longest
        // side away.
        vec2 p = k == 0u ? a : k == 1u ? b : c;
        vec2 u = k == 0u ? ab / side.x : k == 1u ? bc / side.y : ca / side.z;
        vec2 v = k == 0u ? -ca / side.z : k == 1u ? -ab / side.x : -bc / side.y;
        return p - (u + v) * (margin / abs(cross2(u, v)));
    }
    // A sliver, whose corners would be moved far: a triangle around a strip along its longest side instead.
    const float width = 6.0 * margin;
    bool first = longest == side.x;
    bool second = !first && longest == side.y;
    vec2 begin = first ? a : second ? b : c;
    vec2 along = first ? ab : second ? bc : ca;
    along = longest > 0.0 ? along / longest : vec2(1.0, 0.0);
    begin -= width * along;
    if (k == 2u) return begin + 2.0 * (longest + 2.0 * width) * along;
    vec2 across = 2.0 * width * vec2(-along.y, along.x);
    return k == 0u ? begin + across : begin - across;
}

void main() {
#ifdef NAIVE
    item = uint(gl_VertexID) / 3u;
    camera = first_camera;
#else
    uvec2 pair = pairs[uint(gl_VertexID) / 3u];
    item = pair.x;
    camera = pair.y;
#endif
    Camera view = cameras[camera];
    vec2 p = enlarged(seen(view, 0u), seen(view, 1u), seen(view, 2u), uint(gl_VertexID) % 3u);

    uint tile = camera - first_camera;
    if ((corners[item].material & back_facing_bit) != 0u) tile += back_tiles;
    vec2 size = vec2(tiles_per_row, tile_rows);
    vec2 pixel = vec2(tile % tiles_per_row, tile / tiles_per_row) + 0.5;
    // The axis, the origin of p, falls on the pixel's centre. The depth is the fragment's own.
    precise vec2 tile_center = 2.0 * pixel / size - 1.0;
    precise vec2 position = tile_center + 2.0 * p / size;
    gl_Position = vec4(position, 0.5, 1.0);
    gl_ClipDistance[0] = 0.5 + p.x;
    gl_ClipDistance[1] = 0.5 - p.x;
    gl_ClipDistance[2] = 0.5 + p.y;
    gl_ClipDistance[3] = 0.5 - p.y;
}
