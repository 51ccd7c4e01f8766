#version 460
// SPDX-License-Identifier: Apache-2.0
#extension GL_EXT_ray_tracing : require
#extension GL_GOOGLE_include_directive : require

#include "spa_payload.glsl"

layout(location = 0) rayPayloadInEXT SpaPayload payload;

void main() { payload.t = -1.0; }
