// SPDX-License-Identifier: Apache-2.0
#include "intersect_block.h"

// The loops are written so that compilers vectorise them, and compiled twice. No multiply-adds are
// contracted, so both give the bits of the scalar intersect().
#if defined(__x86_64__) && defined(__GNUC__)
#define SPA_HAS_AVX2_CLONE 1
#endif

namespace spa::bake {
namespace {

template <bool octahedral>
[[gnu::always_inline]] inline void intersect_rows(const RaySetup& setup, const SampleDirections& directions,
                                                  const SampleRect& rect, double* __restrict radius) {
    const Vec3d e0 = setup.edge[0];
    const Vec3d e1 = setup.edge[1];
    const Vec3d e2 = setup.edge[2];
    const double d = setup.d;
    const double* const a = directions.columns_a() + rect.x0;
    const double* const b = directions.columns_b() + rect.x0;
    // Whole vectors, without a scalar rest.
    constexpr std::uint32_t lanes = RadiusBlock::lanes;
    const std::uint32_t count = (rect.x1 - rect.x0 + lanes) / lanes * lanes;
    for (std::uint32_t y = rect.y0; y <= rect.y1; ++y, radius += RadiusBlock::columns) {
        const Vec2d row = directions.row(y);
        for (std::uint32_t i = 0; i < count; ++i) {
            const Vec3d g = octahedral ? SampleDirections::octahedral_direction(a[i], row.x)
                                       : SampleDirections::latlong_direction({a[i], b[i]}, row);
            const double x = dot(e0, g);
            const double y_ = dot(e1, g);
            const double z = dot(e2, g);
            const double sum = x + y_ + z;
            const double r = hit_radius(d, sum, g);
            const bool inside = bool(int(x >= 0) & int(y_ >= 0) & int(z >= 0) & int(sum > 0));
            radius[i] = inside ? r : 0;
        }
    }
}

[[gnu::always_inline]] inline void intersect_any(const RaySetup& setup, const SampleDirections& directions,
                                                 const SampleRect& rect, double* radius) {
    if (directions.octahedral())
        intersect_rows<true>(setup, directions, rect, radius);
    else
        intersect_rows<false>(setup, directions, rect, radius);
}

[[gnu::always_inline]] inline void keep_any(const double* radius, std::uint32_t count, std::uint32_t triangle,
                                            OutermostHit* __restrict hits) {
    for (std::uint32_t i = 0; i < count; ++i)
        hits[i].keep_outermost(radius[i] > 0 ? OutermostHit(float(radius[i]), triangle) : OutermostHit());
}

void intersect_baseline(const RaySetup& setup, const SampleDirections& directions, const SampleRect& rect,
                        double* radius) {
    intersect_any(setup, directions, rect, radius);
}

void keep_baseline(const double* radius, std::uint32_t count, std::uint32_t triangle, OutermostHit* hits) {
    keep_any(radius, count, triangle, hits);
}

#ifdef SPA_HAS_AVX2_CLONE
[[gnu::target("avx2")]] void keep_avx2(const double* radius, std::uint32_t count, std::uint32_t triangle,
                                       OutermostHit* hits) {
    keep_any(radius, count, triangle, hits);
}

[[gnu::target("avx2")]] void intersect_avx2(const RaySetup& setup, const SampleDirections& directions,
                                            const SampleRect& rect, double* radius) {
    intersect_any(setup, directions, rect, radius);
}
#endif

} // namespace

void intersect_block(const RaySetup& setup, const SampleDirections& directions, const SampleRect& rect,
                     RadiusBlock& block) {
#ifdef SPA_HAS_AVX2_CLONE
    if (__builtin_cpu_supports("avx2")) return intersect_avx2(setup, directions, rect, block.radius.data());
#endif
    intersect_baseline(setup, directions, rect, block.radius.data());
}

void keep_outermost_row(const double* radius, std::uint32_t count, std::uint32_t triangle,
                        OutermostHit* hits) {
#ifdef SPA_HAS_AVX2_CLONE
    if (__builtin_cpu_supports("avx2")) return keep_avx2(radius, count, triangle, hits);
#endif
    keep_baseline(radius, count, triangle, hits);
}

} // namespace spa::bake
