#version 460
// SPDX-License-Identifier: Apache-2.0
// trace_ray for every ray of a buffer.
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer TraceImage { uint trace_image[]; };
layout(std430, binding = 1) readonly buffer Rays { uint rays[]; };
layout(std430, binding = 2) writeonly buffer Results { uint results[]; };
layout(push_constant) uniform Parameters {
    uint first_word; // of the trace image
    uint count;      // of rays
    uint method;
};

#define SPA_LOAD(index) trace_image[index]
#include "spa_trace.h"

#define RAY_WORD(index) rays[index]
#define RESULT_WORD(index) results[index]
#define TRACE_BUFFERS
#include "trace_ray.h"

void main() {
    if (gl_GlobalInvocationID.x >= count) return;
    trace_ray(spa_open(first_word), gl_GlobalInvocationID.x, method);
}
