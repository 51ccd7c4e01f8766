// SPDX-License-Identifier: Apache-2.0
// The hit group of spherical maps for ray-tracing pipelines: a library of three stages, on ../spa_trace.h.
//
//   dxc -T lib_6_5 -Gis shaders/hlsl/spa.hlsl                                               DXIL, for D3D12
//   dxc -T lib_6_5 -Gis -spirv -fspv-target-env=vulkan1.2 -D SPA_STAGES=1 shaders/hlsl/...  SPIR-V, for Vulkan
//
// SPA_STAGES says which stages: 1 spa_intersection, 2 spa_closest_hit, 4 spa_any_hit, or their sum; 7 if it is
// not given. In SPIR-V each needs a module of its own: DXC does not put into one module an intersection stage,
// for which RayTCurrent changes while it runs, and others, for which it does not. -Gis keeps float arithmetic as
// written, so that hits are the CPU's. Method and options: spa_method.hlsl.
//
// Order of operations:
//   1. Make a procedural hit group of spa_intersection, spa_closest_hit and, where coverage is asked for,
//      spa_any_hit. libspa/dxr/hit_group.h describes it.
//   2. Fill the part's 16 bytes of shader record behind the shader identifier (SpaRecord below):
//      libspa/dxr/map_object.h gives them. In D3D12 they are the arguments of a local root signature: a root SRV
//      and two 32-bit constants.
//   3. Trace with a SpaPayload (spa_payload.hlsl). Rays that have both RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH
//      and RAY_FLAG_SKIP_CLOSEST_HIT_SHADER only ask whether something is hit: their hit kind says nothing unless
//      coverage is asked for.
//
// An application with a payload of its own writes its own closest hit; spa_intersection and spa_any_hit do not
// look at it. DXIL wants the payload's type in any hit: define SPA_PAYLOAD as yours, and SPA_STAGES as 5.
#ifndef SPA_HLSL
#define SPA_HLSL
#endif

#ifdef __spirv__

// The record itself, with the device address of the trace image.
struct SpaRecord {
    uint64_t image;
    uint flags; // SPA_CULL_..., SPA_RECORD_...
    uint part;  // comes back in the payload
};
[[vk::shader_record_ext]] ConstantBuffer<SpaRecord> spa_record;
#define SPA_LOAD(index) vk::RawBufferLoad<uint>(spa_record.image + 4u * (uint64_t)(index))

#else

// Root arguments, in the order of the record. The space is one that no application uses by accident.
#ifndef SPA_SPACE
#define SPA_SPACE space83
#endif
struct SpaRecord {
    uint flags; // SPA_CULL_..., SPA_RECORD_...
    uint part;  // comes back in the payload
};
ByteAddressBuffer spa_image_words : register(t0, SPA_SPACE);
ConstantBuffer<SpaRecord> spa_record : register(b0, SPA_SPACE);
#define SPA_LOAD(index) spa_image_words.Load(4u * (index))

#endif

#include "spa_surface.hlsl"

#ifndef SPA_PAYLOAD
#define SPA_PAYLOAD SpaPayload
#endif
#ifndef SPA_STAGES
#define SPA_STAGES 7
#endif

// Nothing that a later stage may trust: where the attributes of a refused hit end up differs between drivers.
struct SpaAttributes {
    uint unused;
};

SpaRay spa_object_ray(float t_max) {
    SpaRay ray;
    ray.origin = ObjectRayOrigin();
    ray.t_min = RayTMin();
    ray.direction = ObjectRayDirection();
    ray.t_max = t_max;
    return ray;
}

#if (SPA_STAGES & 1) != 0
[shader("intersection")]
void spa_intersection() {
    SpaMap map = spa_open(0u);
    SpaRay ray = spa_object_ray(RayTCurrent());
    SpaAttributes attributes;
    attributes.unused = 0u;
    uint flags = spa_record.flags & SPA_RECORD_TRACE;
    bool coverage = (spa_record.flags & SPA_RECORD_COVERAGE) != 0u;
    uint shadow = RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH | RAY_FLAG_SKIP_CLOSEST_HIT_SHADER;
    if ((RayFlags() & shadow) == shadow && !coverage) flags |= SPA_ANY_HIT;
    SpaHit hit;
    for (uint n = 0u; n < SPA_MAX_HOLES; n += 1u) {
        if (!spa_trace(map, ray, flags, hit)) return;
        bool hole = spa_in_hole(map, hit, spa_record.flags, SPA_THRESHOLD);
        bool accepted = ReportHit(hit.t, spa_hit_kind(hit, hole), attributes);
        if (accepted || !hole) return;
        ray.t_min = spa_behind(ray, hit.t);
    }
}
#endif

#if (SPA_STAGES & 4) != 0
[shader("anyhit")]
void spa_any_hit(inout SPA_PAYLOAD payload, SpaAttributes attributes) {
    if (spa_kind_hole(HitKind())) IgnoreHit();
}
#endif

#if (SPA_STAGES & 2) != 0
[shader("closesthit")]
void spa_closest_hit(inout SpaPayload payload, SpaAttributes attributes) {
    float t = RayTCurrent();
    payload.t = t;
    payload.part = spa_record.part;
    payload.kind = HitKind();
    // Traced again, without an end: cut at t itself, the ray may end a rounding before the hit.
    SpaMap map = spa_open(0u);
    SpaRay ray = spa_object_ray(1e30f);
    SpaHit hit;
    if (!spa_first_hit(map, ray, spa_record.flags, t, hit)) {
        hit = spa_no_hit();
        hit.normal = ray.direction * -1.0f;
    }
    spa_fill_surface(map, hit, WorldRayOrigin() + WorldRayDirection() * t, WorldToObject3x4(), payload);
}
#endif
