#version 460
// SPDX-License-Identifier: Apache-2.0
// Single operations on three floats, one invocation a triple; see arithmetic_test.cpp.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Operands { float operands[]; };
layout(std430, binding = 1) writeonly buffer Results { float results[]; };
layout(push_constant) uniform Parameters { uint count; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    float a = operands[3u * i];
    float b = operands[3u * i + 1u];
    float c = operands[3u * i + 2u];
    // Without it the driver may compute a * (b + c).
    precise float two_products = a * b + a * c;
    uint at = 8u * i;
    results[at] = a + b;
    results[at + 1u] = a * b;
    results[at + 2u] = a / b;
    results[at + 3u] = sqrt(abs(a));
    results[at + 4u] = floor(a);
    results[at + 5u] = a * b + c;
    results[at + 6u] = dot(vec3(a, b, c), vec3(b, c, a));
    results[at + 7u] = two_products;
}
