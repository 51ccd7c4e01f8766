// SPDX-License-Identifier: Apache-2.0
// Several maps in one world, each as often as wanted and anywhere.
//
// Every ray is tested against the bounding sphere of every instance: time is linear in the instances, which
// suits the parts of one object. For many instances put the scene into Embree's hierarchy
// (embree_geometry.h), or one instance into yours with space.h.
#pragma once

#include "ray.h"
#include "shade.h"
#include "space.h"
#include "trace_map.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace spa::trace {

class Scene {
public:
    // Puts a part into the world and returns its number: 0, 1, 2, ... map: of this part, octahedral; it
    // outlives the scene. Throws Error{unsupported} for a latlong map, Error{usage} for a transform without
    // inverse or with numbers that are not finite.
    std::uint32_t add(const TraceMap& map, const Part& part, const Affine& object_to_world = {});

    // Puts an instance elsewhere: nothing is compiled or built again. Not while rays are traced. Throws as
    // add, and leaves it where it is then. O(1).
    void move(std::uint32_t instance, const Affine& object_to_world);

    [[nodiscard]] std::uint32_t size() const { return std::uint32_t(instances_.size()); }
    [[nodiscard]] const TraceMap& map(std::uint32_t instance) const { return *instances_[instance].map; }
    [[nodiscard]] const MapSpace& space(std::uint32_t instance) const { return instances_[instance].space; }
    // A sphere around it, in the world.
    [[nodiscard]] double radius(std::uint32_t instance) const { return instances_[instance].radius; }

    // What follows may be called from several threads at once. Rays, t and normals are those of the world;
    // flags: TraceFlags. No call allocates but those for many rays; none throws std::exception but
    // std::bad_alloc.

    // The closest hit of all instances; of equally close ones that of the lowest number. hit.instance says
    // which. Returns hit.valid().
    bool closest_hit(const Ray& ray, std::uint32_t flags, Hit& hit) const;
    // Whether anything is hit.
    [[nodiscard]] bool occluded(const Ray& ray, std::uint32_t flags) const;

    // Many rays at once, on the threads of the caller's TBB arena and by SIMD: the same answers as above to
    // the bit. hits.size() = blocked.size() = rays.size(); blocked[i] = 1 where ray i hits something, else 0.
    // Memory: about 150 KiB a thread.
    void closest_hits(std::span<const Ray> rays, std::uint32_t flags, std::span<Hit> hits) const;
    void occluded(std::span<const Ray> rays, std::uint32_t flags, std::span<std::uint8_t> blocked) const;

    // One ray against one instance: closest_hit, as if it were alone.
    bool instance_hit(std::uint32_t instance, const Ray& ray, std::uint32_t flags, Hit& hit) const;

    // Stored colour and normal at a hit of this scene; the normal is one of the world.
    [[nodiscard]] Shade shade(const Hit& hit) const;

private:
    struct Instance {
        const TraceMap* map = nullptr;
        MapSpace space;
        double radius = 0;
    };
    struct Block;

    // At object_to_world. Throws as add.
    static void place(Instance& instance, const Part& part, const Affine& object_to_world);
    static bool may_hit(const Instance& instance, const Ray& ray);
    template <class Result, class Trace>
    static void trace_blocks(std::span<const Ray> rays, std::span<Result> results, Trace trace_block);
    void closest_in_block(std::span<const Ray> rays, std::uint32_t flags, std::span<Hit> hits,
                          Block& block) const;
    void occluded_in_block(std::span<const Ray> rays, std::uint32_t flags, std::span<std::uint8_t> blocked,
                           Block& block) const;

    std::vector<Instance> instances_;
    std::vector<Part> parts_; // of the instances, without layers: what map_space needs
};

} // namespace spa::trace
