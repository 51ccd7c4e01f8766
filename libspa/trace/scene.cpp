// SPDX-License-Identifier: Apache-2.0
#include "scene.h"

#include "../core/error.h"
#include "trace.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

namespace spa::trace {
namespace {

constexpr std::size_t block_size = 2048;

bool is_finite(const Mat3& m) {
    return spa::is_finite(m.row[0]) && spa::is_finite(m.row[1]) && spa::is_finite(m.row[2]);
}

// No smaller than how far the matrix takes a unit vector: the largest of what |M^T M| can do to one, by rows.
double largest_stretch(const Mat3& m) {
    const Mat3 square = transpose(m) * m;
    double largest = 0;
    for (const Vec3d& row : square.row)
        largest = std::max(largest, std::abs(row.x) + std::abs(row.y) + std::abs(row.z));
    return std::sqrt(largest);
}

} // namespace

// The rays of a block that may hit one instance, in its map space.
struct Scene::Block {
    std::array<std::uint32_t, block_size> index{};
    std::array<Ray, block_size> rays;
    std::array<Hit, block_size> hits;
    std::array<std::uint8_t, block_size> blocked{};
};

std::uint32_t Scene::add(const TraceMap& map, const Part& part, const Affine& object_to_world) {
    if (part.mapping != Mapping::octahedral)
        throw Error(ExitCode::unsupported, "a scene traces octahedral maps; this one is " +
                                               std::string(name(part.mapping)) + ": bake it as octahedral");
    Instance instance{&map, {}, 0};
    place(instance, part, object_to_world);
    Part placement = part;
    placement.layers.clear(); // views that may not outlive this object
    placement.mixed = placement.folds = {};
    parts_.push_back(std::move(placement));
    instances_.push_back(instance);
    return size() - 1;
}

void Scene::move(std::uint32_t instance, const Affine& object_to_world) {
    place(instances_[instance], parts_[instance], object_to_world);
}

void Scene::place(Instance& instance, const Part& part, const Affine& object_to_world) {
    const MapSpace space = map_space(part, object_to_world);
    if (!is_finite(space.to_world) || !is_finite(space.to_map) || !spa::is_finite(space.origin))
        throw Error(ExitCode::usage, "an instance's transform has no inverse");
    instance.space = space;
    instance.radius = largest_stretch(space.to_world) * double(instance.map->map().radius);
}

// Conservative; in double precision, so that slack need not depend on how far away a ray begins. False also
// for what is no ray.
bool Scene::may_hit(const Instance& instance, const Ray& ray) {
    const Vec3d direction = to_double(ray.direction);
    const Vec3d to_center = instance.space.origin - to_double(ray.origin);
    const double dd = dot(direction, direction);
    const double radius = instance.radius * (1 + 1e-5);
    const double along = dot(to_center, direction);
    const double across = dot(to_center, to_center) - along * along / dd;
    // What a ray's float direction and origin lose of the distance.
    const double lost = 1e-6 * dot(to_center, to_center);
    if (!(across <= radius * radius + lost)) return false;
    // Behind the ray's end, or before its begin.
    const double half = std::sqrt((radius * radius + lost) / dd);
    return along / dd - half <= double(ray.t_max) && along / dd + half >= double(ray.t_min);
}

bool Scene::instance_hit(std::uint32_t instance, const Ray& ray, std::uint32_t flags, Hit& hit) const {
    const Instance& i = instances_[instance];
    if (!may_hit(i, ray) || !trace::closest_hit(*i.map, to_map(i.space, ray), flags, hit)) {
        hit = Hit{};
        return false;
    }
    hit = to_world(i.space, hit);
    hit.instance = instance;
    return true;
}

// Instances behind the best hit so far are passed over; the others are traced over the whole ray, since
// another t_max may change the last bits of a hit, and the answer would depend on the order.
bool Scene::closest_hit(const Ray& ray, std::uint32_t flags, Hit& hit) const {
    hit = Hit{};
    Ray rest = ray;
    for (std::uint32_t i = 0; i < size(); ++i) {
        Hit found;
        if (!may_hit(instances_[i], rest) || !instance_hit(i, ray, flags, found)) continue;
        if (!(found.t < hit.t)) continue;
        hit = found;
        rest.t_max = found.t;
    }
    return hit.valid();
}

bool Scene::occluded(const Ray& ray, std::uint32_t flags) const {
    return std::any_of(instances_.begin(), instances_.end(), [&](const Instance& instance) {
        return may_hit(instance, ray) && trace::occluded(*instance.map, to_map(instance.space, ray), flags);
    });
}

void Scene::closest_in_block(std::span<const Ray> rays, std::uint32_t flags, std::span<Hit> hits,
                             Block& block) const {
    std::fill(hits.begin(), hits.end(), Hit{});
    for (std::uint32_t k = 0; k < size(); ++k) {
        const Instance& instance = instances_[k];
        std::size_t count = 0;
        for (std::uint32_t i = 0; i < rays.size(); ++i) {
            Ray rest = rays[i];
            if (hits[i].valid()) rest.t_max = hits[i].t;
            if (!may_hit(instance, rest)) continue;
            block.index[count] = i;
            block.rays[count++] = to_map(instance.space, rays[i]);
        }
        trace::closest_hits(*instance.map, std::span(block.rays).first(count), flags,
                            std::span(block.hits).first(count));
        for (std::size_t j = 0; j < count; ++j) {
            const Hit& found = block.hits[j];
            Hit& best = hits[block.index[j]];
            if (!(found.t < best.t)) continue;
            best = to_world(instance.space, found);
            best.instance = k;
        }
    }
}

void Scene::occluded_in_block(std::span<const Ray> rays, std::uint32_t flags, std::span<std::uint8_t> blocked,
                              Block& block) const {
    std::fill(blocked.begin(), blocked.end(), std::uint8_t(0));
    for (const Instance& instance : instances_) {
        std::size_t count = 0;
        for (std::uint32_t i = 0; i < rays.size(); ++i) {
            if (blocked[i] != 0 || !may_hit(instance, rays[i])) continue;
            block.index[count] = i;
            block.rays[count++] = to_map(instance.space, rays[i]);
        }
        trace::occluded(*instance.map, std::span(block.rays).first(count), flags,
                        std::span(block.blocked).first(count));
        for (std::size_t j = 0; j < count; ++j) blocked[block.index[j]] = block.blocked[j];
    }
}

template <class Result, class Trace>
void Scene::trace_blocks(std::span<const Ray> rays, std::span<Result> results, Trace trace_block) {
    const std::size_t blocks = (rays.size() + block_size - 1) / block_size;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks), [&](const auto& range) {
        const auto block = std::make_unique<Block>();
        for (std::size_t b = range.begin(); b < range.end(); ++b) {
            const std::size_t first = b * block_size;
            const std::size_t count = std::min(block_size, rays.size() - first);
            trace_block(rays.subspan(first, count), results.subspan(first, count), *block);
        }
    });
}

void Scene::closest_hits(std::span<const Ray> rays, std::uint32_t flags, std::span<Hit> hits) const {
    trace_blocks(rays, hits, [&](std::span<const Ray> some, std::span<Hit> theirs, Block& block) {
        closest_in_block(some, flags, theirs, block);
    });
}

void Scene::occluded(std::span<const Ray> rays, std::uint32_t flags, std::span<std::uint8_t> blocked) const {
    trace_blocks(rays, blocked, [&](std::span<const Ray> some, std::span<std::uint8_t> theirs, Block& block) {
        occluded_in_block(some, flags, theirs, block);
    });
}

Shade Scene::shade(const Hit& hit) const {
    const Instance& instance = instances_[hit.instance];
    Shade result = trace::shade(*instance.map, hit);
    result.normal = result.has_normal ? normal_to_world(instance.space, result.normal) : hit.normal;
    return result;
}

} // namespace spa::trace
