// SPDX-License-Identifier: Apache-2.0
#include "device_scene.h"

#include "clock.h"
#include "scene_materials.h"
#include "upload.h"

#include "../core/error.h"
#include "../vulkan/submit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

namespace spa::render {
namespace {

// docs/rendering.md, "Where rays start".
constexpr double scene_offset = 4e-6; // of the diagonal of the scene's box
constexpr double map_offset = 0.6;    // of the distance between a map's samples

double diagonal(const std::vector<Vec3f>& points) {
    if (points.empty()) return 0;
    Vec3f low = points.front();
    Vec3f high = low;
    for (const Vec3f& p : points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return length(to_double(high) - to_double(low));
}

// How far apart a part's samples are in the world, on a sphere of its size: that is what its surface is
// exact to.
double sample_distance(const Part& part, const Affine& to_world) {
    const Mat3 m = to_world.linear * part.frame;
    const double scale =
        std::sqrt((dot(m.row[0], m.row[0]) + dot(m.row[1], m.row[1]) + dot(m.row[2], m.row[2])) / 3);
    const ImageView& depth = part.layers.front().outer.depth;
    return part.radius * scale * std::sqrt(4 * 3.14159265358979 / (double(depth.width) * depth.height));
}

// Where each part of the map stands in the world; of what is dropped there is none. Throws
// Error{invalid_data} if one has no inverse.
std::vector<Affine> places_of(const Scene& scene, const MapPlacement& placement) {
    if (placement.dropped) return {};
    std::vector<Affine> places = placement.parts;
    if (places.empty())
        places.assign(placement.map->parts.size(),
                      placement.node == no_index ? Affine{} : scene.nodes[placement.node].to_world);
    if (places.size() != placement.map->parts.size())
        throw Error(ExitCode::usage, "a map of " + std::to_string(placement.map->parts.size()) +
                                         " parts is placed by " + std::to_string(places.size()) +
                                         " transforms");
    for (const Affine& place : places)
        if (!(std::abs(determinant(place.linear)) > 0))
            throw Error(ExitCode::invalid_data,
                        (placement.node == no_index ? "a part of the map of the scene"
                                                    : "node '" + scene.nodes[placement.node].name + "'") +
                            " has a transform without inverse: a map cannot replace it");
    return places;
}

VkAccelerationStructureInstanceKHR triangle_instance(const vulkan::AccelerationStructure& structure,
                                                     std::uint32_t custom_index, std::uint32_t object) {
    VkAccelerationStructureInstanceKHR instance{};
    for (std::size_t i = 0; i < 3; ++i) instance.transform.matrix[i][i] = 1;
    instance.instanceCustomIndex = custom_index & 0xFFFFFFU;
    instance.mask = object == 0 ? SPA_MASK_STATIC : SPA_MASK_REPLACED;
    instance.accelerationStructureReference = structure.address();
    return instance;
}

} // namespace

DeviceScene::State::State(const Gpu& gpu, const Scene& scene, std::span<const MapPlacement> maps,
                          bool keep_replaced)
    : has_replaced(keep_replaced || maps.empty()), keeps_replaced_(keep_replaced),
      objects_(objects_of_nodes(scene, maps)) {
    const SceneTriangles triangles = group_triangles(scene, objects_, maps.size(), keep_replaced);
    const double scene_size = diagonal(scene.model.positions) * scene_offset;
    offsets_.push_back(float(scene_size));
    globals.offset = float(scene_size);
    for (const MapPlacement& placement : maps) {
        double size = 0;
        const std::vector<Affine> places = places_of(scene, placement);
        for (std::size_t i = 0; i < places.size(); ++i)
            size = std::max(size, sample_distance(placement.map->parts[i], places[i]));
        offsets_.push_back(float(std::max(scene_size, size * map_offset)));
    }

    times.upload = seconds_of([&] {
        add_triangles(gpu, scene, triangles);
        add_materials(gpu, scene, triangles);
        add_lights(gpu, scene);
    });
    build_structures(gpu);
    add_triangle_instances();
    times.map_load = seconds_of([&] { add_maps(gpu, scene, maps); });
    times.upload += seconds_of([&] { globals.instances = keep(upload(gpu, instances_)); });
    times.top_level = seconds_of([&] { add_top_level(gpu); });
}

VkDeviceAddress DeviceScene::State::keep(vulkan::Buffer buffer) {
    if (buffer.empty()) return 0;
    buffers_.push_back(std::move(buffer));
    return buffers_.back().address();
}

void DeviceScene::State::add_triangles(const Gpu& gpu, const Scene& scene, const SceneTriangles& triangles) {
    groups_ = triangles.groups;
    positions_ = upload(gpu, triangles.positions);
    normals_ = upload(gpu, triangles.normals);
    globals.positions = positions_.address();
    globals.normals = normals_.address();
    globals.uvs = keep(upload(gpu, triangles.uvs));
    globals.colors = keep(upload(gpu, triangles.colors));
    globals.indices = keep(upload(gpu, triangles.triangles));
    globals.triangle_materials = keep(upload(gpu, triangles.materials));

    const Model& model = scene.model;
    const std::uint64_t vertex_bytes = sizeof(Vec3f) + (model.normals.empty() ? 0 : sizeof(Vec3f)) +
                                       (model.uvs.empty() ? 0 : sizeof(Vec2f)) +
                                       (model.colors.empty() ? 0 : sizeof(Vec4f));
    for (const TriangleGroup& group : triangles.groups) {
        std::uint64_t& bytes = group.object == 0 ? memory.triangles : memory.replaced_triangles;
        bytes += group.vertex_count * vertex_bytes +
                 group.triangle_count * (sizeof(Triangle) + sizeof(std::uint32_t));
    }
}

void DeviceScene::State::add_materials(const Gpu& gpu, const Scene& scene, const SceneTriangles& triangles) {
    const Model& model = scene.model;
    std::vector<bool> used(model.textures.size(), false);
    for (const TriangleGroup& group : triangles.groups) { // those of no object come first
        std::uint64_t& bytes = group.object == 0 ? memory.triangles : memory.replaced_triangles;
        for (std::uint32_t i = 0; i < group.triangle_count; ++i) {
            const std::uint32_t texture =
                model.materials[triangles.materials[group.first_triangle + i]].texture;
            if (texture == no_index || model.uvs.empty() || used[texture]) continue;
            used[texture] = true;
            bytes += model.textures[texture].mips.front().pixels.size() * sizeof(std::uint32_t);
        }
    }
    const SceneMaterials materials = make_materials(model, used);
    globals.materials = keep(upload(gpu, materials.materials));
    globals.textures = keep(upload(gpu, materials.textures));
    globals.texels = keep(upload(gpu, materials.texels));
}

void DeviceScene::State::add_lights(const Gpu& gpu, const Scene& scene) {
    globals.lights = keep(upload(gpu, make_lights(scene.lights)));
    globals.light_count = std::uint32_t(scene.lights.size());
}

void DeviceScene::State::build_structures(const Gpu& gpu) {
    const auto first_replaced = std::find_if(groups_.begin(), groups_.end(),
                                             [](const TriangleGroup& group) { return group.object != 0; });
    const auto count = std::size_t(first_replaced - groups_.begin());
    const std::span<const TriangleGroup> groups(groups_);
    const auto build = [&](std::span<const TriangleGroup> some, TriangleStructures& structures) {
        structures.structures.clear(); // before the buffer that they lie in
        structures = build_triangles(gpu, some, globals.positions, globals.indices);
    };
    times.triangle_build = seconds_of([&] { build(groups.first(count), static_); });
    times.replaced_build = seconds_of([&] { build(groups.subspan(count), replaced_); });
    memory.triangle_structures = static_.storage.size();
    memory.replaced_structures = replaced_.storage.size();
}

const vulkan::AccelerationStructure& DeviceScene::State::structure_of(std::size_t group) const {
    const std::size_t count = static_.structures.size();
    return group < count ? static_.structures[group] : replaced_.structures[group - count];
}

void DeviceScene::State::add_triangle_instances() {
    for (std::size_t i = 0; i < groups_.size(); ++i) {
        const TriangleGroup& group = groups_[i];
        const auto custom_index = std::uint32_t(instances_.size());
        top_instances_.push_back(triangle_instance(structure_of(i), custom_index, group.object));
        data::RenderInstance& instance = instances_.emplace_back();
        instance.first_triangle = group.first_triangle;
        instance.object = group.object;
        instance.offset = offsets_[group.object];
    }
}

void DeviceScene::State::load_maps(const Gpu& gpu, std::span<const MapPlacement> maps) {
    std::vector<vulkan::MapObject*> objects;
    std::map<std::tuple<const SphericalMap*, std::uint32_t, bool, bool>, std::size_t> loaded;
    for (const MapPlacement& placement : maps) {
        map_of_placement_.push_back(maps_.size());
        if (placement.dropped) continue;
        const auto [same, is_new] = loaded.emplace(
            std::tuple(placement.map, placement.layers, placement.holes, placement.test_points),
            maps_.size());
        map_of_placement_.back() = same->second;
        if (!is_new) continue;
        vulkan::LoadOptions options;
        options.compile.layers = placement.layers;
        options.coverage = placement.holes;
        options.whole_sphere = placement.test_points;
        maps_.push_back(std::make_unique<vulkan::MapObject>(gpu.device(), *placement.map, options));
        objects.push_back(maps_.back().get());
    }
    if (objects.empty()) return;
    vulkan::load(gpu.device(), gpu.queue(), gpu.queue_family(), objects);
    for (const vulkan::MapObject* const object : objects) {
        memory.maps += object->memory().images;
        memory.map_structures += object->memory().structures;
    }
}

void DeviceScene::State::add_maps(const Gpu& gpu, const Scene& scene, std::span<const MapPlacement> maps) {
    load_maps(gpu, maps);
    for (std::size_t i = 0; i < maps.size(); ++i) {
        first_instances_.push_back(top_instances_.size());
        if (maps[i].dropped) continue;
        const std::vector<Affine> places = places_of(scene, maps[i]);
        const vulkan::MapObject& map = *maps_[map_of_placement_[i]];
        for (std::uint32_t part = 0; part < map.part_count(); ++part) {
            vulkan::InstanceOptions options;
            options.custom_index = std::uint32_t(instances_.size());
            options.mask = SPA_MASK_MAPS;
            options.hit_record = first_map_record + std::uint32_t(records.size());
            top_instances_.push_back(map.instance(part, places[part], options));
            const vulkan::ShaderRecord record =
                map.shader_record(part, maps[i].test_points ? SPA_CULL_BACK : 0);
            records.push_back(record);
            data::RenderInstance& instance = instances_.emplace_back();
            instance.image = record.image;
            instance.flags = record.flags;
            instance.part = record.part;
            instance.object = std::uint32_t(i + 1);
            instance.offset = offsets_[i + 1];
        }
    }
}

void DeviceScene::State::add_top_level(const Gpu& gpu) {
    // A structure has to have an instance: without a structure it is never hit.
    if (top_instances_.empty()) top_instances_.emplace_back();
    top_level_.emplace(gpu.device(), top_instances_);
    build_top_level(gpu);
    globals.scene = top_level_->structure().address();
    memory.top_level = top_level_->bytes();
}

void DeviceScene::State::build_top_level(const Gpu& gpu) {
    vulkan::submit_and_wait(gpu.device(), gpu.queue(), gpu.queue_family(),
                            [&](VkCommandBuffer commands) { top_level_->record(commands); });
}

void DeviceScene::State::pose_triangles(const Gpu& gpu, const Scene& scene) {
    const SceneTriangles triangles =
        group_triangles(scene, objects_, map_of_placement_.size(), keeps_replaced_);
    times.upload = seconds_of([&] {
        copy_bytes(gpu, std::as_bytes(std::span(triangles.positions)), positions_, 0);
        if (!normals_.empty()) copy_bytes(gpu, std::as_bytes(std::span(triangles.normals)), normals_, 0);
    });
    build_structures(gpu);
    for (std::size_t i = 0; i < groups_.size(); ++i)
        top_instances_[i].accelerationStructureReference = structure_of(i).address();
}

void DeviceScene::State::pose(const Gpu& gpu, const Scene& scene, std::span<const MapPlacement> maps) {
    if (!groups_.empty()) pose_triangles(gpu, scene);
    times.top_level = seconds_of([&] {
        const std::span<VkAccelerationStructureInstanceKHR> instances(top_instances_);
        for (std::size_t i = 0; i < maps.size(); ++i) {
            if (maps[i].dropped) continue;
            const vulkan::MapObject& map = *maps_[map_of_placement_[i]];
            map.move(instances.subspan(first_instances_[i], map.part_count()), places_of(scene, maps[i]));
        }
        top_level_->set_instances(top_instances_);
        build_top_level(gpu);
    });
}

DeviceScene::DeviceScene(const Gpu& gpu, const Scene& scene, std::span<const MapPlacement> maps,
                         bool keep_replaced)
    : state_(std::make_unique<State>(gpu, scene, maps, keep_replaced)) {}
DeviceScene::~DeviceScene() = default;

void DeviceScene::pose(const Gpu& gpu, const Scene& scene, std::span<const MapPlacement> maps) {
    state_->pose(gpu, scene, maps);
}

const SceneMemory& DeviceScene::memory() const { return state_->memory; }
const SceneTimes& DeviceScene::times() const { return state_->times; }

} // namespace spa::render
