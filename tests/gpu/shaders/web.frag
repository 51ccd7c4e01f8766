#version 300 es
// SPDX-License-Identifier: Apache-2.0
// A fragment shader as a web page would write it, the trace image in a texture of 1024 words a row: compiled, not
// run. A page puts the included text in place of the #include.
precision highp float;
precision highp int;
precision highp usampler2D;

uniform usampler2D trace_image;
in vec3 origin;
in vec3 direction;
out vec4 color;

#define SPA_LOAD(index) texelFetch(trace_image, ivec2((index) & 1023u, (index) >> 10u), 0).x
#include "spa_trace.h"

void main() {
    SpaRay ray;
    ray.origin = origin;
    ray.t_min = 0.0;
    ray.direction = direction;
    ray.t_max = 1e30;
    SpaHit hit;
    if (!spa_trace_projective(spa_open(0u), ray, 0u, hit)) discard;
    color = vec4(hit.normal, hit.t);
}
