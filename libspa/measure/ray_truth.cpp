// SPDX-License-Identifier: Apache-2.0
#include "ray_truth.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace spa::measure {

struct RayTruth::Found {
    trace::TriangleHit hit; // t along the ray as given
    Vec3d barycentric;
};

RayTruth::RayTruth(const bake::CenteredModel& model, const trace::TriangleScene& scene)
    : model_(&model), scene_(&scene), shader_(model) {}

Across across(Vec3f direction) {
    const Vec3d d = normalize(to_double(direction));
    const Vec3d least = std::abs(d.x) <= std::abs(d.y) && std::abs(d.x) <= std::abs(d.z) ? Vec3d{1, 0, 0}
                        : std::abs(d.y) <= std::abs(d.z)                                 ? Vec3d{0, 1, 0}
                                                                                         : Vec3d{0, 0, 1};
    const Vec3d first = normalize(cross(d, least));
    return {to_float(first), to_float(cross(d, first))};
}

Vec3d barycentric_of(const bake::CenteredModel& model, std::uint32_t triangle, Vec3d point) {
    const auto& v = model.model->triangles[triangle].vertex;
    const Vec3d a = to_double(model.positions[v[0]]);
    const Vec3d ab = to_double(model.positions[v[1]]) - a;
    const Vec3d ac = to_double(model.positions[v[2]]) - a;
    const Vec3d n = cross(ab, ac);
    const double nn = dot(n, n);
    if (!(nn > 0)) return {1, 0, 0};
    const Vec3d p = point - a;
    const double y = std::clamp(dot(cross(p, ac), n) / nn, 0.0, 1.0);
    const double z = std::clamp(dot(cross(ab, p), n) / nn, 0.0, 1.0);
    const double sum = std::max(1.0, y + z);
    return {1 - (y + z) / sum, y / sum, z / sum};
}

bool RayTruth::find(const trace::Ray& ray, Found& found) const {
    // Embree's rays start at 0 here; those of no sense it reports as misses.
    double begin = ray.t_min;
    constexpr int most_layers = 64; // of invisible surface that a ray is followed through
    for (int i = 0; i < most_layers; ++i) {
        const Vec3d origin = to_double(ray.origin) + to_double(ray.direction) * begin;
        trace::TriangleHit hit;
        const float rest = i == 0 && ray.t_min == 0 ? ray.t_max : float(double(ray.t_max) - begin);
        if (!(rest > 0) || !scene_->closest_hit(to_float(origin), ray.direction, rest, hit)) return false;
        const double t = begin + hit.t;
        const Vec3d point = to_double(ray.origin) + to_double(ray.direction) * t;
        found.barycentric = barycentric_of(*model_, hit.triangle, point);
        found.hit = hit;
        found.hit.t = float(t);
        if (!shader_.needs_alpha(hit.triangle) || shader_.color(hit.triangle, found.barycentric, 0).visible)
            return true;
        constexpr double step = 1e-6; // beyond the rounding of positions about 1
        begin = t + step / std::max(length(to_double(ray.direction)), 1e-30);
    }
    return false;
}

RayAnswer RayTruth::answer(const trace::Ray& ray) const {
    Found found;
    if (!find(ray, found)) return {};
    if (!found.hit.front_facing) {
        // Even robust, a ray that is aimed at an edge may slip through it and meet the surface behind from
        // within. Then its neighbours meet something nearer.
        constexpr float beside = 2e-6F;
        const Across sides = across(ray.direction);
        for (const Vec3f side : {sides.first, -sides.first, sides.second, -sides.second}) {
            trace::Ray neighbour = ray;
            neighbour.origin = ray.origin + side * beside;
            Found other;
            if (!find(neighbour, other) || !other.hit.front_facing || !(other.hit.t < found.hit.t)) continue;
            found = other;
        }
    }
    return {found.hit.t, shader_.normal(found.hit.triangle, found.barycentric),
            shader_.color(found.hit.triangle, found.barycentric, 0).srgba};
}

std::vector<RayAnswer> RayTruth::trace(std::span<const trace::Ray> rays) const {
    std::vector<RayAnswer> answers(rays.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), 1024), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) answers[i] = answer(rays[i]);
    });
    return answers;
}

std::vector<std::uint8_t> RayTruth::silhouette_band(std::span<const trace::Ray> rays,
                                                    std::span<const RayAnswer> truth, float width) const {
    std::vector<std::uint8_t> band(rays.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), 1024), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const Across sides = across(rays[i].direction);
            for (const Vec3f side : {sides.first, -sides.first, sides.second, -sides.second}) {
                trace::Ray parallel = rays[i];
                parallel.origin = parallel.origin + side * width;
                Found found;
                if (find(parallel, found) != truth[i].hits()) band[i] = 1;
            }
        }
    });
    return band;
}

} // namespace spa::measure
