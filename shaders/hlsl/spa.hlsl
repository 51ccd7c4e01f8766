// SPDX-License-Identifier: Apache-2.0
// The hit group of spherical maps for ray-tracing pipelines: a library of three stages on ../spa_trace.h.
//
//   dxc -T lib_6_5 -Gis spa.hlsl                                                      DXIL, for D3D12
//   dxc -T lib_6_5 -Gis -spirv -fspv-target-env=vulkan1.3 -D SPA_STAGES=1 spa.hlsl    SPIR-V, for Vulkan
//
// SPA_STAGES says which stages: 1 spa_intersection, 2 spa_closest_hit, 4 spa_any_hit, or their sum; all without
// it. DXC's SPIR-V needs a module for each, and Vulkan 1.3: in the intersection stage RayTCurrent changes as it
// runs, and DXC 1.8 can say so of a module's variable only. -Gis keeps float arithmetic as it is written, so that
// hits are the CPU's. Method and options: spa_method.hlsl.
//
// Order of operations:
//   1. Make a procedural hit group of spa_intersection, spa_closest_hit and, where coverage is asked for,
//      spa_any_hit. libspa/dxr/hit_group.h describes it.
//   2. Fill the part's 16 bytes of shader record behind the shader identifier: libspa/dxr/map_object.h gives them.
//      In D3D12 they are the arguments of a local root signature: a root SRV and two 32-bit constants.
//   3. Trace with an SpaPayload. Its `light` is set, and t to -1, which stays if nothing is hit (or the miss stage
//      does so). Rays that have both RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH and RAY_FLAG_SKIP_CLOSEST_HIT_SHADER
//      ask only whether something is hit: their hit kind says nothing, unless coverage is asked for.
//
// An application with a payload of its own writes its own closest hit; the other two stages do not look into it.
// Any hit must still be declared with its type: define SPA_PAYLOAD as that, and SPA_STAGES as 5.
#ifndef SPA_HLSL
#define SPA_HLSL
#endif

#ifdef __spirv__

// The record itself.
struct SpaRecord {
    uint64_t image; // device address of the trace image
    uint flags;     // SPA_CULL_..., SPA_RECORD_COVERAGE (../spa_hit.h)
    uint part;      // number of the part in its map
};
[[vk::shader_record_ext]] ConstantBuffer<SpaRecord> spa_record;
#define SPA_LOAD(index) vk::RawBufferLoad<uint>(spa_record.image + 4u * (uint64_t)(index))

#else

// Root arguments in the order of the record, in a register space that no application uses by accident.
#ifndef SPA_SPACE
#define SPA_SPACE space83
#endif
struct SpaRecord {
    uint flags;
    uint part;
};
ByteAddressBuffer spa_words : register(t0, SPA_SPACE);
ConstantBuffer<SpaRecord> spa_record : register(b0, SPA_SPACE);
#define SPA_LOAD(index) spa_words.Load(4u * (index))

#endif

#include "spa_method.hlsl"

// 60 bytes.
struct SpaPayload {
    float4 light;  // in: world; xyz where a light is and w = 1, or the direction to it and w = 0
    float3 color;  // out: linear red, green and blue, as stored
    float t;       // along the ray; negative: nothing was hit
    float3 normal; // world, unit, out of the solid
    float diffuse; // cosine between normal and the way to the light, at least 0: without shadow
    uint part;     // of the shader record
    uint kind;     // hit kind (../spa_hit.h)
    uint instance; // index in the top-level structure
};

#ifndef SPA_PAYLOAD
#define SPA_PAYLOAD SpaPayload
#endif
#ifndef SPA_STAGES
#define SPA_STAGES 7
#endif

// Nothing that a later stage may trust: in Vulkan a later call of the intersection stage may overwrite them.
struct SpaAttributes {
    uint unused;
};

#if (SPA_STAGES & 1) != 0
[shader("intersection")]
void spa_intersection() {
    float reach = spa_reach(RayTCurrent());
    SpaRay ray = spa_object_ray(ObjectRayOrigin(), RayTMin(), ObjectRayDirection(), reach);
    // Shadow rays ask for nothing but whether there is a hit.
    uint any = RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER;
    uint flags = spa_record.flags & SPA_RECORD_TRACE;
    bool coverage = (spa_record.flags & SPA_RECORD_COVERAGE) != 0u;
    if ((RayFlags() & any) == any && !coverage) flags |= SPA_ANY_HIT;

    SpaMap map = spa_open(0u);
    SpaMethod method = spa_chosen_method();
    SpaAttributes attributes;
    attributes.unused = 0u;
    SpaHit hit;
    for (uint n = 0u; n < SPA_MAX_HOLES; n += 1u) {
        if (!spa_trace(map, ray, method, flags, hit)) return;
        bool hole = spa_in_hole(map, hit, spa_record.flags, SPA_THRESHOLD);
        bool accepted = ReportHit(hit.t, spa_hit_kind(hit, hole), attributes);
        if (accepted || !hole) return;
        ray.t_min = spa_behind(ray, hit.t);
    }
}
#endif

#if (SPA_STAGES & 2) != 0
[shader("closesthit")]
void spa_closest_hit(inout SpaPayload payload, SpaAttributes attributes) {
    // Traced again without an end: cut at the hit itself, the ray may end a rounding before it.
    SpaRay ray = spa_object_ray(ObjectRayOrigin(), RayTMin(), ObjectRayDirection(), 1e30f);
    SpaMap map = spa_open(0u);
    SpaHit hit;
    spa_trace_record(map, ray, spa_chosen_method(), spa_record.flags, SPA_THRESHOLD, hit);
    SpaShade shade = spa_shade(map, hit);

    payload.color = shade.color;
    payload.t = RayTCurrent();
    payload.normal = spa_normal_to_world(shade.normal, WorldToObject3x4());
    float3 place = WorldRayOrigin() + WorldRayDirection() * payload.t;
    float3 to_light = spa_unit(payload.light.xyz - place * payload.light.w);
    payload.diffuse = max(0.0f, dot(payload.normal, to_light));
    payload.part = spa_record.part;
    payload.kind = HitKind();
    payload.instance = InstanceIndex();
}
#endif

#if (SPA_STAGES & 4) != 0
[shader("anyhit")]
void spa_any_hit(inout SPA_PAYLOAD payload, SpaAttributes attributes) {
    if (spa_kind_hole(HitKind())) IgnoreHit();
}
#endif
