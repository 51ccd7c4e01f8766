// SPDX-License-Identifier: Apache-2.0
// trace_ray for every ray of a buffer.
[[vk::binding(0)]] ByteAddressBuffer trace_image;
[[vk::binding(1)]] StructuredBuffer<uint> rays;
[[vk::binding(2)]] RWStructuredBuffer<uint> results;
[[vk::push_constant]] cbuffer Parameters {
    uint first_word; // of the trace image
    uint count;      // of rays
    uint method;
};

#define SPA_HLSL
#define SPA_LOAD(index) trace_image.Load(4u * (index))
#include "spa_trace.h"

#define RAY_WORD(index) rays[index]
#define RESULT_WORD(index) results[index]
#define TRACE_BUFFERS
#include "trace_ray.h"

[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {
    if (id.x >= count) return;
    trace_ray(spa_open(first_word), id.x, method);
}
