// SPDX-License-Identifier: Apache-2.0
// GLSL: the ray payload of spa.rchit, at location 0. Before traceRayEXT an application sets `light`, and t to -1,
// which stays if nothing is hit (or lets a miss shader do so).
#ifndef SPA_PAYLOAD_GLSL
#define SPA_PAYLOAD_GLSL

struct SpaPayload {
    vec4 light;    // in: world; xyz where a light is and w = 1, or the direction to it and w = 0
    vec3 color;    // out: linear red, green and blue, as stored
    float t;       // along the ray; negative: nothing was hit
    vec3 normal;   // world, unit, out of the solid
    float diffuse; // cosine between normal and the way to the light, at least 0: without shadow
    uint part;     // of the shader record
    uint kind;     // hit kind (spa_hit.h)
    uint instance; // index in the top-level structure
};

#endif
