// SPDX-License-Identifier: Apache-2.0
#include "weld.h"

#include <algorithm>
#include <bit>
#include <tuple>

namespace spa {
namespace {

struct Key {
    std::uint64_t xy;
    std::uint32_t z;
    std::uint32_t index;
};

Key make_key(Vec3f p, std::uint32_t index) {
    // Adding 0 turns -0 into 0.
    const std::uint64_t x = std::bit_cast<std::uint32_t>(p.x + 0.0F);
    const std::uint64_t y = std::bit_cast<std::uint32_t>(p.y + 0.0F);
    return {x << 32U | y, std::bit_cast<std::uint32_t>(p.z + 0.0F), index};
}

} // namespace

std::vector<std::uint32_t> weld_positions(std::span<const Vec3f> positions) {
    std::vector<Key> keys(positions.size());
    for (std::uint32_t i = 0; i < keys.size(); ++i) keys[i] = make_key(positions[i], i);
    std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
        return std::tie(a.xy, a.z, a.index) < std::tie(b.xy, b.z, b.index);
    });
    std::vector<std::uint32_t> first(positions.size());
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const bool same = i > 0 && keys[i].xy == keys[i - 1].xy && keys[i].z == keys[i - 1].z;
        first[keys[i].index] = same ? first[keys[i - 1].index] : keys[i].index;
    }
    return first;
}

} // namespace spa
