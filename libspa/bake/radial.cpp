// SPDX-License-Identifier: Apache-2.0
#include "radial.h"

#include "arena.h"
#include "candidates.h"
#include "progress_meter.h"
#include "sample_directions.h"
#include "shading.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

namespace spa::bake {
namespace {

// A triangle ready to be met by rays g from the origin. Edge function i is the triple product of g with the
// edge opposite to corner i; with D = A.(B x C), g meets the triangle iff all three have the sign of D, zero
// included, and then at t = D/S along g, S their sum, with barycentrics e_i/S. Without contracted
// multiply-adds A x B is exactly -(B x A), so triangles that share two positions agree on the edge between
// them and no direction slips through.
struct RaySetup {
    Vec3d edge[3];
    double d = 0; // > 0
    bool front_facing = true;

    RaySetup(const CenteredModel& model, const Triangle& triangle) {
        const Vec3d a = to_double(model.positions[triangle.vertex[0]]);
        const Vec3d b = to_double(model.positions[triangle.vertex[1]]);
        const Vec3d c = to_double(model.positions[triangle.vertex[2]]);
        const double sign = dot(a, cross(b, c)) < 0 ? -1.0 : 1.0;
        edge[0] = cross(b, c) * sign;
        edge[1] = cross(c, a) * sign;
        edge[2] = cross(a, b) * sign;
        d = std::abs(dot(a, cross(b, c)));
        front_facing = (sign > 0) != model.mirrored;
    }
    // False for a triangle whose plane holds the origin: no direction sees it.
    [[nodiscard]] bool visible() const { return d > 0; }
};

struct Hit {
    Vec3d barycentric;
    double radius = 0;
};

bool intersect(const RaySetup& setup, Vec3d g, Hit& hit) {
    const Vec3d e{dot(setup.edge[0], g), dot(setup.edge[1], g), dot(setup.edge[2], g)};
    if (!(e.x >= 0 && e.y >= 0 && e.z >= 0)) return false;
    const double sum = e.x + e.y + e.z;
    if (!(sum > 0)) return false;
    hit.barycentric = e * (1 / sum);
    hit.radius = std::clamp(setup.d / sum * length(g), double(std::numeric_limits<float>::min()), 1.0);
    return true;
}

// Area in the triangle's plane that a sample stands for (crossings.h): solid angle * r^2 / cos.
double footprint(const CenteredModel& model, const Triangle& triangle, const Grid& grid, TexelIndex texel,
                 Vec3d g, double radius) {
    const Vec3d a = to_double(model.positions[triangle.vertex[0]]);
    const Vec3d plane = normalize(cross(to_double(model.positions[triangle.vertex[1]]) - a,
                                        to_double(model.positions[triangle.vertex[2]]) - a));
    const double cosine = std::abs(dot(plane, g)) / length(g);
    return solid_angle(grid, texel) * radius * radius / std::max(cosine, 0.05);
}

struct Scene {
    const CenteredModel& model;
    const Grid& grid;
    SampleDirections directions;
    Shader shader;

    [[nodiscard]] TexelIndex texel(std::size_t sample) const {
        return {std::uint32_t(sample % grid.width), std::uint32_t(sample / grid.width)};
    }
    // Identified samples have one direction, but a triangle at the border may meet only one of them within
    // its octant: what any of them finds belongs to all.
    [[nodiscard]] std::size_t owner(TexelIndex at) const {
        const TexelIndex c = canonical(grid, at);
        return std::size_t(c.y) * grid.width + c.x;
    }
    [[nodiscard]] std::size_t owner(std::size_t sample) const { return owner(texel(sample)); }
    // False where alpha leaves no surface.
    [[nodiscard]] bool visible(std::uint32_t triangle, TexelIndex at, Vec3d g, const Hit& hit) const {
        if (!shader.needs_alpha(triangle)) return true;
        const double area = footprint(model, model.model->triangles[triangle], grid, at, g, hit.radius);
        return shader.color(triangle, hit.barycentric, area).visible;
    }
    [[nodiscard]] Crossing shade(std::size_t sample, std::uint32_t triangle) const {
        const TexelIndex at = texel(sample);
        const Vec3d g = directions(at.x, at.y);
        const Triangle& t = model.model->triangles[triangle];
        const RaySetup setup(model, t);
        Hit hit;
        intersect(setup, g, hit);
        const double area = footprint(model, t, grid, at, g, hit.radius);
        return {float(hit.radius), triangle, shader.normal(triangle, hit.barycentric),
                shader.color(triangle, hit.barycentric, area).srgba, setup.front_facing};
    }
};

// Calls found(sample, triangle, hit, front_facing) for every pair of sample and triangle that meet, in
// parallel over triangles; a pair may come twice.
template <class Found>
void rasterize(const Scene& scene, ProgressMeter& meter, Found&& found) {
    const auto& triangles = scene.model.model->triangles;
    const Candidates candidates(scene.grid, scene.model.positions);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, triangles.size(), 1024), [&](const auto& range) {
        if (meter.cancelled()) return;
        std::array<SampleRect, Candidates::max_rects> rects;
        for (auto i = std::uint32_t(range.begin()); i < range.end(); ++i) {
            const std::size_t count = candidates.find(triangles[i], rects);
            if (count == 0) continue;
            const RaySetup setup(scene.model, triangles[i]);
            if (!setup.visible()) continue;
            for (std::size_t r = 0; r < count; ++r) {
                for (std::uint32_t y = rects[r].y0; y <= rects[r].y1; ++y) {
                    for (std::uint32_t x = rects[r].x0; x <= rects[r].x1; ++x) {
                        const Vec3d g = scene.directions(x, y);
                        Hit hit;
                        if (!intersect(setup, g, hit) || !scene.visible(i, {x, y}, g, hit)) continue;
                        found(scene.owner({x, y}), i, hit, setup.front_facing);
                    }
                }
            }
        }
        meter.add(range.size());
    });
    meter.throw_if_cancelled();
}

