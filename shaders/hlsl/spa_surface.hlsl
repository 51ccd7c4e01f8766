// SPDX-License-Identifier: Apache-2.0
// A hit of a map as a payload: stored colour, normal in world space, diffuse light.
#ifndef SPA_SURFACE_HLSL
#define SPA_SURFACE_HLSL

#include "spa_method.hlsl"
#include "spa_payload.hlsl"

// hit: in map space; at: the place in world space; to_map: from world to map space (WorldToObject3x4).
// Fills colour, normal and diffuse.
void spa_fill_surface(SpaMap map, SpaHit hit, float3 at, float3x4 to_map, inout SpaPayload payload) {
    SpaShade shade = spa_shade(map, hit);
    payload.color = shade.color;
    // Normals go by the inverse transpose of map space to world.
    payload.normal = spa_unit(mul(shade.normal, (float3x3)to_map));
    float3 light = spa_unit(payload.light.xyz - at * payload.light.w);
    payload.diffuse = max(0.0f, dot(payload.normal, light));
}

#endif
