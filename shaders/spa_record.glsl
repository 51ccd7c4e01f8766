// SPDX-License-Identifier: Apache-2.0
// GLSL: the record of a part (libspa/vulkan/map_object.h, ShaderRecord).
#ifndef SPA_RECORD_GLSL
#define SPA_RECORD_GLSL

struct SpaRecord {
    uvec2 image; // device address of the trace image
    uint flags;  // SPA_CULL_BACK, SPA_CULL_FRONT, SPA_RECORD_COVERAGE (spa_hit.h)
    uint part;   // number of the part in its map
};

#endif
