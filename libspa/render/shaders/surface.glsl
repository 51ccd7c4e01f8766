// SPDX-License-Identifier: Apache-2.0
// From a hit to the surface there.
#ifndef SPA_RENDER_SURFACE_GLSL
#define SPA_RENDER_SURFACE_GLSL

#include "material.glsl"

RenderSurface no_surface() {
    RenderSurface surface;
    surface.position = vec3(0.0);
    surface.t = -1.0;
    surface.plane = vec3(0.0);
    surface.kind = SPA_KIND_NOTHING;
    surface.normal = vec3(0.0);
    surface.offset = 0.0;
    surface.albedo = vec3(0.0);
    surface.object = 0u;
    return surface;
}

// direction: of the ray, in the world.
RenderSurface triangle_surface(uint custom_index, uint primitive, vec2 barycentrics, float t, vec3 direction) {
    RenderInstance instance = instance_at(custom_index);
    uint triangle = instance.first_triangle + primitive;
    uvec3 corners = Uint3sAt(GLOBALS.indices).it[triangle];
    vec3 weights = vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics);

    Float3sAt positions = Float3sAt(GLOBALS.positions);
    vec3 a = positions.it[corners.x];
    vec3 b = positions.it[corners.y];
    vec3 c = positions.it[corners.z];
    RenderSurface surface;
    surface.position = a * weights.x + b * weights.y + c * weights.z;
    surface.t = t;
    surface.plane = spa_unit(cross(b - a, c - a));
    if (dot(surface.plane, direction) > 0.0) surface.plane = -surface.plane;
    surface.kind = SPA_KIND_TRIANGLE;
    surface.normal = surface.plane;
    if (!NONE(GLOBALS.normals)) {
        Float3sAt normals = Float3sAt(GLOBALS.normals);
        vec3 normal = spa_unit(normals.it[corners.x] * weights.x + normals.it[corners.y] * weights.y +
                               normals.it[corners.z] * weights.z);
        if (dot(normal, normal) > 0.0) surface.normal = dot(normal, surface.plane) < 0.0 ? -normal : normal;
    }
    surface.offset = instance.offset;
    surface.albedo = base_color(triangle, corners, weights, material_of(triangle)).rgb;
    surface.object = instance.object;
    return surface;
}

// hit, shade: of the map, in map space; to_object: from the world to map space.
RenderSurface map_surface(uint custom_index, SpaHit hit, SpaShade shade, mat4x3 to_object, float t, vec3 origin,
                          vec3 direction) {
    RenderInstance instance = instance_at(custom_index);
    float side = hit.front != 0u ? 1.0 : -1.0;
    RenderSurface surface;
    surface.position = origin + direction * t;
    surface.t = t;
    surface.normal = spa_unit((shade.normal * to_object).xyz) * side;
    surface.plane = spa_unit((hit.normal * to_object).xyz) * side;
    // A test point has no surface around it: the paper lights it by the stored normal alone.
    if (spa_tracer == SPA_FAN) surface.plane = surface.normal;
    surface.kind = SPA_KIND_MAP + hit.side;
    surface.offset = instance.offset;
    surface.albedo = shade.color;
    surface.object = instance.object;
    return surface;
}

#endif
