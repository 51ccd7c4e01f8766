// SPDX-License-Identifier: Apache-2.0
// A part made ready for tracing: the trace image of ../../shaders/spa_map.h, the same words for the CPU
// tracers, for a GPU buffer and for a web page's texture. What surface it stands for: ../../docs/tracing.md,
// "The stored surface".
#pragma once

#include "../../shaders/spa_map.h"

#include "../core/spherical_map.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace spa::trace {

struct CompileOptions {
    std::uint32_t layers = 0; // as many of the part's layers at most; 0: all
    bool images = true;       // with colours and normals, which spa_shade reads
};

class TraceMap {
public:
    // O(samples). part: as a reader that has checked it gives it, or a bake. Throws Error{unsupported} for a
    // map with more than 2^14 cells a side or 1024 layers, or whose image would have 2^32 words.
    explicit TraceMap(const Part& part, const CompileOptions& options = {});

    // The trace image; position independent.
    [[nodiscard]] std::span<const std::uint32_t> words() const { return words_; }
    // Opened for the text; valid while this object lives and is not moved from.
    [[nodiscard]] const shader::SpaMap& map() const { return map_; }

    // The same image with the colours and normals of `part`, for one compiled without them: written to memory
    // that a device reads, straight from the part's views. size_with_images: words. Nothing is read of
    // `words`.
    [[nodiscard]] std::size_t size_with_images(const Part& part) const;
    void write_with_images(const Part& part, std::span<std::uint32_t> words) const;

    // Bytes that a trace touches at most: nodes, cores, samples, cells, prisms. Without images and without
    // what fan and march read.
    [[nodiscard]] std::size_t projective_bytes() const;
    // Share of the mixed triangles that are divided along tangent planes, for want of folds or because they
    // make no sense there; 0 if none is mixed.
    [[nodiscard]] double tangent_share() const { return tangent_share_; }
    // Bytes of the depths that fan and march read.
    [[nodiscard]] std::size_t depth_bytes() const;

private:
    [[nodiscard]] std::size_t part_of_image(std::uint32_t to, std::uint32_t from) const;

    std::vector<std::uint32_t> words_;
    shader::SpaMap map_;
    double tangent_share_ = 0;
};

} // namespace spa::trace
