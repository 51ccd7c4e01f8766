// SPDX-License-Identifier: Apache-2.0
// The integrator, the same for both ways to trace. A file that includes this one defines before
//   RenderSurface closest(vec3 origin, vec3 direction, uint mask)
//   bool occluded(vec3 origin, vec3 direction, float t_max, uint mask)
// mask: SPA_MASK_...
#ifndef SPA_RENDER_PATH_GLSL
#define SPA_RENDER_PATH_GLSL

#include "surface.glsl"

const float pi = 3.14159265358979;

// PCG (O'Neill 2014) as a hash (Jarzynski and Olano 2020).
uint hashed(uint value) {
    uint state = value * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// Point `index` of the R2 sequence (Roberts 2018) as fractions of 2^32, so that it stays exact, moved by `shift`.
vec2 r2_point(uint index, uvec2 shift) {
    uvec2 point = index * uvec2(3242174889u, 2447445414u) + shift;
    return vec2(point >> 8u) * (1.0 / 16777216.0);
}

// Cosine-weighted about `normal`.
vec3 diffuse_direction(vec3 normal, vec2 point) {
    // Basis of Duff et al. 2017.
    float s = normal.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + normal.z);
    float b = normal.x * normal.y * a;
    vec3 tangent = vec3(1.0 + s * normal.x * normal.x * a, s * b, -s * normal.x);
    vec3 bitangent = vec3(b, s + normal.y * normal.y * a, -normal.y);
    float radius = sqrt(point.x);
    float angle = 2.0 * pi * point.y;
    return tangent * (radius * cos(angle)) + bitangent * (radius * sin(angle)) + normal * sqrt(max(0.0, 1.0 - point.x));
}

// Of nothing but these, so that directions are the same whatever stands in the scene.
uvec2 sample_shift(uint index) {
    uvec2 shift;
    shift.x = hashed(index ^ hashed(GLOBALS.seed ^ hashed(batch.primary_ray)));
    shift.y = hashed(shift.x);
    return shift;
}

RenderPixel no_sums() {
    RenderPixel sums;
    sums.direct = vec3(0.0);
    sums.depth = -1.0;
    sums.indirect = vec3(0.0);
    sums.kind = SPA_KIND_NOTHING;
    sums.normal = vec3(0.0);
    sums.secondary_rays = 0u;
    sums.albedo = vec3(0.0);
    sums.shadow_rays = 0u;
    return sums;
}

// For rays that see these instances. Maps are not exactly where their triangles are.
vec3 start_of(RenderSurface surface, uint mask) {
    bool of_map = surface.kind >= SPA_KIND_MAP || (mask & SPA_MASK_MAPS) != 0u;
    return surface.position + surface.plane * (of_map ? surface.offset : GLOBALS.offset);
}

// Radiance by light that comes straight from the lights.
vec3 direct_light(RenderSurface surface, inout uint shadow_rays) {
    vec3 sum = vec3(0.0);
    vec3 start = start_of(surface, GLOBALS.shadow_mask);
    uint count = GLOBALS.light_count;
    for (uint i = 0u; i < count; i += 1u) {
        RenderLight light = LightsAt(GLOBALS.lights).it[i];
        vec3 way = -light.direction; // to the light
        vec3 shadow_way = way;       // the same for the shadow ray, which t = range ends
        float range = 1e30;
        float share = 1.0;
        if (light.kind != SPA_LIGHT_DIRECTIONAL) {
            way = light.position - surface.position;
            shadow_way = light.position - start;
            range = 1.0;
            float square = dot(way, way);
            if (!(square > 0.0)) continue;
            way *= inversesqrt(square);
            share = 1.0 / square;
        }
        if (light.kind == SPA_LIGHT_SPOT) {
            float cosine = -dot(way, light.direction);
            float ramp = clamp((cosine - light.cos_outer) / (light.cos_inner - light.cos_outer), 0.0, 1.0);
            share *= ramp * ramp;
        }
        share *= dot(surface.normal, way);
        if (!(share > 0.0) || dot(surface.plane, way) <= 0.0) continue;
        shadow_rays += 1u;
        if (occluded(start, shadow_way, range, GLOBALS.shadow_mask)) continue;
        sum += light.intensity * share;
    }
    return surface.albedo * sum * (1.0 / pi);
}

vec3 primary_direction(uvec2 pixel) {
    vec2 within = vec2(0.5);
    if (GLOBALS.antialias > 1u) within = r2_point(batch.primary_ray, uvec2(2147483648u));
    vec2 size = vec2(GLOBALS.width, GLOBALS.height);
    vec2 place = (vec2(pixel) + within) / size * 2.0 - 1.0;
    return normalize(GLOBALS.right * place.x - GLOBALS.up * place.y + GLOBALS.forward);
}

// Both passes in one text, with one place each that traces closest hits and shadow rays: drivers that inline
// everything compile it in half the time.
//
// place: in the batch, which is a number of whole rows.
void render_pixel(uvec2 place) {
    uvec2 pixel = uvec2(place.x, batch.first_row + place.y);
    if (pixel.x >= GLOBALS.width || pixel.y >= batch.end_row) return;
    uint index = pixel.y * GLOBALS.width + pixel.x;
    bool is_primary = batch.pass == SPA_PASS_PRIMARY;

    RenderPixel sums = no_sums();
    if (!is_primary || batch.primary_ray > 0u) sums = PixelsAt(GLOBALS.pixels).it[index];
    RenderSurface surface = no_surface(); // that rays leave
    vec3 start = GLOBALS.eye;
    uint mask = GLOBALS.primary_mask;
    if (!is_primary) {
        surface = SurfacesAt(GLOBALS.surfaces).it[index];
        if (surface.kind == SPA_KIND_NOTHING) return;
        mask = GLOBALS.secondary_mask;
        start = start_of(surface, mask);
    }
    uvec2 shift = sample_shift(index);

    for (uint i = batch.first_sample; i < batch.end_sample; i += 1u) {
        vec3 direction;
        if (is_primary) {
            direction = primary_direction(pixel);
        } else {
            direction = diffuse_direction(surface.normal, r2_point(i, shift));
            if (dot(surface.plane, direction) <= 0.0) continue;
            sums.secondary_rays += 1u;
        }
        RenderSurface hit = closest(start, direction, mask);
        vec3 light = vec3(0.0);
        if (hit.kind != SPA_KIND_NOTHING) light = direct_light(hit, sums.shadow_rays);
        if (is_primary) {
            SurfacesAt(GLOBALS.surfaces).it[index] = hit;
            if (batch.primary_ray == 0u) {
                sums.depth = hit.t;
                sums.kind = hit.kind;
            }
            sums.direct += light;
            sums.normal += hit.normal;
            sums.albedo += hit.albedo;
        } else {
            sums.indirect += surface.albedo * light;
        }
    }
    PixelsAt(GLOBALS.pixels).it[index] = sums;
}

#endif
