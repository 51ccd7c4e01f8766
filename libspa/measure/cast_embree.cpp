// SPDX-License-Identifier: Apache-2.0
#include "cast_embree.h"

#include "../bake/arena.h"
#include "../bake/order_crossings.h"
#include "../bake/progress_meter.h"
#include "../bake/sample_rays.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace spa::measure {
namespace {

using bake::Crossing;
using bake::RayHit;
using bake::RaySetup;

// Two hits of one facing this close in radius are the two sides of an edge that the ray grazes: a steep face
// turns float noise of 1e-7 across the ray into this much along it.
constexpr double same_surface = 1e-4;

// Where g meets the triangle, or where it comes nearest in its barycentrics. Returns by how much it misses
// it.
double refine(const RaySetup& setup, Vec3d g, double t, RayHit& hit) {
    if (intersect(setup, g, hit)) return 0;
    double missed_by = 0;
    std::array<double, 3> weight{};
    double sum = 0;
    for (unsigned k = 0; k < 3; ++k) {
        // The sine of the ray's angle to the plane through the origin and the edge.
        const double e = dot(setup.edge[k], g);
        const double scale = length(setup.edge[k]) * length(g);
        if (e < 0) missed_by = std::max(missed_by, -e / scale * t);
        weight[k] = std::max(e, 0.0);
        sum += weight[k];
    }
    if (sum > 0) hit.barycentric = Vec3d{weight[0], weight[1], weight[2]} * (1 / sum);
    hit.radius = std::clamp(t, double(std::numeric_limits<float>::min()), 1.0);
    return std::max(missed_by, std::numeric_limits<double>::min());
}

struct Found {
    float radius;
    std::uint32_t triangle;
    bool front_facing;
    double missed_by; // 0: the ray meets the triangle
    RayHit hit;
};

// Four rays around a direction g, within tie_distance of it at the radius 1, at no angle that models are
// built at.
constexpr std::size_t side_rays = 4;
std::array<Vec3d, side_rays> rays_around(Vec3d g) {
    const Vec3d u = normalize(g);
    const Vec3d right = normalize(cross(u, std::abs(u.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0}));
    const Vec3d up = cross(right, u);
    const double x = 0.92 * tie_distance;
    const double y = 0.39 * tie_distance;
    return {u + right * x + up * y, u - right * y + up * x, u - right * x - up * y, u + right * y - up * x};
}

class EmbreeRays {
public:
    EmbreeRays(const bake::SampleRays& rays, const trace::TriangleScene& scene, bool outermost_only)
        : rays_(rays), scene_(scene), outermost_only_(outermost_only) {}

    // The crossings of one ray, outermost first, appended.
    void cast(const CenterRay& ray, std::vector<Crossing>& crossings) {
        // Beyond the unit sphere by more than rounding: a vertex on it must be hit.
        constexpr float reach = 1.01F;
        const TexelIndex at = ray.texel;
        const Vec3d g = ray.direction;
        found_.clear();
        scene_.all_hits({}, to_float(normalize(g)), reach, hits_);
        for (const trace::TriangleHit& h : hits_) {
            const RaySetup setup = setup_of(h.triangle);
            if (!setup.visible()) continue;
            Found found{0, h.triangle, setup.front_facing, 0, {}};
            found.missed_by = refine(setup, g, double(h.t), found.hit);
            found_.push_back(found);
        }
        const auto sides = rays_around(g);
        for (std::size_t k = 0; k < side_rays; ++k) {
            side_hits_[k].clear();
            scene_.all_hits({}, to_float(sides[k]), reach, hits_);
            for (const trace::TriangleHit& h : hits_) {
                const RaySetup setup = setup_of(h.triangle);
                side_hits_[k].push_back({double(h.t), setup.front_facing});
                Found found{0, h.triangle, setup.front_facing, 0, {}};
                const auto same = [&](const Found& f) { return f.triangle == h.triangle; };
                if (!setup.visible() || !intersect(setup, g, found.hit)) continue;
                if (std::none_of(found_.begin(), found_.end(), same)) found_.push_back(found);
            }
        }
        drop_ties();
        for (Found& f : found_) f.radius = float(f.hit.radius);
        std::erase_if(found_, [&](const Found& f) { return !rays_.visible(f.triangle, at, g, f.hit); });
        if (outermost_only_ && !found_.empty()) {
            const auto outermost =
                std::min_element(found_.begin(), found_.end(), [](const Found& a, const Found& b) {
                    return a.radius != b.radius ? a.radius > b.radius : a.triangle < b.triangle;
                });
            append(ray, *outermost, crossings);
            return;
        }
        const Found* const end = bake::order_crossings(found_.data(), found_.data() + found_.size());
        for (const Found* f = found_.data(); f != end; ++f) append(ray, *f, crossings);
    }

private:
    struct SideHit {
        double radius;
        bool front_facing;
    };

    [[nodiscard]] RaySetup setup_of(std::uint32_t triangle) const {
        return {rays_.model, rays_.model.model->triangles[triangle]};
    }

