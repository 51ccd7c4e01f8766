// SPDX-License-Identifier: Apache-2.0
// What a ray carries to the closest hit and brings back: the same from spa.hlsl and from spa_ray_query.hlsl.
#ifndef SPA_PAYLOAD_HLSL
#define SPA_PAYLOAD_HLSL

// 56 bytes. The caller fills `light`, and sets t to a negative number or lets its miss stage do it.
struct SpaPayload {
    float3 color;   // linear, stored at the hit; white without images
    float t;        // of the ray as given; negative: nothing was hit
    float3 normal;  // unit, world space, out of the solid: the stored one, or the surface's
    float diffuse;  // max(0, normal . direction to the light)
    float4 light;   // in: w = 1: a position, w = 0: the direction to a light far away; world space, any length
    uint part;      // of the shader record
    uint kind;      // the hit kind, ../spa_hit.h
};

#endif
