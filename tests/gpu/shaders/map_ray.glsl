// SPDX-License-Identifier: Apache-2.0
// What the shaders that trace loaded maps have in common: rays, results and where they are. The same in C++
// (../map_rays.h).
#include "spa_record.glsl"

struct WorldRay {
    vec3 origin;
    float t_min;
    vec3 direction;
    float t_max;
};
struct WorldHit {
    float t;       // negative: none
    uint instance; // custom index
    uint part;     // of the record
    uint kind;     // hit kind (spa_hit.h)
    vec3 color;
    float diffuse; // towards the lamp below
    vec3 normal;
    uint occluded; // 1: an occlusion ray was stopped
    vec3 object_origin; // of the ray in map space; ray queries only
    float pad0;
    vec3 object_direction;
    float pad1;
};

layout(buffer_reference, scalar) readonly buffer WorldRays { WorldRay ray[]; };
layout(buffer_reference, scalar) writeonly buffer WorldHits { WorldHit hit[]; };
layout(buffer_reference, scalar) readonly buffer Records { SpaRecord record[]; };

layout(push_constant, scalar) uniform Parameters {
    uvec2 scene;
    WorldRays rays;
    WorldHits hits;
    Records records;
    uint count;
};

const vec4 lamp = vec4(3.0, 5.0, 4.0, 1.0);
