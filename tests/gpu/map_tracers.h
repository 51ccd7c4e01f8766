// SPDX-License-Identifier: Apache-2.0
// World rays through loaded maps on the device: by ray queries in a compute shader, and by a ray-tracing
// pipeline with the loader's hit group.
#pragma once

#include "vulkan_device.h"

#include "../../libspa/core/vector.h"
#include "../../libspa/vulkan/buffer.h"
#include "../../libspa/vulkan/hit_group.h"
#include "../../libspa/vulkan/map_object.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace spa::test {

// As in shaders/map_ray.glsl.
struct WorldRay {
    Vec3f origin;
    float t_min = 0;
    Vec3f direction;
    float t_max = 0;
};
struct WorldHit {
    float t = 0; // negative: none
    std::uint32_t instance = 0, part = 0, kind = 0;
    Vec3f color;
    float diffuse = 0;
    Vec3f normal;
    std::uint32_t occluded = 0;
    Vec3f object_origin;
    float pad0 = 0;
    Vec3f object_direction;
    float pad1 = 0;
};
static_assert(sizeof(WorldHit) == 80);

enum class Backend { query, pipeline };

struct Rig {
    const VulkanDevice& device;
    const vulkan::Device& loader;
    std::filesystem::path shaders; // folder of SPIR-V
    bool own_hit_group = false;    // of that folder too, instead of the loader's
};

// instances: whose custom index and hit record are both the index of a record. coverage: with the any-hit
// stage.
std::vector<WorldHit> trace_maps(const Rig& rig, Backend backend,
                                 std::span<const VkAccelerationStructureInstanceKHR> instances,
                                 std::span<const vulkan::ShaderRecord> records,
                                 const vulkan::TraceConstants& constants, bool coverage,
                                 std::span<const WorldRay> rays);

} // namespace spa::test
