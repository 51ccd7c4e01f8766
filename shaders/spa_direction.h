// SPDX-License-Identifier: Apache-2.0
// Where a direction lies on a map, and which samples are around that place; both mappings, with the latlong
// seam and poles and the octahedral border. The same maths as libspa/core/direction_map.h.
//
// There is no trigonometry of the language's own in here: languages and processors differ in its last bits.
#ifndef SPA_DIRECTION_H
#define SPA_DIRECTION_H

#include "spa_map.h"

SPA_BEGIN

#define SPA_PI 3.14159265f

// The angle of (x, y) from the x axis, in [-pi, pi], at most 3e-7 rad off. (0, 0) gives 0.
SPA_FUNCTION float spa_atan2(float y, float x) {
    float width = abs(x);
    float height = abs(y);
    float longer = max(width, height);
    float shorter = min(width, height);
    if (!(longer > 0.0f)) return 0.0f;
    // atan(z) = pi/4 + atan((z - 1)/(z + 1)): what is left for the polynomial is |z| <= tan(pi/8).
    float base = 0.0f;
    float z = shorter / longer;
    if (z > 0.41421356f) {
        base = 0.25f * SPA_PI;
        z = (shorter - longer) / (shorter + longer);
    }
    // Chebyshev fit of atan(z)/z in z*z; 7e-9.
    float q = z * z;
    float rest = q * (-0.333327858f + q * (0.199740824f + q * (-0.138484902f + q * 0.0797629181f)));
    float angle = base + (z + z * rest);
    if (height > width) angle = 0.5f * SPA_PI - angle;
    if (x < 0.0f) angle = SPA_PI - angle;
    return y < 0.0f ? -angle : angle;
}

// sin(angle) for |angle| <= pi/2, at most 2e-7 off.
SPA_FUNCTION float spa_sin(float angle) {
    // Chebyshev fit of sin(a)/a in a*a; 7e-9.
    float q = angle * angle;
    float rest = q * (-0.166666579f + q * (0.00833305017f + q * (-0.00019809017f + q * 2.60510763e-6f)));
    return angle + angle * rest;
}

// The place of a direction of any length, in [0,1] x [0,1]: from the left and from the top of the map.
// Vectors without direction give the place of +Z.
SPA_FUNCTION float2 spa_place(uint mapping, float3 direction) {
    float l = abs(direction.x) + abs(direction.y) + abs(direction.z);
    if (!(l > 1e-30f && l < 1e30f)) return float2(0.5f, 0.5f);
    float x = direction.x / l;
    float y = direction.y / l;
    float z = direction.z / l;
    if (mapping == SPA_LATLONG) {
        float turn = 0.5f + spa_atan2(x, z) * (0.5f / SPA_PI);
        // The seam belongs to the left border.
        if (turn >= 1.0f) turn = 0.0f;
        float down = spa_atan2(sqrt(x * x + z * z), y) * (1.0f / SPA_PI);
        return float2(max(0.0f, turn), min(down, 1.0f));
    }
    if (direction.z < 0.0f) {
        float folded = 1.0f - abs(y);
        y = y < 0.0f ? abs(x) - 1.0f : 1.0f - abs(x);
        x = x < 0.0f ? -folded : folded;
    }
    return float2(0.5f + 0.5f * x, 0.5f - 0.5f * y);
}

// The nearest number in [0,1]; 0 for NaN.
SPA_FUNCTION float spa_share(float x) {
    if (!(x > 0.0f)) return 0.0f;
    return x < 1.0f ? x : 1.0f;
}

// A place in samples of a grid of this size; whole numbers are the samples. latlong: from -0.5 to
// width - 0.5. Places outside the map are moved to its border.
SPA_FUNCTION float2 spa_position(uint mapping, uint width, uint height, float2 place) {
    float x = spa_share(place.x);
    float y = spa_share(place.y);
    if (mapping == SPA_LATLONG) return float2(x * float(width) - 0.5f, y * float(height) - 0.5f);
    return float2(x * float(width - 1u), y * float(height - 1u));
}

// The row-major index of the sample that (x, y) means, -1 <= x <= width, -1 <= y <= height: over the seam and
// the poles, or over the octahedral border. Below width * height whatever is given.
SPA_FUNCTION uint spa_wrapped(uint mapping, uint width, uint height, int x, int y) {
    int w = int(width);
    int h = int(height);
    if (mapping == SPA_LATLONG) {
        if (y < 0 || y >= h) {
            y = y < 0 ? -1 - y : 2 * h - 1 - y;
            x += w / 2;
        }
        if (x < 0) x += w;
        if (x >= w) x -= w;
    } else {
        if (x < 0 || x >= w) {
            x = x < 0 ? -x : 2 * (w - 1) - x;
            y = h - 1 - y;
        }
        if (y < 0 || y >= h) {
            y = y < 0 ? -y : 2 * (h - 1) - y;
            x = w - 1 - x;
        }
    }
    if (x < 0) x = 0;
    if (x >= w) x = w - 1;
    if (y < 0) y = 0;
    if (y >= h) y = h - 1;
    return uint(y) * width + uint(x);
}

// The sample next to a place.
SPA_FUNCTION uint spa_nearest(uint mapping, uint width, uint height, float2 place) {
    float2 position = spa_position(mapping, width, height, place);
    return spa_wrapped(mapping, width, height, int(floor(position.x + 0.5f)), int(floor(position.y + 0.5f)));
}

// The four samples around a place and their bilinear weights, whose sum is 1.
struct SpaFour {
    uint index0;
    uint index1;
    uint index2;
    uint index3;
    float weight0;
    float weight1;
    float weight2;
    float weight3;
};

SPA_FUNCTION SpaFour spa_four(uint mapping, uint width, uint height, float2 place) {
    float2 position = spa_position(mapping, width, height, place);
    float left = floor(position.x);
    float top = floor(position.y);
    float right_share = position.x - left;
    float bottom_share = position.y - top;
    int x = int(left);
    int y = int(top);
    SpaFour four;
    four.index0 = spa_wrapped(mapping, width, height, x, y);
    four.index1 = spa_wrapped(mapping, width, height, x + 1, y);
    four.index2 = spa_wrapped(mapping, width, height, x, y + 1);
    four.index3 = spa_wrapped(mapping, width, height, x + 1, y + 1);
    four.weight0 = (1.0f - right_share) * (1.0f - bottom_share);
    four.weight1 = right_share * (1.0f - bottom_share);
    four.weight2 = (1.0f - right_share) * bottom_share;
    four.weight3 = right_share * bottom_share;
    return four;
}

SPA_END

#endif
