// SPDX-License-Identifier: Apache-2.0
// The run-time loader: a spherical map on a Direct3D 12 device, ready to be traced beside triangles. The same
// as libspa/vulkan/map_object.h.
//
// Order of operations:
//   1. Create an ID3D12Device5 whose adapter traces rays: D3D12_RAYTRACING_TIER_1_0, for ray queries 1_1.
//   2. Open the file (formats/container/reader.h), and make a MapObject of File::map(). Everything is
//      allocated, and the images are written from the file's mapping straight into staging memory. The file
//      may be closed now.
//   3. record() into a command list of the direct or compute type: a copy, barriers, one bottom-level
//      acceleration structure a part. Execute it.
//   4. When the queue has passed a fence behind it: finish() gives staging and scratch memory back.
//   5. Put instance() of every part into a top-level structure, as often as wanted. Its instances with
//      transforms of their own are what moves; bottom levels are never built again.
//   6a. Ray-tracing pipelines: the library shaders/hlsl/spa.hlsl and its hit group (hit_group.h); a shader
//       record a part: the group's identifier, then the 16 bytes of shader_record().
//       InstanceOptions::hit_record says which is an instance's.
//   6b. Ray queries: a buffer of query_record(), one an instance ID; a raw view of images() for every map
//       (images_view()); #include "spa_ray_query.hlsl" in the shader.
//   7. Destroy the MapObject when no work that the GPU has not ended uses it any more.
//
// Nothing is global; calls on one object are not to overlap. Every failure of Direct3D is an Error and leaves
// nothing behind.
#pragma once

#include "com.h"

#include "../core/affine.h"
#include "../core/spherical_map.h"
#include "../trace/packed_images.h"

#include <cstdint>
#include <vector>

namespace spa::dxr {

// The local root arguments of the hit group, after the identifier of a shader record.
struct ShaderRecord {
    D3D12_GPU_VIRTUAL_ADDRESS image = 0; // of the part's trace image (shaders/spa_map.h)
    std::uint32_t flags = 0; // SPA_CULL_BACK, SPA_CULL_FRONT, SPA_RECORD_COVERAGE (shaders/spa_hit.h)
    std::uint32_t part = 0;  // number of the part in the map
};
static_assert(sizeof(ShaderRecord) == 16);

// What a ray query reads of an instance: an element of a StructuredBuffer<uint4>.
struct QueryRecord {
    std::uint32_t first_word = 0; // of the part's trace image, in images()
    std::uint32_t buffer = 0;     // which images() it is: a number of the application's
    std::uint32_t flags = 0;      // as above
    std::uint32_t part = 0;
};
static_assert(sizeof(QueryRecord) == 16);

struct LoadOptions {
    trace::CompileOptions compile; // layers, and whether with colours and normals
    // Lets rays through where the map stores little coverage: records have SPA_RECORD_COVERAGE, and the
    // geometry is not opaque, so that hits call an any-hit stage (spa_any_hit).
    bool coverage = false;
    // The box of a part is that of its sphere instead of the stored surface: for fan and march, whose nearest
    // samples and test points reach beyond the surface between the samples. The projective trace is faster
    // without.
    bool whole_sphere = false;
};

struct InstanceOptions {
    std::uint32_t id = 0;         // < 2^24; InstanceID(): of the record in a table, for ray queries
    std::uint8_t mask = 0xFF;     // of rays that may see it
    std::uint32_t hit_record = 0; // < 2^24; InstanceContributionToHitGroupIndex
    D3D12_RAYTRACING_INSTANCE_FLAGS flags = D3D12_RAYTRACING_INSTANCE_FLAG_NONE;
};

// In bytes.
struct MemoryUsed {
    std::uint64_t images = 0;     // trace images and boxes
    std::uint64_t structures = 0; // acceleration structures
    std::uint64_t temporary = 0;  // staging and scratch, until finish()
};

class MapObject {
public:
    // Step 2. map: as a reader that has checked it gives it, or a bake; need not outlive the call. The device
    // is one node. Throws Error: unsupported if it does not trace rays, its memory does not suffice, or a
    // part is too large (TraceMap); usage if there is no part; internal if Direct3D fails. O(samples).
    MapObject(ID3D12Device5* device, const SphericalMap& map, const LoadOptions& options = {});

    // Step 3. Once, before finish(). Later commands of the same list may trace against the parts and build
    // structures of them without barriers of their own.
    void record(ID3D12GraphicsCommandList4* commands);
    // Step 4.
    void finish();

    [[nodiscard]] std::uint32_t part_count() const { return std::uint32_t(parts_.size()); }
    // Of a part's bottom-level structure. Here and below part < part_count().
    [[nodiscard]] D3D12_GPU_VIRTUAL_ADDRESS structure(std::uint32_t part) const;
    // flags: of the trace; SPA_RECORD_COVERAGE is added if the map was loaded with coverage.
    [[nodiscard]] ShaderRecord shader_record(std::uint32_t part, std::uint32_t flags = 0) const;
    [[nodiscard]] QueryRecord query_record(std::uint32_t part, std::uint32_t buffer = 0,
                                           std::uint32_t flags = 0) const;
    // A part somewhere in the world: the shader's object space is the part's map space (shaders/README.md),
    // so that t is the world's. object_to_world has an inverse; it may mirror, shear and scale unevenly.
    [[nodiscard]] D3D12_RAYTRACING_INSTANCE_DESC instance(std::uint32_t part, const Affine& object_to_world,
                                                          const InstanceOptions& options = {}) const;

    // The buffer with the trace images of all parts, in the state for shaders that are no pixel shaders
    // behind record(), and in the common state as soon as the list has been executed.
    [[nodiscard]] ID3D12Resource* images() const { return images_.get(); }
    // Of all of it, for CreateShaderResourceView. Devices need not take views of more than 2^27 words.
    [[nodiscard]] D3D12_SHADER_RESOURCE_VIEW_DESC images_view() const;
    [[nodiscard]] const MemoryUsed& memory() const { return memory_; }

private:
    struct LoadedPart {
        trace::PackedPart packed;                 // where in images_
        std::uint64_t structure = 0, scratch = 0; // where in structures_ and scratch_
    };
    void write_images(ID3D12Device5* device, const SphericalMap& map, const trace::PackedImages& packed);
    void create_structures(ID3D12Device5* device);
    [[nodiscard]] D3D12_RAYTRACING_GEOMETRY_DESC box_geometry(const LoadedPart& part) const;
    [[nodiscard]] std::uint32_t record_flags(std::uint32_t flags) const;

    bool coverage_;
    Com<ID3D12Resource> images_, structures_, staging_, scratch_;
    std::vector<LoadedPart> parts_;
    MemoryUsed memory_;
};

} // namespace spa::dxr
