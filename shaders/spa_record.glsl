// SPDX-License-Identifier: Apache-2.0
// GLSL: how shaders find the trace image of a part: by its address in the part's record
// (libspa/vulkan/map_object.h, ShaderRecord). A file that includes this one first says
//   #extension GL_EXT_buffer_reference : require
//   #extension GL_EXT_buffer_reference_uvec2 : require
//   #extension GL_GOOGLE_include_directive : require
// and has SPA_IMAGE: the uvec2 `image` of the record whose map is traced.
#ifndef SPA_RECORD_GLSL
#define SPA_RECORD_GLSL

layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer SpaImageWords { uint word[]; };

struct SpaRecord {
    uvec2 image; // device address of the trace image
    uint flags;  // SPA_CULL_BACK, SPA_CULL_FRONT
    uint part;   // number of the part in its map
};

// How maps are traced: specialisation constants (libspa/vulkan/hit_group.h, TraceConstants).
layout(constant_id = 0) const uint spa_method = 0u;       // SPA_PROJECTIVE, SPA_FAN or SPA_MARCH
layout(constant_id = 1) const uint spa_count = 10u;       // test rays of the fan, steps of the march
layout(constant_id = 2) const uint spa_count_rule = 0u;   // SPA_FAN_FIXED or SPA_FAN_BY_DISTANCE
layout(constant_id = 3) const float spa_coverage = 0.0;   // rays pass where less is covered; 0: nowhere

#define SPA_LOAD(index) SpaImageWords(SPA_IMAGE).word[index]
#include "spa_method.h"

SpaMethod spa_chosen_method() {
    SpaMethod method = spa_method_defaults(spa_method);
    method.fan.count = spa_count;
    method.fan.count_rule = spa_count_rule;
    method.march.steps = spa_count;
    return method;
}

#endif
