// SPDX-License-Identifier: Apache-2.0
// The bytes behind buffers and buffer views, read once and never copied: a GLB's BIN chunk stays where the
// file was read to.
#pragma once

#include "gltf_container.h"
#include "gltf_schema.h"

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace spa::import::gltf {

class Buffers {
public:
    // Reads every buffer: the BIN chunk, files in the asset's folder (recorded in the report) and "data:"
    // URIs, whose text is then released from `document`. Throws Error for what is missing, outside the
    // folder or too short. `document` passed check_buffer_views; `container` outlives the buffers.
    Buffers(Json& document, const Container& container, const Context& context);

    // The bytes of a buffer view, decompressed. Throws Error if the buffer has no data or is damaged.
    std::span<const std::byte> view(std::size_t index);

    // Counts compressed bytes that are about to be decoded. Views that share their source would multiply what
    // a file can make us decode: throws Error once more is decoded than there is.
    void claim_compressed(std::size_t bytes, const std::string& where);

    // The stride that the view sets, 0 if none.
    [[nodiscard]] std::size_t stride(std::size_t index) const;

private:
    struct View {
        std::size_t buffer = 0, offset = 0, length = 0, stride = 0;
        Json meshopt; // the extension's object; null if there is none
    };

    Context context_;
    std::map<std::string, FileContent> files_;     // by resolved name
    std::vector<std::vector<std::byte>> embedded_; // of "data:" URIs
    std::vector<std::optional<std::span<const std::byte>>> buffers_;
    std::vector<View> views_;
    std::map<std::size_t, std::vector<std::byte>> decoded_; // meshopt views
    std::size_t compressed_bytes_ = 0;                      // claimed so far
    std::uint64_t decoded_bytes_ = 0;                       // of meshopt views

    [[nodiscard]] std::span<const std::byte> range(std::size_t buffer, std::size_t offset, std::size_t length,
                                                   const std::string& where) const;
};

} // namespace spa::import::gltf
