// SPDX-License-Identifier: Apache-2.0
// What a DeviceScene is made of, for the renderer's own files.
#pragma once

#include "render.h"
#include "shaders/data.h"
#include "structures.h"

#include "../vulkan/map_object.h"
#include "../vulkan/top_level.h"

#include <memory>
#include <optional>

namespace spa::render {

// Shader records of hit groups: one of all triangles, then one a part.
constexpr std::uint32_t first_map_record = 1;

struct DeviceScene::State {
    State(const Gpu& gpu, const Scene& scene, std::span<const MapPlacement> maps, bool keep_replaced);

    void pose(const Gpu& gpu, const Scene& scene, std::span<const MapPlacement> maps);

    SceneMemory memory;
    SceneTimes times;
    bool has_replaced = false; // triangles of what maps replace are here, if there are any
    // Addresses of what is kept below, and the number of lights.
    data::RenderGlobals globals{};
    // Of parts, in the order of the instances' shader records.
    std::vector<vulkan::ShaderRecord> records;

private:
    void add_triangles(const Gpu& gpu, const Scene& scene, const SceneTriangles& triangles);
    void add_materials(const Gpu& gpu, const Scene& scene, const SceneTriangles& triangles);
    void add_lights(const Gpu& gpu, const Scene& scene);
    void build_structures(const Gpu& gpu);
    [[nodiscard]] const vulkan::AccelerationStructure& structure_of(std::size_t group) const;
    void add_triangle_instances();
    void build_top_level(const Gpu& gpu);
    void pose_triangles(const Gpu& gpu, const Scene& scene);
    void load_maps(const Gpu& gpu, std::span<const MapPlacement> maps);
    void add_maps(const Gpu& gpu, const Scene& scene, std::span<const MapPlacement> maps);
    void add_top_level(const Gpu& gpu);
    // A buffer that lives as long as this; its address, 0 if there is nothing.
    VkDeviceAddress keep(vulkan::Buffer buffer);

    std::vector<vulkan::Buffer> buffers_;
    bool keeps_replaced_;
    std::vector<std::uint32_t> objects_; // of nodes: objects_of_nodes
    vulkan::Buffer positions_, normals_;
    std::vector<TriangleGroup> groups_;
    TriangleStructures static_, replaced_;
    std::vector<std::unique_ptr<vulkan::MapObject>> maps_;
    std::vector<std::size_t> map_of_placement_;   // index into maps_; of what is dropped: of no meaning
    std::vector<float> offsets_;                  // of objects, 0: of what no map replaces
    std::vector<data::RenderInstance> instances_; // by custom index
    std::vector<VkAccelerationStructureInstanceKHR> top_instances_; // the same
    std::vector<std::size_t> first_instances_; // of placements: the instance of part 0; dropped: no meaning
    std::optional<vulkan::TopLevel> top_level_;
};

} // namespace spa::render
