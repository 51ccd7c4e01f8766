// SPDX-License-Identifier: Apache-2.0
// The images of a document: read and decoded when a base colour needs them, each once.
#pragma once

#include "gltf_buffers.h"
#include "texture.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace spa::import::gltf {

class Images {
public:
    // Takes the images out of `document`. The references passed check_images.
    Images(Json& document, Buffers& buffers, const Context& context);

    // What the model takes without its textures, before the first of them is asked for.
    void reserve(std::uint64_t bytes) { budget_.spend(bytes); }

    // The index in model.textures of a decoded image. Throws Error for a missing file and for what cannot be
    // decoded.
    std::uint32_t texture(std::size_t image, Model& model);

    // Warns of images that are missing or no pictures, although no base colour needs them.
    void check_unused();

private:
    struct Entry {
        std::string uri; // empty: in a buffer view
        std::size_t view = 0;
        std::string name;
        bool used = false;
    };
    // The first bytes of a file; nothing, with a warning, if they cannot be read.
    std::optional<FileContent> read_unused(const Reference& reference, const std::string& where);

    Buffers& buffers_;
    Context context_;
    std::vector<Entry> entries_;
    std::map<std::string, std::uint32_t> textures_; // by file name or place in the document
    TextureBudget budget_;
};

} // namespace spa::import::gltf