    // Triangles that Embree reports but the ray misses by rounding are no crossings: the ray met their
    // neighbour, which is there too, or passes a border. But of the hundreds around the pole of a sphere the
    // one that is met may be reported by none of the five rays. Then the surface goes on around the ray, all
    // side rays meet it, and the triangle missed least stands for it.
    void drop_ties() {
        if (std::all_of(found_.begin(), found_.end(), [](const Found& f) { return f.missed_by == 0; }))
            return;
        std::sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) {
            return a.missed_by != b.missed_by ? a.missed_by < b.missed_by : a.triangle < b.triangle;
        });
        std::size_t kept = 0;
        for (const Found& f : found_) {
            const auto near = [&](bool front_facing, double radius) {
                return front_facing == f.front_facing && std::abs(radius - f.hit.radius) < same_surface;
            };
            const bool known =
                std::any_of(found_.begin(), found_.begin() + std::ptrdiff_t(kept),
                            [&](const Found& k) { return near(k.front_facing, k.hit.radius); });
            const bool inside =
                std::all_of(side_hits_.begin(), side_hits_.end(), [&](const std::vector<SideHit>& hits) {
                    return std::any_of(hits.begin(), hits.end(),
                                       [&](const SideHit& h) { return near(h.front_facing, h.radius); });
                });
            const bool tie = f.missed_by > 0 && f.missed_by < tie_distance;
            if (!tie || (!known && inside)) found_[kept++] = f;
        }
        found_.resize(kept);
    }

    void append(const CenterRay& ray, const Found& f, std::vector<Crossing>& crossings) const {
        crossings.push_back(rays_.shade(ray.texel, ray.direction, f.triangle, f.hit, f.front_facing));
    }

    const bake::SampleRays& rays_;
    const trace::TriangleScene& scene_;
    bool outermost_only_;
    std::vector<trace::TriangleHit> hits_;
    std::vector<Found> found_;
    std::array<std::vector<SideHit>, side_rays> side_hits_;
};

constexpr std::size_t rays_per_chunk = 256;

struct Chunk {
    std::vector<Crossing> crossings;
    std::vector<std::uint32_t> count; // one a ray
};

} // namespace

bake::CrossingGrid cast_embree(const bake::CenteredModel& model, const trace::TriangleScene& scene,
                               const Grid& grid, std::span<const CenterRay> rays,
                               const bake::CastOptions& options) {
    const bake::SampleRays samples(model, grid);
    std::vector<Chunk> chunks((rays.size() + rays_per_chunk - 1) / rays_per_chunk);
    bake::ProgressMeter meter(options.progress, chunks.size());
    tbb::task_arena arena(bake::arena_concurrency(options.threads));
    arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, chunks.size()), [&](const auto& range) {
            if (meter.cancelled()) return;
            EmbreeRays caster(samples, scene, options.outermost_only);
            for (std::size_t c = range.begin(); c < range.end(); ++c) {
                Chunk& chunk = chunks[c];
                const std::size_t begin = c * rays_per_chunk;
                for (const CenterRay& ray :
                     rays.subspan(begin, std::min(rays_per_chunk, rays.size() - begin))) {
                    const std::size_t before = chunk.crossings.size();
                    caster.cast(ray, chunk.crossings);
                    chunk.count.push_back(std::uint32_t(chunk.crossings.size() - before));
                }
            }
            meter.add(range.size());
        });
    });
    meter.throw_if_cancelled();
    bake::CrossingGrid result;
    result.grid = {Mapping::latlong, std::uint32_t(rays.size()), 1};
    result.first.reserve(rays.size() + 1);
    result.first.push_back(0);
    for (Chunk& chunk : chunks) {
        for (const std::uint32_t count : chunk.count) result.first.push_back(result.first.back() + count);
        result.crossings.insert(result.crossings.end(), chunk.crossings.begin(), chunk.crossings.end());
        std::vector<Crossing>().swap(chunk.crossings);
    }
    return result;
}

bake::CrossingGrid cast_embree(const bake::CenteredModel& model, const trace::TriangleScene& scene,
                               const Grid& grid, const bake::CastOptions& options) {
    const bake::SampleDirections directions(grid);
    std::vector<CenterRay> rays;
    std::vector<std::size_t> ray_of_sample; // of the canonical sample that it is identified with
    for (std::uint32_t y = 0; y < grid.height; ++y) {
        for (std::uint32_t x = 0; x < grid.width; ++x) {
            const TexelIndex owner = canonical(grid, {x, y});
            const std::size_t sample = std::size_t(owner.y) * grid.width + owner.x;
            if (owner == TexelIndex{x, y}) {
                ray_of_sample.push_back(rays.size());
                rays.push_back({owner, directions(x, y)});
            } else {
                ray_of_sample.push_back(ray_of_sample[sample]);
            }
        }
    }
    const bake::CrossingGrid cast = cast_embree(model, scene, grid, rays, options);
    bake::CrossingGrid result;
    result.grid = grid;
    result.first.reserve(ray_of_sample.size() + 1);
    result.crossings.reserve(cast.crossings.size());
    for (const std::size_t ray : ray_of_sample) {
        result.first.push_back(result.crossings.size());
        result.crossings.insert(result.crossings.end(),
                                cast.crossings.begin() + std::ptrdiff_t(cast.first[ray]),
                                cast.crossings.begin() + std::ptrdiff_t(cast.first[ray + 1]));
    }
    result.first.push_back(result.crossings.size());
    return result;
}

} // namespace spa::measure
