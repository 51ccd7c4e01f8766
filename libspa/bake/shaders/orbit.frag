// SPDX-License-Identifier: Apache-2.0
// The centre pixel of one view: where the camera's axis meets the triangle that the rasteriser found there.

// The depth buffer holds radii, with GL_GREATER: of several fragments the outermost stays. Triangles are drawn in
// the order of their indices, so of equals the first stays. Depth peeling takes the crossings of a view one by one: each
// round keeps only fragments below what the round before found. That is exact, because a triangle's radius in a
// view is the same bits every time.

struct Material {
    vec4 base_color;
    float alpha_cutoff;
    uint alpha_mode; // 0 opaque, 1 mask, 2 blend
    float texels;    // of level 0; 0 = no texture
    float first_level; // levels too large for the context are not there
};

layout(std430, binding = 3) readonly buffer MaterialBuffer { Material materials[]; };

layout(binding = 0) uniform sampler2D base_color_texture;
layout(binding = 1) uniform sampler2D found_radius; // depth buffer of the round before
layout(location = 4) uniform uint first_round;

flat in uint item;
flat in uint camera;

layout(location = 0) out uvec4 surface_out; // radius bits, triangle, packed sRGB colour, 1
layout(location = 1) out uvec4 normal_out;  // xyz bits, facing

dvec3 corner(uint k) {
    uint i = 3u * k;
    return dvec3(corners[item].position[i], corners[item].position[i + 1u], corners[item].position[i + 2u]);
}
dvec3 corner_normal(uint k) {
    uint i = 3u * k;
    return dvec3(corners[item].normal[i], corners[item].normal[i + 1u], corners[item].normal[i + 2u]);
}
vec2 corner_uv(uint k) { return vec2(corners[item].uv[2u * k], corners[item].uv[2u * k + 1u]); }
vec4 corner_color(uint k) {
    uint i = 4u * k;
    return vec4(corners[item].color[i], corners[item].color[i + 1u], corners[item].color[i + 2u],
                corners[item].color[i + 3u]);
}

// IEC 61966-2-1.
float to_srgb(float linear) {
    float c = clamp(linear, 0.0, 1.0);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1.0 / 2.4) - 0.055;
}
uint to_code(float value) { return uint(floor(clamp(value, 0.0, 1.0) * 255.0 + 0.5)); }

// NaN gives 0 and huge coordinates lose their fraction, as in the radial baker.
float bounded(float v) { return isnan(v) ? 0.0 : clamp(v, -1e9, 1e9); }

// Without contraction, so that cross(p, q) is exactly -cross(q, p): triangles agree bit by bit about the edge they
// share, and with the radial baker.
dvec3 exact_cross(dvec3 p, dvec3 q) {
    precise dvec3 result =
        dvec3(p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x);
    return result;
}
double exact_dot(dvec3 p, dvec3 q) {
    precise double result = p.x * q.x + p.y * q.y + p.z * q.z;
    return result;
}

void main() {
    Camera view = cameras[camera];
    dvec3 g = dvec3(view.ray[0], view.ray[1], view.ray[2]);
    dvec3 a = corner(0u);
    dvec3 b = corner(1u);
    dvec3 c = corner(2u);

    // The triangle was drawn too large by a margin (orbit.vert): the axis meets it iff no edge function is negative
    // (sample_rays.h, which has the same formulas).
    dvec3 bc = exact_cross(b, c);
    double d = exact_dot(a, bc);
    dvec3 e = dvec3(exact_dot(bc, g), exact_dot(exact_cross(c, a), g), exact_dot(exact_cross(a, b), g));
    if (d < 0.0) {
        d = -d;
        e = -e;
    }
    if (!(e.x >= 0.0 && e.y >= 0.0 && e.z >= 0.0)) discard;
    precise double sum = e.x + e.y + e.z;
    if (!(sum > 0.0)) discard;
    precise double r = d / sum * view.ray_length;
    float radius = float(clamp(r, 1.1754943508222875e-38LF, 1.0LF));

    if (first_round == 0u && !(radius < texelFetch(found_radius, ivec2(gl_FragCoord.xy), 0).r)) discard;

    precise double scale = 1.0LF / sum;
    double wa = e.x * scale;
    double wb = e.y * scale;
    double wc = e.z * scale;
    vec3 weight = vec3(wa, wb, wc);
    dvec3 plane = cross(b - a, c - a);
    double slope = dot(plane, g) / view.ray_length;
    double area2 = dot(plane, plane);

    uint facing = corners[item].material & back_facing_bit;
    Material material = materials[corners[item].material & ~back_facing_bit];
    vec4 color = material.base_color *
                 (weight.x * corner_color(0u) + weight.y * corner_color(1u) + weight.z * corner_color(2u));
    if (material.texels > 0.0) {
        vec2 uva = corner_uv(0u);
        vec2 uvb = corner_uv(1u);
        vec2 uvc = corner_uv(2u);
        dvec2 uv = wa * dvec2(uva) + wb * dvec2(uvb) + wc * dvec2(uvc);
        // Level of detail: the side, in texels, of a square as large as the sample's footprint.
        vec2 eb = uvb - uva;
        vec2 ec = uvc - uva;
        float texels = abs(eb.x * ec.y - eb.y * ec.x) * material.texels;
        float area = float(sqrt(area2));
        float cosine = max(abs(float(slope)) / area, 0.05);
        float side2 = view.solid_angle * radius * radius / cosine / area * texels;
        float level = side2 > 1.0 ? 0.5 * log2(side2) - material.first_level : 0.0;
        color *= textureLod(base_color_texture, vec2(bounded(float(uv.x)), bounded(float(uv.y))), level);
    }
    uint alpha = 255u;
    if (material.alpha_mode == 1u && !(color.a >= material.alpha_cutoff)) discard;
    if (material.alpha_mode == 2u) {
        alpha = to_code(color.a);
        if (alpha == 0u) discard;
    }

    gl_FragDepth = radius;
    dvec3 n = wa * corner_normal(0u) + wb * corner_normal(1u) + wc * corner_normal(2u);
    double n2 = dot(n, n);
    // Without a normal, the plane's, on the triangle's front.
    if (!(n2 > 0.0)) {
        n = (slope > 0.0) == (facing == 0u) ? plane : -plane;
        n2 = area2;
    }
    vec3 unit = vec3(n / sqrt(n2));
    surface_out = uvec4(floatBitsToUint(radius), corners[item].triangle,
                        to_code(to_srgb(color.r)) | to_code(to_srgb(color.g)) << 8 |
                            to_code(to_srgb(color.b)) << 16 | alpha << 24,
                        1u);
    normal_out = uvec4(floatBitsToUint(unit), facing);
}
