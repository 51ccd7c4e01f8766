// SPDX-License-Identifier: Apache-2.0
// Maps and triangles by inline ray queries (RayQuery, shader model 6.5), in any stage. Before the include a file
// defines
//   SPA_HLSL
//   SPA_QUERY_RECORD(id)        uint4: the record of the instance with this instance ID, which
//                               libspa/dxr/map_object.h gives:
//        x, y   D3D12: the trace image's first word in its buffer, and which buffer that is, a number of the
//               application's. Vulkan: the image's device address, the low word first
//        z      SPA_CULL_..., SPA_RECORD_COVERAGE (../spa_hit.h)
//        w      number of the part in its map
//   SPA_LOAD(index)             D3D12: a word of the image: images.Load(4u * (index)), or for several buffers
//                               images[NonUniformResourceIndex(spa_buffer)].Load(4u * (index)). Vulkan, that is
//                               DXC's -spirv: not defined, words are read by address
//   SPA_OPAQUE_TRIANGLE(query)  optional: whether the candidate triangle of a query stops the ray; without it
//                               every triangle does
// All procedural instances that a query's mask lets through have to be maps. The best hit of a map is kept here,
// not by the query, which knows but its t.
#ifndef SPA_RAY_QUERY_HLSL
#define SPA_RAY_QUERY_HLSL

#ifdef __spirv__
static uint64_t spa_address; // of the image that is being read
#ifndef SPA_LOAD
#define SPA_LOAD(index) vk::RawBufferLoad<uint>(spa_address + 4u * (uint64_t)(index))
#endif
#else
static uint spa_buffer; // that holds the image that is being read
#endif

#include "spa_method.hlsl"

#ifndef SPA_OPAQUE_TRIANGLE
#define SPA_OPAQUE_TRIANGLE(query) true
#endif

#define SPA_QUERY_NOTHING 0u
#define SPA_QUERY_TRIANGLE 1u
#define SPA_QUERY_MAP 2u

struct SpaQueryHit {
    uint type;           // SPA_QUERY_...
    float t;             // along the world ray
    uint instance;       // index in the top-level structure
    uint id;             // of the instance
    uint primitive;      // triangle: which
    float2 barycentrics; // triangle: weights of its second and third corner
    SpaHit map_hit;      // map: in map space
    float3x4 to_object;  // of the instance
    float3x4 to_world;
};

SpaMap spa_open_record(uint4 record) {
#ifdef __spirv__
    spa_address = ((uint64_t)record.y << 32u) | record.x;
    return spa_open(0u);
#else
    spa_buffer = record.y;
    return spa_open(record.x);
#endif
}

// The closest hit. ray: in the world, its direction of any length; ray_flags: RAY_FLAG_...; mask: of instances.
SpaQueryHit spa_query_closest(RaytracingAccelerationStructure scene, RayDesc ray, uint ray_flags, uint mask) {
    SpaMethod method = spa_chosen_method();
    SpaQueryHit best = (SpaQueryHit)0;
    best.t = ray.TMax;
    best.map_hit = spa_no_hit();
    RayQuery<RAY_FLAG_NONE> query;
    query.TraceRayInline(scene, ray_flags, mask, ray);
    while (query.Proceed()) {
        if (query.CandidateType() == CANDIDATE_NON_OPAQUE_TRIANGLE) {
            if (SPA_OPAQUE_TRIANGLE(query)) query.CommitNonOpaqueTriangleHit();
            continue;
        }
        // Without a hit so far a Vulkan device may give any time.
        float t_max = ray.TMax;
        if (query.CommittedStatus() != COMMITTED_NOTHING) t_max = query.CommittedRayT();
        uint4 record = SPA_QUERY_RECORD(query.CandidateInstanceID());
        SpaMap map = spa_open_record(record);
        SpaRay object_ray = spa_object_ray(query.CandidateObjectRayOrigin(), ray.TMin,
                                           query.CandidateObjectRayDirection(), spa_reach(t_max));
        SpaHit hit;
        bool found = spa_trace_record(map, object_ray, method, record.z, SPA_THRESHOLD, hit);
        if (found && hit.t <= t_max) {
            query.CommitProceduralPrimitiveHit(hit.t);
            best.map_hit = hit;
        }
    }
    if (query.CommittedStatus() == COMMITTED_NOTHING) return best;
    best.t = query.CommittedRayT();
    best.instance = query.CommittedInstanceIndex();
    best.id = query.CommittedInstanceID();
    best.to_object = query.CommittedWorldToObject3x4();
    best.to_world = query.CommittedObjectToWorld3x4();
    if (query.CommittedStatus() == COMMITTED_TRIANGLE_HIT) {
        best.type = SPA_QUERY_TRIANGLE;
        best.primitive = query.CommittedPrimitiveIndex();
        best.barycentrics = query.CommittedTriangleBarycentrics();
    } else {
        best.type = SPA_QUERY_MAP;
    }
    return best;
}

// Whether anything is hit, for shadow rays. Arguments as above.
bool spa_query_occluded(RaytracingAccelerationStructure scene, RayDesc ray, uint ray_flags, uint mask) {
    SpaMethod method = spa_chosen_method();
    RayQuery<RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH> query;
    query.TraceRayInline(scene, ray_flags, mask, ray);
    while (query.Proceed()) {
        if (query.CandidateType() == CANDIDATE_NON_OPAQUE_TRIANGLE) {
            if (SPA_OPAQUE_TRIANGLE(query)) query.CommitNonOpaqueTriangleHit();
            continue;
        }
        uint4 record = SPA_QUERY_RECORD(query.CandidateInstanceID());
        SpaMap map = spa_open_record(record);
        SpaRay object_ray = spa_object_ray(query.CandidateObjectRayOrigin(), ray.TMin,
                                           query.CandidateObjectRayDirection(), spa_reach(ray.TMax));
        SpaHit hit;
        bool found = false;
        if ((record.z & SPA_RECORD_COVERAGE) == 0u)
            found = spa_trace(map, object_ray, method, (record.z & SPA_RECORD_TRACE) | SPA_ANY_HIT, hit);
        else
            found = spa_trace_record(map, object_ray, method, record.z, SPA_THRESHOLD, hit);
        if (found && hit.t <= ray.TMax) query.CommitProceduralPrimitiveHit(hit.t);
    }
    return query.CommittedStatus() != COMMITTED_NOTHING;
}

// The stored colour and normal (map space) at a map's hit.
SpaShade spa_query_shade(SpaQueryHit best) {
    SpaMap map = spa_open_record(SPA_QUERY_RECORD(best.id));
    return spa_shade(map, best.map_hit);
}

// A normal of a map hit's map space, in the world.
float3 spa_query_normal(SpaQueryHit best, float3 normal) { return spa_normal_to_world(normal, best.to_object); }

#endif
