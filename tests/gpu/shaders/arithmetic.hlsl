// SPDX-License-Identifier: Apache-2.0
// arithmetic.comp in HLSL.
[[vk::binding(0)]] StructuredBuffer<float> operands;
[[vk::binding(1)]] RWStructuredBuffer<float> results;
[[vk::push_constant]] cbuffer Parameters {
    uint count;
};

[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID) {
    uint i = id.x;
    if (i >= count) return;
    float a = operands[3u * i];
    float b = operands[3u * i + 1u];
    float c = operands[3u * i + 2u];
    precise float two_products = a * b + a * c;
    uint at = 8u * i;
    results[at] = a + b;
    results[at + 1u] = a * b;
    results[at + 2u] = a / b;
    results[at + 3u] = sqrt(abs(a));
    results[at + 4u] = floor(a);
    results[at + 5u] = a * b + c;
    results[at + 6u] = dot(float3(a, b, c), float3(b, c, a));
    results[at + 7u] = two_products;
}
