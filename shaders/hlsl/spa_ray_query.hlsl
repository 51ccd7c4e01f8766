// SPDX-License-Identifier: Apache-2.0
// Spherical maps and triangles by inline ray queries (RayQuery, shader model 6.5), from any stage: the closest hit
// and occlusion over a top-level structure that holds both.
//
// Before the include, an application says where the words of the trace images and the records are:
//
//   #define SPA_HLSL
//   #define SPA_RECORD(id) records[id]   uint4 of an instance, by its instance ID; libspa/dxr/map_object.h gives it:
//     x, y    D3D12: the image's first word in its buffer, and the number of that buffer, which is the
//             application's. Vulkan: the image's device address, low word first
//     z       SPA_CULL_..., SPA_RECORD_... (../spa_hit.h)
//     w       part; comes back with the hit
//   #define SPA_LOAD(index) images.Load(4u * (index))
//             or for several buffers images[NonUniformResourceIndex(spa_buffer)].Load(4u * (index)).
//             Vulkan (DXC's -spirv): leave it out; words are read by device address
//
// All procedural instances that the mask lets through have to be maps. Triangles that are not opaque are hit too,
// unless SPA_TRIANGLE(query) is defined, an expression that is false where a candidate is to be passed over.
#ifndef SPA_RAY_QUERY_HLSL
#define SPA_RAY_QUERY_HLSL

#ifndef SPA_HLSL
#define SPA_HLSL
#endif

#ifdef __spirv__
static uint64_t spa_address; // of the image that is being read
#ifndef SPA_LOAD
#define SPA_LOAD(index) vk::RawBufferLoad<uint>(spa_address + 4u * (uint64_t)(index))
#endif
#else
static uint spa_buffer; // in which the image is that is being read
#endif

#include "spa_surface.hlsl"

#ifndef SPA_TRIANGLE
#define SPA_TRIANGLE(query) true
#endif

SpaMap spa_open_record(uint4 record) {
#ifdef __spirv__
    spa_address = ((uint64_t)record.y << 32u) | record.x;
    return spa_open(0u);
#else
    spa_buffer = record.y;
    return spa_open(record.x);
#endif
}

// What a query met first.
struct SpaQueryHit {
    float t;             // of the ray as given; negative: nothing was hit
    uint instance;       // index in the top-level structure
    uint id;             // instance ID
    bool on_triangle;    // else on a map
    bool front;          // of the triangle, or the ray comes from outside the solid
    uint primitive;      // of a triangle
    float2 barycentrics; // of a triangle
    SpaHit hit;          // of a map, map space
    float3x4 to_map;     // from world space
};

// The closest hit; false: none. ray_flags: RAY_FLAG_... that hold for triangles and whole instances.
bool spa_query_closest(RaytracingAccelerationStructure scene, RayDesc ray, uint ray_flags, uint mask,
                       out SpaQueryHit result) {
    result = (SpaQueryHit)0;
    result.t = -1.0f;
    RayQuery<RAY_FLAG_NONE> query;
    query.TraceRayInline(scene, ray_flags, mask, ray);
    while (query.Proceed()) {
        if (query.CandidateType() == CANDIDATE_PROCEDURAL_PRIMITIVE) {
            uint4 record = SPA_RECORD(query.CandidateInstanceID());
            SpaMap map = spa_open_record(record);
            SpaRay object_ray;
            object_ray.origin = query.CandidateObjectRayOrigin();
            object_ray.t_min = ray.TMin;
            object_ray.direction = query.CandidateObjectRayDirection();
            // Without a hit so far a Vulkan device may say anything.
            object_ray.t_max = ray.TMax;
            if (query.CommittedStatus() != COMMITTED_NOTHING) object_ray.t_max = query.CommittedRayT();
            SpaHit hit;
            if (spa_first_hit(map, object_ray, record.z, 1e30f, hit)) {
                query.CommitProceduralPrimitiveHit(hit.t);
                result.hit = hit;
            }
        } else if (SPA_TRIANGLE(query)) {
            query.CommitNonOpaqueTriangleHit();
        }
    }
    if (query.CommittedStatus() == COMMITTED_NOTHING) return false;
    result.t = query.CommittedRayT();
    result.instance = query.CommittedInstanceIndex();
    result.id = query.CommittedInstanceID();
    result.on_triangle = query.CommittedStatus() == COMMITTED_TRIANGLE_HIT;
    result.to_map = query.CommittedWorldToObject3x4();
    if (result.on_triangle) {
        result.front = query.CommittedTriangleFrontFace();
        result.primitive = query.CommittedPrimitiveIndex();
        result.barycentrics = query.CommittedTriangleBarycentrics();
    } else {
        result.front = result.hit.front != 0u;
    }
    return true;
}

// Whether anything is hit. Cheaper: it ends at the first hit that it finds.
bool spa_query_occluded(RaytracingAccelerationStructure scene, RayDesc ray, uint ray_flags, uint mask) {
    RayQuery<RAY_FLAG_ACCEPT_FIRST_HIT_AND_END_SEARCH> query;
    query.TraceRayInline(scene, ray_flags, mask, ray);
    while (query.Proceed()) {
        if (query.CandidateType() == CANDIDATE_PROCEDURAL_PRIMITIVE) {
            uint4 record = SPA_RECORD(query.CandidateInstanceID());
            SpaMap map = spa_open_record(record);
            SpaRay object_ray;
            object_ray.origin = query.CandidateObjectRayOrigin();
            object_ray.t_min = ray.TMin;
            object_ray.direction = query.CandidateObjectRayDirection();
            object_ray.t_max = ray.TMax;
            SpaHit hit;
            bool found = false;
            if ((record.z & SPA_RECORD_COVERAGE) != 0u)
                found = spa_first_hit(map, object_ray, record.z, 1e30f, hit);
            else
                found = spa_trace(map, object_ray, (record.z & SPA_RECORD_TRACE) | SPA_ANY_HIT, hit);
            if (found) return true;
        } else if (SPA_TRIANGLE(query)) {
            return true;
        }
    }
    return query.CommittedStatus() != COMMITTED_NOTHING;
}

// The surface at a map's hit, as spa_closest_hit gives it. payload.light is read.
void spa_query_surface(SpaQueryHit result, RayDesc ray, inout SpaPayload payload) {
    uint4 record = SPA_RECORD(result.id);
    SpaMap map = spa_open_record(record);
    payload.t = result.t;
    payload.part = record.w;
    payload.kind = spa_hit_kind(result.hit, false);
    spa_fill_surface(map, result.hit, ray.Origin + ray.Direction * result.t, result.to_map, payload);
}

#endif
