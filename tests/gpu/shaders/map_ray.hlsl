// SPDX-License-Identifier: Apache-2.0
// map_ray.glsl in HLSL, for DXC's SPIR-V (tools/check_hlsl.sh).

struct WorldRay {
    float3 origin;
    float t_min;
    float3 direction;
    float t_max;
};
struct WorldHit {
    float t;
    uint instance;
    uint part;
    uint kind;
    float3 color;
    float diffuse;
    float3 normal;
    uint occluded;
    float3 object_origin;
    float pad0;
    float3 object_direction;
    float pad1;
};

struct Parameters {
    uint64_t scene;
    uint64_t rays;
    uint64_t hits;
    uint64_t records;
    uint count;
};
[[vk::push_constant]] Parameters parameters;

static const float4 lamp = float4(3.0f, 5.0f, 4.0f, 1.0f);

// OpConvertUToAccelerationStructureKHR: there is no HLSL for it.
[[vk::ext_instruction(4447)]] RaytracingAccelerationStructure scene_at(uint64_t address);

WorldRay world_ray(uint i) { return vk::RawBufferLoad<WorldRay>(parameters.rays + 32u * (uint64_t)i, 4); }

RayDesc description_of(WorldRay world) {
    RayDesc ray;
    ray.Origin = world.origin;
    ray.TMin = world.t_min;
    ray.Direction = world.direction;
    ray.TMax = world.t_max;
    return ray;
}

void write_hit(uint i, WorldHit hit) { vk::RawBufferStore<WorldHit>(parameters.hits + 80u * (uint64_t)i, hit, 4); }
