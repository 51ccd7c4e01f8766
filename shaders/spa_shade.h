// SPDX-License-Identifier: Apache-2.0
// The stored colour and normal at a hit, from the images of the surface that was hit, each of its own size:
// bilinear, over seams and borders, without what the image holds where there is no surface.
#ifndef SPA_SHADE_H
#define SPA_SHADE_H

#include "spa_direction.h"

SPA_BEGIN

struct SpaShade {
    float3 color;    // linear red, green and blue of what is there, not multiplied by coverage; white without
                     // images
    float coverage;  // share of the neighbourhood that is covered, in [0,1]; 1 without images
    float3 normal;   // unit, map space, out of the solid: the stored one, or the hit's without images
    uint has_color;  // 1: from an image
    uint has_normal; // 1: from an image
};

// sRGB to linear of a code/255, at most 6e-7 off: the two pieces of IEC 61966-2-1, with a Chebyshev fit for
// the power, which languages round differently.
SPA_FUNCTION float spa_linear(float s) {
    if (s <= 0.04045f) return s / 12.92f;
    return 0.000847171459f +
           s * (0.0356439249f +
                s * (0.47963679f +
                     s * (0.908618086f +
                          s * (-1.06915766f +
                               s * (1.47353112f +
                                    s * (-1.55481663f +
                                         s * (1.09544723f + s * (-0.45162019f + s * (0.0818702377f)))))))));
}

SPA_FUNCTION float3 spa_color_of(uint word) {
    float scale = 1.0f / 255.0f;
    return float3(spa_linear(float(word & 255u) * scale), spa_linear(float((word >> 8u) & 255u) * scale),
                  spa_linear(float((word >> 16u) & 255u) * scale));
}

SPA_FUNCTION float spa_coverage_of(uint word) { return float(word >> 24u) * (1.0f / 255.0f); }

SPA_FUNCTION float spa_snorm16(uint code) {
    float value = float(code & 65535u);
    if (value >= 32768.0f) value -= 65536.0f;
    return max(-1.0f, value / 32767.0f);
}

// Of length 0.57 to 1; zero for SPA_NO_NORMAL.
SPA_FUNCTION float3 spa_normal_of(uint word) {
    if (word == SPA_NO_NORMAL) return float3(0.0f, 0.0f, 0.0f);
    float x = spa_snorm16(word);
    float y = spa_snorm16(word >> 16u);
    float z = 1.0f - abs(x) - abs(y);
    if (z < 0.0f) {
        float folded = 1.0f - abs(y);
        y = y < 0.0f ? abs(x) - 1.0f : 1.0f - abs(x);
        x = x < 0.0f ? -folded : folded;
    }
    return float3(x, y, z);
}

// Zero for what has no direction.
SPA_FUNCTION float3 spa_unit(float3 v) {
    float l = abs(v.x) + abs(v.y) + abs(v.z);
    if (!(l > 1e-30f && l < 1e30f)) return float3(0.0f, 0.0f, 0.0f);
    float3 scaled = v * (1.0f / l);
    return scaled * (1.0f / sqrt(dot(scaled, scaled)));
}

// One image of a surface; width 0: there is none.
struct SpaImage {
    uint place;
    uint width;
    uint height;
};

// kind: 0 colours, 3 normals. The outer surface's where an inner one has none.
SPA_FUNCTION SpaImage spa_image(SPA_IN(SpaMap) map, uint surface, uint kind) {
    uint entry = map.images + surface * SPA_IMAGE_WORDS + kind;
    if (spa_load(map.words, entry + 1u) == 0u && (surface & 1u) == 1u) entry -= SPA_IMAGE_WORDS;
    SpaImage image;
    image.place = spa_load(map.words, entry);
    image.width = spa_load(map.words, entry + 1u);
    image.height = spa_load(map.words, entry + 2u);
    return image;
}

// Adds weight * coverage * colour of a texel.
SPA_FUNCTION void spa_add_color(SPA_IN(SpaMap) map, uint index, float weight, SPA_INOUT(float3) covered,
                                SPA_INOUT(float3) plain, SPA_INOUT(float) coverage) {
    uint word = spa_load(map.words, index);
    float3 color = spa_color_of(word);
    float share = weight * spa_coverage_of(word);
    plain = plain + color * weight;
    covered = covered + color * share;
    coverage = coverage + share;
}

SPA_FUNCTION float3 spa_weighted_normal(SPA_IN(SpaMap) map, uint index, float weight) {
    return spa_unit(spa_normal_of(spa_load(map.words, index))) * weight;
}

// hit: what a trace of this map gave; of any other record nothing is read outside the image either.
// Time: eight texels.
SPA_FUNCTION SpaShade spa_shade(SPA_IN(SpaMap) map, SpaHit hit) {
    SpaShade shade;
    shade.color = float3(1.0f, 1.0f, 1.0f);
    shade.coverage = 1.0f;
    shade.normal = spa_unit(hit.normal);
    shade.has_color = 0u;
    shade.has_normal = 0u;
    uint surface = hit.layer * 2u;
    if (surface >= map.surfaces) surface = 0u;
    if (hit.side == SPA_INNER && surface + 1u < map.surfaces) surface += 1u;

    SpaImage colors = spa_image(map, surface, 0u);
    if (colors.width > 0u) {
        SpaFour four = spa_four(map.mapping, colors.width, colors.height, hit.map);
        float3 covered = float3(0.0f, 0.0f, 0.0f);
        float3 plain = float3(0.0f, 0.0f, 0.0f);
        float coverage = 0.0f;
        spa_add_color(map, colors.place + four.index0, four.weight0, covered, plain, coverage);
        spa_add_color(map, colors.place + four.index1, four.weight1, covered, plain, coverage);
        spa_add_color(map, colors.place + four.index2, four.weight2, covered, plain, coverage);
        spa_add_color(map, colors.place + four.index3, four.weight3, covered, plain, coverage);
        // Beside the surface are its colours, continued, with coverage 0.
        shade.color = coverage > 0.0f ? covered * (1.0f / coverage) : plain;
        shade.coverage = min(coverage, 1.0f);
        shade.has_color = 1u;
    }

    // A wall stands where a surface is seen edge-on: its normal is that of the surface there.
    SpaImage normals = spa_image(map, surface, 3u);
    if (normals.width > 0u && hit.side != SPA_WALL) {
        SpaFour four = spa_four(map.mapping, normals.width, normals.height, hit.map);
        float3 sum = spa_weighted_normal(map, normals.place + four.index0, four.weight0) +
                     spa_weighted_normal(map, normals.place + four.index1, four.weight1) +
                     spa_weighted_normal(map, normals.place + four.index2, four.weight2) +
                     spa_weighted_normal(map, normals.place + four.index3, four.weight3);
        // None there, or opposite ones that cancel out: the hit's own.
        if (dot(sum, sum) > 1e-6f) {
            shade.normal = spa_unit(sum);
            shade.has_normal = 1u;
        }
    }
    return shade;
}

SPA_END

#endif
