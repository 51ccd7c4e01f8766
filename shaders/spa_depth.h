// SPDX-License-Identifier: Apache-2.0
// The outermost surface as a function of direction: r/R from the plane of depths. What fan and march test
// points against.
#ifndef SPA_DEPTH_H
#define SPA_DEPTH_H

#include "spa_direction.h"

SPA_BEGIN

SPA_FUNCTION float spa_depth_at(SPA_IN(SpaMap) map, uint index) {
    return spa_float(spa_load(map.words, map.depths + index));
}

// The depth of the sample next to a direction of any length; 0 = no surface there.
SPA_FUNCTION float spa_depth_nearest(SPA_IN(SpaMap) map, float3 direction) {
    return spa_depth_at(map,
                        spa_nearest(map.mapping, map.width, map.height, spa_place(map.mapping, direction)));
}

// Bilinear between the four samples around a direction. Samples without surface take no part, so that nothing
// slopes down to the centre; where they weigh more than half, there is no surface: 0.
SPA_FUNCTION float spa_depth_bilinear(SPA_IN(SpaMap) map, float3 direction) {
    SpaFour four = spa_four(map.mapping, map.width, map.height, spa_place(map.mapping, direction));
    float depth0 = spa_depth_at(map, four.index0);
    float depth1 = spa_depth_at(map, four.index1);
    float depth2 = spa_depth_at(map, four.index2);
    float depth3 = spa_depth_at(map, four.index3);
    float weight = 0.0f;
    if (depth0 > 0.0f) weight += four.weight0;
    if (depth1 > 0.0f) weight += four.weight1;
    if (depth2 > 0.0f) weight += four.weight2;
    if (depth3 > 0.0f) weight += four.weight3;
    if (!(weight >= 0.5f)) return 0.0f;
    float sum = depth0 * four.weight0 + depth1 * four.weight1 + depth2 * four.weight2 + depth3 * four.weight3;
    return sum / weight;
}

// Test points closer to the centre than this have no direction of their own that means anything: they take
// the side that the ray comes from.
#define SPA_CENTER 1e-5f

SPA_FUNCTION float3 spa_side_of(float3 at, float3 ray_direction) {
    if (dot(at, at) >= SPA_CENTER * SPA_CENTER) return at;
    float l = abs(ray_direction.x) + abs(ray_direction.y) + abs(ray_direction.z);
    return ray_direction * (-1.0f / l);
}

SPA_END

#endif
