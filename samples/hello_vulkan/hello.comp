#version 460
// SPDX-License-Identifier: Apache-2.0
// One ray a pixel by a ray query: stored colour under a lamp beside the camera.
#extension GL_EXT_ray_query : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

#include "spa_record.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(buffer_reference, scalar) readonly buffer Records { SpaRecord record[]; };
layout(buffer_reference, scalar) writeonly buffer Pixels { vec3 color[]; };
layout(push_constant, scalar) uniform Parameters {
    uvec2 scene; // address of the top level
    Records records;
    Pixels pixels;
    uvec2 size;
    vec3 eye;
    vec3 right, up, forward; // of the image plane, at its edges and its middle
};

#define SPA_SCENE accelerationStructureEXT(scene)
#define SPA_QUERY_RECORD(index) records.record[index]
#include "spa_ray_query.glsl"

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (pixel.x >= size.x || pixel.y >= size.y) return;
    vec2 place = (vec2(pixel) + 0.5) / vec2(size) * 2.0 - 1.0;
    SpaRay ray;
    ray.origin = eye;
    ray.t_min = 0.0;
    ray.direction = forward + place.x * right - place.y * up;
    ray.t_max = 1e30;
    SpaQueryHit best = spa_query_closest(ray, 0u, 0xFFu);
    vec3 color = vec3(0.05);
    if (best.type == SPA_QUERY_MAP) {
        SpaShade shade = spa_query_shade(best);
        vec3 normal = spa_query_normal(best, shade.normal);
        vec3 to_lamp = normalize(eye + 0.5 * (up - right) - (eye + best.t * ray.direction));
        color = shade.color * (0.15 + 0.85 * max(0.0, dot(normal, to_lamp)));
    }
    pixels.color[pixel.y * size.x + pixel.x] = color;
}
