// SPDX-License-Identifier: Apache-2.0
// The trace images of all parts of a map in one buffer, and behind them the boxes that their acceleration
// structures are built from: what the run-time loaders (../vulkan, ../dxr) upload.
#pragma once

#include "trace_map.h"

#include "../core/spherical_map.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace spa::trace {

constexpr std::size_t packed_alignment = 256; // of images: the most that any device asks of a buffer view

// Of a part's surface, in map space; as ray-tracing interfaces take boxes.
struct PackedBox {
    float low[3], high[3];
};

struct PackedPart {
    Part placement;        // without layers: what map_space (space.h) needs
    std::size_t image = 0; // bytes from the buffer's start
    std::size_t words = 0; // of the image
    std::size_t box = 0;   // bytes from the buffer's start
};

class PackedImages {
public:
    // map: at least one part, else Error{usage}; otherwise as TraceMap. whole_sphere: boxes of the parts'
    // spheres, not of their surfaces; latlong maps have these in any case. O(samples).
    PackedImages(const SphericalMap& map, const CompileOptions& options, bool whole_sphere);

    [[nodiscard]] const std::vector<PackedPart>& parts() const { return parts_; }
    [[nodiscard]] std::size_t image_bytes() const { return image_bytes_; } // of all images, padding included
    [[nodiscard]] std::size_t bytes() const { return image_bytes_ + parts_.size() * sizeof(PackedBox); }

    // map: the same. bytes: as many, aligned to words; never read. Colours and normals are copied here and
    // nowhere else: from the views straight to memory that a device reads.
    void write(const SphericalMap& map, std::span<std::byte> bytes) const;

private:
    std::vector<PackedPart> parts_;
    std::vector<TraceMap> without_images_;
    bool images_, whole_sphere_;
    std::size_t image_bytes_ = 0;
};

} // namespace spa::trace
