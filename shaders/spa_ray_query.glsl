// SPDX-License-Identifier: Apache-2.0
// GLSL: maps and triangles by ray queries, in any stage. A file that includes this one first says
//   #extension GL_EXT_ray_query : require
//   #extension GL_EXT_buffer_reference : require
//   #extension GL_EXT_buffer_reference_uvec2 : require
//   #extension GL_GOOGLE_include_directive : require
// and defines
//   SPA_SCENE                    the accelerationStructureEXT
//   SPA_QUERY_RECORD(index)      the SpaRecord of the instance with this custom index
//   SPA_OPAQUE_TRIANGLE(query)   optional: whether the candidate triangle of a rayQueryEXT stops the ray; without
//                                it every triangle does
// The best hit of a map is kept here, not by the query, which knows but its t.
#ifndef SPA_RAY_QUERY_GLSL
#define SPA_RAY_QUERY_GLSL

#include "spa_trace.glsl"

#define SPA_QUERY_NOTHING 0u
#define SPA_QUERY_TRIANGLE 1u
#define SPA_QUERY_MAP 2u

struct SpaQueryHit {
    uint type;           // SPA_QUERY_...
    float t;             // along the world ray
    uint custom_index;   // of the instance
    uint primitive;      // triangle: which
    vec2 barycentrics;   // triangle: weights of its second and third corner
    SpaHit map_hit;      // map: in map space
    mat4x3 to_object;    // of the instance
    mat4x3 to_world;
};

// A world ray on the object space of a candidate or hit. t stays.
SpaRay spa_object_ray(vec3 origin, float t_min, vec3 direction, float t_max) {
    SpaRay ray;
    ray.origin = origin;
    ray.t_min = t_min;
    ray.direction = direction;
    ray.t_max = t_max;
    return ray;
}

#ifdef SPA_OPAQUE_TRIANGLE
#define SPA_TRIANGLE_CANDIDATE(query)                                                                        \
    if (SPA_OPAQUE_TRIANGLE(query)) rayQueryConfirmIntersectionEXT(query);
#else
#define SPA_TRIANGLE_CANDIDATE(query) rayQueryConfirmIntersectionEXT(query);
#endif

// The closest hit. ray: in the world, its direction of any length; ray_flags: gl_RayFlags...; mask: of instances.
SpaQueryHit spa_query_closest(SpaRay ray, uint ray_flags, uint mask) {
    SpaMethod method = spa_chosen_method();
    SpaQueryHit best;
    best.type = SPA_QUERY_NOTHING;
    best.t = ray.t_max;
    best.map_hit = spa_no_hit();
    rayQueryEXT query;
    rayQueryInitializeEXT(query, SPA_SCENE, ray_flags, mask, ray.origin, ray.t_min, ray.direction, ray.t_max);
    while (rayQueryProceedEXT(query)) {
        if (rayQueryGetIntersectionTypeEXT(query, false) == gl_RayQueryCandidateIntersectionTriangleEXT) {
            SPA_TRIANGLE_CANDIDATE(query)
            continue;
        }
        uint index = uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, false));
        SpaRecord record = SPA_QUERY_RECORD(index);
        spa_current_image = record.image;
        float t_max = ray.t_max;
        if (rayQueryGetIntersectionTypeEXT(query, true) != gl_RayQueryCommittedIntersectionNoneEXT)
            t_max = rayQueryGetIntersectionTEXT(query, true);
        SpaHit hit;
        SpaRay object_ray = spa_object_ray(rayQueryGetIntersectionObjectRayOriginEXT(query, false), ray.t_min,
                                           rayQueryGetIntersectionObjectRayDirectionEXT(query, false),
                                           spa_reach(t_max));
        if (spa_trace_record(spa_open(0u), object_ray, method, record.flags, spa_hole_threshold, hit) &&
            hit.t <= t_max) {
            rayQueryGenerateIntersectionEXT(query, hit.t);
            best.map_hit = hit;
        }
    }
    uint committed = rayQueryGetIntersectionTypeEXT(query, true);
    if (committed == gl_RayQueryCommittedIntersectionNoneEXT) return best;
    best.t = rayQueryGetIntersectionTEXT(query, true);
    best.custom_index = uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, true));
    best.primitive = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, true));
    best.to_object = rayQueryGetIntersectionWorldToObjectEXT(query, true);
    best.to_world = rayQueryGetIntersectionObjectToWorldEXT(query, true);
    if (committed == gl_RayQueryCommittedIntersectionTriangleEXT) {
        best.type = SPA_QUERY_TRIANGLE;
        best.barycentrics = rayQueryGetIntersectionBarycentricsEXT(query, true);
    } else {
        best.type = SPA_QUERY_MAP;
    }
    return best;
}

// Whether anything is hit, for shadow rays. Arguments as above.
bool spa_query_occluded(SpaRay ray, uint ray_flags, uint mask) {
    SpaMethod method = spa_chosen_method();
    rayQueryEXT query;
    rayQueryInitializeEXT(query, SPA_SCENE, ray_flags | gl_RayFlagsTerminateOnFirstHitEXT, mask, ray.origin,
                          ray.t_min, ray.direction, ray.t_max);
    while (rayQueryProceedEXT(query)) {
        if (rayQueryGetIntersectionTypeEXT(query, false) == gl_RayQueryCandidateIntersectionTriangleEXT) {
            SPA_TRIANGLE_CANDIDATE(query)
            continue;
        }
        uint index = uint(rayQueryGetIntersectionInstanceCustomIndexEXT(query, false));
        SpaRecord record = SPA_QUERY_RECORD(index);
        spa_current_image = record.image;
        SpaRay object_ray =
            spa_object_ray(rayQueryGetIntersectionObjectRayOriginEXT(query, false), ray.t_min,
                           rayQueryGetIntersectionObjectRayDirectionEXT(query, false), spa_reach(ray.t_max));
        SpaHit hit;
        bool found = false;
        if ((record.flags & SPA_RECORD_COVERAGE) == 0u)
            found = spa_trace(spa_open(0u), object_ray, method, (record.flags & SPA_RECORD_TRACE) | SPA_ANY_HIT, hit);
        else
            found = spa_trace_record(spa_open(0u), object_ray, method, record.flags, spa_hole_threshold, hit);
        if (found && hit.t <= ray.t_max) rayQueryGenerateIntersectionEXT(query, hit.t);
    }
    return rayQueryGetIntersectionTypeEXT(query, true) != gl_RayQueryCommittedIntersectionNoneEXT;
}

// The stored colour and normal (map space) at a map's hit.
SpaShade spa_query_shade(SpaQueryHit best) {
    spa_current_image = SPA_QUERY_RECORD(best.custom_index).image;
    return spa_shade(spa_open(0u), best.map_hit);
}

// A normal of a hit's object space, in the world.
vec3 spa_query_normal(SpaQueryHit best, vec3 normal) { return normalize((normal * best.to_object).xyz); }

#endif
