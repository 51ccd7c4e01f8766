// SPDX-License-Identifier: Apache-2.0
#include "loaded_scene.h"

#include "../../samples/samples.h"

#include <cmath>
#include <random>
#include <utility>

namespace spa::test {
namespace {

constexpr Vec3d lamp{3, 5, 4}; // of shaders/map_ray.glsl

shader::SpaMethod method_of(const vulkan::TraceConstants& constants) {
    shader::SpaMethod method = shader::spa_method_defaults(constants.tracer);
    method.fan.count = constants.count;
    method.fan.count_rule = constants.count_rule;
    method.fan.start = constants.fan_start;
    method.march.steps = constants.count;
    return method;
}

shader::float3 to_shader(Vec3f v) { return {v.x, v.y, v.z}; }
Vec3f from_shader(shader::float3 v) { return {v.x, v.y, v.z}; }

} // namespace

void LoadedScene::add_map(const std::vector<std::string>& samples, const Grid& grid, std::uint32_t layers) {
    Baked& baked = maps_.emplace_back();
    for (const std::string& sample : samples) {
        bake::Options options;
        options.grid = options.color_grid = grid;
        options.layers = layers;
        baked.owners.push_back(bake::bake_model(samples::make_sample(sample, 3), options).map);
        baked.map.parts.push_back(baked.owners.back().map.parts.front());
        baked.map.parts.back().center.x += double(baked.map.parts.size() - 1) * 0.3;
    }
}

void LoadedScene::punch_holes(std::uint32_t map, std::uint32_t side) {
    for (Part& part : maps_[map].map.parts) {
        ImageView& color = part.layers.front().outer.color;
        std::vector<std::byte>& bytes =
            maps_[map].colors.emplace_back(color.bytes.begin(), color.bytes.end());
        for (std::uint32_t y = 0; y < color.height; ++y)
            for (std::uint32_t x = 0; x < color.width; ++x)
                if ((x / side + y / side) % 2 == 1)
                    bytes[(std::size_t(y) * color.width + x) * 4 + 3] = std::byte{0};
        color.bytes = bytes;
    }
}

void LoadedScene::load(const Rig& rig, const vulkan::LoadOptions& options) {
    for (Baked& baked : maps_) {
        objects_.emplace_back(rig.loader, baked.map, options);
        baked.first_image = std::uint32_t(images_.size());
        for (const Part& part : baked.map.parts) images_.emplace_back(part);
    }
    std::vector<vulkan::MapObject*> objects;
    for (vulkan::MapObject& object : objects_) objects.push_back(&object);
    vulkan::load(rig.loader, rig.device.queue(), rig.device.queue_family(), objects);

    for (const Placed& placed : placed_) {
        const Baked& baked = maps_[placed.map];
        for (std::uint32_t part = 0; part < baked.map.parts.size(); ++part) {
            const auto index = std::uint32_t(records_.size());
            vulkan::InstanceOptions instance;
            instance.custom_index = instance.hit_record = index;
            instances_.push_back(objects_[placed.map].instance(part, placed.to_world, instance));
            records_.push_back(objects_[placed.map].shader_record(part, placed.flags));
            targets_.push_back({baked.first_image + part,
                                trace::map_space(baked.map.parts[part], placed.to_world),
                                records_.back().flags});
        }
    }
}

Expected LoadedScene::in_map(std::uint32_t record, const shader::SpaRay& ray,
                             const vulkan::TraceConstants& constants) const {
    const Target& target = targets_[record];
    const shader::SpaMap& map = images_[target.image].map();
    shader::SpaHit hit;
    Expected expected;
    expected.hit =
        shader::spa_trace_record(map, ray, method_of(constants), target.flags, constants.hole_threshold, hit);
    if (!expected.hit) return expected;
    const shader::SpaShade shade = shader::spa_shade(map, hit);
    expected.t = hit.t;
    expected.record = record;
    expected.kind = shader::spa_hit_kind(hit, false);
    expected.color = from_shader(shade.color);
    expected.normal = from_shader(shade.normal);
    return expected;
}

Expected LoadedScene::expected(const WorldRay& ray, const vulkan::TraceConstants& constants) const {
    Expected best;
    for (std::uint32_t i = 0; i < targets_.size(); ++i) {
        const trace::Ray local =
            trace::to_map(targets_[i].space, {ray.origin, ray.t_min, ray.direction, ray.t_max});
        shader::SpaRay map_ray;
        map_ray.origin = to_shader(local.origin);
        map_ray.t_min = local.t_min;
        map_ray.direction = to_shader(local.direction);
        // As spa_reach of shaders/spa_trace.glsl.
        map_ray.t_max = constants.tracer == SPA_PROJECTIVE ? local.t_max : 1e30F;
        const Expected found = in_map(i, map_ray, constants);
        if (found.hit && found.t <= local.t_max && (!best.hit || found.t < best.t)) best = found;
    }
    if (!best.hit) return best;
    best.normal = trace::normal_to_world(targets_[best.record].space, best.normal);
    const Vec3d place = to_double(ray.origin) + to_double(ray.direction) * double(best.t);
    best.diffuse = std::max(0.0F, dot(best.normal, to_float(normalize(lamp - place))));
    return best;
}

std::vector<WorldRay> world_rays(std::size_t count, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    const auto point = [&](float size) {
        return Vec3f{unit(random) * 2 - 1, unit(random) * 2 - 1, unit(random) * 2 - 1} * size;
    };
    std::vector<WorldRay> rays(count);
    for (WorldRay& ray : rays) {
        ray.origin = point(2);
        Vec3f direction = point(0.6F) - ray.origin;
        if (unit(random) < 0.05F) direction = {0, unit(random) < 0.5F ? -1.0F : 1.0F, 0};
        ray.direction = direction * std::pow(10.0F, unit(random) * 6 - 3);
        const float reach = 1 / length(ray.direction);
        const bool limited = unit(random) < 0.3F;
        ray.t_min = limited ? unit(random) * 2 * reach : 0;
        ray.t_max = limited ? ray.t_min + unit(random) * 3 * reach : 1e30F;
    }
    return rays;
}

} // namespace spa::test
