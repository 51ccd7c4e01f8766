// SPDX-License-Identifier: Apache-2.0
// Base colour and alpha of a triangle's point. Textures are filtered here, in linear light and in float, as the
// bakers do; only the largest level is used.
#ifndef SPA_RENDER_MATERIAL_GLSL
#define SPA_RENDER_MATERIAL_GLSL

#include "scene.glsl"
#include "spa_trace.glsl"

// uv is untrusted: NaN and what is too large for its fraction give 0.
float wrapped(float u, uint wrap) {
    if (!(abs(u) < 1e9)) return 0.0;
    if (wrap == SPA_WRAP_REPEAT) return u - floor(u);
    if (wrap == SPA_WRAP_MIRRORED) return u - 2.0 * floor(u * 0.5);
    return clamp(u, 0.0, 1.0);
}

// i: at most one period beyond what wrapped() leaves.
uint wrapped_texel(int i, int size, uint wrap) {
    if (wrap == SPA_WRAP_REPEAT) return uint(i < 0 ? i + size : (i >= size ? i - size : i));
    if (wrap == SPA_WRAP_MIRRORED) {
        int m = i < 0 ? i + 2 * size : (i >= 2 * size ? i - 2 * size : i);
        return uint(m < size ? m : 2 * size - 1 - m);
    }
    return uint(clamp(i, 0, size - 1));
}

vec4 texel_at(RenderTexture texture_, RenderMaterial material, int i, int j) {
    uint x = wrapped_texel(i, int(texture_.width), material.wrap_u);
    uint y = wrapped_texel(j, int(texture_.height), material.wrap_v);
    uint word = UintsAt(GLOBALS.texels).it[texture_.first + y * texture_.width + x];
    return vec4(spa_color_of(word), spa_coverage_of(word));
}

vec4 texture_color(RenderMaterial material, vec2 uv) {
    RenderTexture texture_ = TexturesAt(GLOBALS.textures).it[material.texture];
    vec2 place = vec2(wrapped(uv.x, material.wrap_u), wrapped(uv.y, material.wrap_v)) *
                 vec2(texture_.width, texture_.height);
    if (material.nearest != 0u) return texel_at(texture_, material, int(floor(place.x)), int(floor(place.y)));
    place -= 0.5;
    vec2 low = floor(place);
    vec2 share = place - low;
    int i = int(low.x);
    int j = int(low.y);
    return mix(mix(texel_at(texture_, material, i, j), texel_at(texture_, material, i + 1, j), share.x),
               mix(texel_at(texture_, material, i, j + 1), texel_at(texture_, material, i + 1, j + 1), share.x),
               share.y);
}

// triangle: among all; weights: of its corners.
vec4 base_color(uint triangle, uvec3 corners, vec3 weights, RenderMaterial material) {
    vec4 color = vec4(material.color, material.alpha);
    if (!NONE(GLOBALS.colors)) {
        Float4sAt colors = Float4sAt(GLOBALS.colors);
        color *= colors.it[corners.x] * weights.x + colors.it[corners.y] * weights.y + colors.it[corners.z] * weights.z;
    }
    if (material.texture != SPA_NO_TEXTURE) {
        Float2sAt uvs = Float2sAt(GLOBALS.uvs);
        vec2 uv = uvs.it[corners.x] * weights.x + uvs.it[corners.y] * weights.y + uvs.it[corners.z] * weights.z;
        color *= texture_color(material, uv);
    }
    return color;
}

RenderMaterial material_of(uint triangle) {
    return MaterialsAt(GLOBALS.materials).it[UintsAt(GLOBALS.triangle_materials).it[triangle]];
}

// Whether a ray passes: alpha below the cutoff (mask) or below 1/2 (blend).
bool is_transparent(uint custom_index, uint primitive, vec2 barycentrics) {
    uint triangle = instance_at(custom_index).first_triangle + primitive;
    RenderMaterial material = material_of(triangle);
    uvec3 corners = Uint3sAt(GLOBALS.indices).it[triangle];
    vec3 weights = vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics);
    return base_color(triangle, corners, weights, material).a < material.alpha_limit;
}

#endif
