// SPDX-License-Identifier: Apache-2.0
// The scene in the device's memory: push constants, and arrays by their addresses, which have no limit to their
// length as descriptors do.
#ifndef SPA_RENDER_SCENE_GLSL
#define SPA_RENDER_SCENE_GLSL

#include "data.h"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer GlobalsAt { RenderGlobals it; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer InstancesAt { RenderInstance it[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer UintsAt { uint it[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Uint3sAt { uvec3 it[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Float2sAt { vec2 it[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Float3sAt { vec3 it[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Float4sAt { vec4 it[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer MaterialsAt { RenderMaterial it[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer TexturesAt { RenderTexture it[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer LightsAt { RenderLight it[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SurfacesAt { RenderSurface it[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PixelsAt { RenderPixel it[]; };

layout(push_constant, scalar) uniform Push { RenderBatch batch; };

#define GLOBALS GlobalsAt(batch.globals).it
#define NONE(address) ((address) == uvec2(0u))

RenderInstance instance_at(uint index) { return InstancesAt(GLOBALS.instances).it[index]; }

#endif
