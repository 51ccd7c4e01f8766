// SPDX-License-Identifier: Apache-2.0
// Maps in the world, for the loader on the device and for the CPU, which answers by the C++ build of the text
// and transforms in double precision.
#pragma once

#include "map_tracers.h"

#include "../../libspa/bake/bake.h"
#include "../../libspa/trace/space.h"
#include "../../libspa/trace/trace_map.h"
#include "../../shaders/spa_method.h"

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

namespace spa::test {

struct Placed {
    std::uint32_t map = 0; // index into LoadedScene::maps
    Affine to_world;
    std::uint32_t flags = 0; // of the record
};

// What a ray hits on the CPU.
struct Expected {
    bool hit = false;
    float t = 0;
    std::uint32_t record = 0, kind = 0;
    Vec3f color, normal;
    float diffuse = 0;
};

class LoadedScene {
public:
    // Takes the samples' parts: several names make one map of several parts.
    void add_map(const std::vector<std::string>& samples, const Grid& grid, std::uint32_t layers);
    void place(const Placed& placed) { placed_.push_back(placed); }
    // Coverage 0 in every other square of `side` texels of the outermost colours.
    void punch_holes(std::uint32_t map, std::uint32_t side);

    void load(const Rig& rig, const vulkan::LoadOptions& options);
    [[nodiscard]] std::span<const VkAccelerationStructureInstanceKHR> instances() const { return instances_; }
    [[nodiscard]] std::span<const vulkan::ShaderRecord> records() const { return records_; }
    [[nodiscard]] std::span<const vulkan::MapObject> objects() const { return objects_; }
    [[nodiscard]] const SphericalMap& map(std::uint32_t index) const { return maps_[index].map; }

    [[nodiscard]] Expected expected(const WorldRay& ray, const vulkan::TraceConstants& constants) const;
    // The same for a ray in the map space of a record; the normal stays there, diffuse is not set.
    [[nodiscard]] Expected in_map(std::uint32_t record, const shader::SpaRay& ray,
                                  const vulkan::TraceConstants& constants) const;
    [[nodiscard]] const trace::MapSpace& space(std::uint32_t record) const { return targets_[record].space; }

private:
    struct Target {
        std::uint32_t image = 0; // index into images_
        trace::MapSpace space;
        std::uint32_t flags = 0;
    };
    struct Baked {
        SphericalMap map;
        std::vector<bake::OwnedMap> owners;
        std::vector<std::vector<std::byte>> colors; // punched
        std::uint32_t first_image = 0;
    };
    std::deque<Baked> maps_;
    std::deque<trace::TraceMap> images_; // of all parts
    std::vector<Placed> placed_;
    std::vector<Target> targets_; // one a record
    std::vector<vulkan::MapObject> objects_;
    std::vector<VkAccelerationStructureInstanceKHR> instances_;
    std::vector<vulkan::ShaderRecord> records_;
};

// Rays from around the origin to around it: of lengths from 1e-3 to 1e3, some along axes, some with limits of
// t.
std::vector<WorldRay> world_rays(std::size_t count, std::uint64_t seed);

} // namespace spa::test
