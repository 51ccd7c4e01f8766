#version 460
// SPDX-License-Identifier: Apache-2.0
#extension GL_EXT_ray_tracing : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

#include "surface.glsl"

layout(location = 0) rayPayloadInEXT RenderSurface payload;
hitAttributeEXT vec2 barycentrics;

void main() {
    payload = triangle_surface(uint(gl_InstanceCustomIndexEXT), uint(gl_PrimitiveID), barycentrics, gl_HitTEXT,
                               gl_WorldRayDirectionEXT);
}