std::size_t sample_count(const Grid& grid) { return std::size_t(grid.width) * grid.height; }

// Positive floats order like their bits, so one integer maximum picks the outermost crossing and, among
// equals, the smallest triangle index - in whatever order threads arrive.
CrossingGrid cast_outermost(const Scene& scene, ProgressMeter& meter) {
    std::vector<std::uint64_t> keys(sample_count(scene.grid), 0);
    rasterize(scene, meter, [&](std::size_t sample, std::uint32_t triangle, const Hit& hit, bool) {
        const std::uint64_t key =
            std::uint64_t(std::bit_cast<std::uint32_t>(float(hit.radius))) << 32U | (0xFFFFFFFFU - triangle);
        const std::atomic_ref<std::uint64_t> best(keys[sample]);
        std::uint64_t seen = best.load(std::memory_order_relaxed);
        while (seen < key && !best.compare_exchange_weak(seen, key, std::memory_order_relaxed)) {
        }
    });
    CrossingGrid result;
    result.grid = scene.grid;
    result.first.resize(keys.size() + 1, 0);
    for (std::size_t s = 0; s < keys.size(); ++s) {
        result.first[s + 1] = result.first[s] + (keys[scene.owner(s)] != 0 ? 1 : 0);
    }
    result.crossings.resize(result.first.back());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, keys.size(), 1024), [&](const auto& range) {
        for (std::size_t s = range.begin(); s < range.end(); ++s) {
            const std::uint64_t key = keys[scene.owner(s)];
            if (key == 0) continue;
            result.crossings[result.first[s]] =
                scene.shade(s, 0xFFFFFFFFU - std::uint32_t(key & 0xFFFFFFFFU));
        }
    });
    return result;
}

struct Found {
    std::uint32_t sample;
    std::uint32_t triangle;
    float radius;
    bool front_facing;
};

// One sample's crossings in order, duplicates merged; returns the new end.
Found* order_crossings(Found* begin, Found* end) {
    std::sort(begin, end, [](const Found& a, const Found& b) {
        if (a.radius != b.radius) return a.radius > b.radius;
        if (a.front_facing != b.front_facing) return a.front_facing;
        return a.triangle < b.triangle;
    });
    Found* out = begin;
    for (const Found* in = begin; in != end; ++in) {
        // Among the kept ones within merge_distance at most one has the same facing.
        Found* same = out;
        for (Found* kept = out; kept-- != begin && kept->radius - in->radius < merge_distance;) {
            if (kept->front_facing == in->front_facing) same = kept;
        }
        if (same != out)
            same->triangle = std::min(same->triangle, in->triangle);
        else
            *out++ = *in;
    }
    return out;
}

CrossingGrid cast_all(const Scene& scene, ProgressMeter& meter) {
    tbb::enumerable_thread_specific<std::vector<Found>> lists;
    rasterize(scene, meter,
              [&](std::size_t sample, std::uint32_t triangle, const Hit& hit, bool front_facing) {
                  lists.local().push_back({std::uint32_t(sample), triangle, float(hit.radius), front_facing});
              });
    const std::size_t samples = sample_count(scene.grid);
    std::vector<std::uint64_t> begin(samples + 1, 0);
    for (const auto& list : lists) {
        for (const Found& f : list) ++begin[f.sample + 1U];
    }
    for (std::size_t s = 0; s < samples; ++s) begin[s + 1] += begin[s];
    std::vector<Found> found(begin.back());
    {
        std::vector<std::uint64_t> next(begin.begin(), begin.end() - 1);
        for (auto& list : lists) {
            for (const Found& f : list) found[next[f.sample]++] = f;
            std::vector<Found>().swap(list);
        }
    }
    std::vector<std::uint32_t> kept(samples);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, samples, 4096), [&](const auto& range) {
        for (std::size_t s = range.begin(); s < range.end(); ++s) {
            Found* const first = found.data() + begin[s];
            kept[s] = std::uint32_t(order_crossings(first, found.data() + begin[s + 1]) - first);
        }
    });
    CrossingGrid result;
    result.grid = scene.grid;
    result.first.resize(samples + 1, 0);
    for (std::size_t s = 0; s < samples; ++s) result.first[s + 1] = result.first[s] + kept[scene.owner(s)];
    result.crossings.resize(result.first.back());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, samples, 1024), [&](const auto& range) {
        for (std::size_t s = range.begin(); s < range.end(); ++s) {
            const Found* const first = found.data() + begin[scene.owner(s)];
            for (std::uint64_t k = result.first[s]; k < result.first[s + 1]; ++k) {
                result.crossings[k] = scene.shade(s, first[k - result.first[s]].triangle);
            }
        }
    });
    return result;
}

} // namespace

CrossingGrid cast_radial(const CenteredModel& model, const Grid& grid, const CastOptions& options) {
    const Scene scene{model, grid, SampleDirections(grid), Shader(model)};
    ProgressMeter meter(options.progress, model.model->triangles.size());
    CrossingGrid result;
    tbb::task_arena arena(arena_concurrency(options.threads));
    arena.execute(
        [&] { result = options.outermost_only ? cast_outermost(scene, meter) : cast_all(scene, meter); });
    return result;
}

} // namespace spa::bake
