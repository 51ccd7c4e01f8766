// SPDX-License-Identifier: Apache-2.0
// GLSL: the tracing text on trace images that are found by their addresses. A file that includes this one first
// says
//   #extension GL_EXT_buffer_reference : require
//   #extension GL_EXT_buffer_reference_uvec2 : require
//   #extension GL_GOOGLE_include_directive : require
// A stage of a hit group defines SPA_HIT_STAGE before: its record is spa_record. Others set spa_current_image to
// the `image` of the record whose map they are about to trace.
#ifndef SPA_TRACE_GLSL
#define SPA_TRACE_GLSL

#include "spa_record.glsl"

layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer SpaImageWords { uint word[]; };

#ifdef SPA_HIT_STAGE
layout(shaderRecordEXT, std430) readonly buffer SpaShaderRecord { SpaRecord spa_record; };
#define SPA_LOAD(index) SpaImageWords(spa_record.image).word[index]
#else
uvec2 spa_current_image;
#define SPA_LOAD(index) SpaImageWords(spa_current_image).word[index]
#endif

#include "spa_method.h"

// How maps are traced: specialisation constants (libspa/vulkan/hit_group.h, TraceConstants).
layout(constant_id = 0) const uint spa_tracer = SPA_PROJECTIVE;
layout(constant_id = 1) const uint spa_count = 10u; // test rays of the fan, steps of the march
layout(constant_id = 2) const uint spa_count_rule = SPA_FAN_FIXED;
layout(constant_id = 3) const float spa_hole_threshold = SPA_HOLE_THRESHOLD; // of coverage
layout(constant_id = 4) const uint spa_fan_start = SPA_FAN_START_HITS;

SpaMethod spa_chosen_method() {
    SpaMethod method = spa_method_defaults(spa_tracer);
    method.fan.count = spa_count;
    method.fan.count_rule = spa_count_rule;
    method.fan.start = spa_fan_start;
    method.march.steps = spa_count;
    return method;
}

// The t_max to trace with, where t_max is that of the ray or of its best hit so far. Fan and march spread their
// points over what is left of the ray: their answer must not depend on which instance was tested first. What lies
// beyond t_max the API refuses.
float spa_reach(float t_max) { return spa_tracer == SPA_PROJECTIVE ? t_max : 1e30; }

#endif
