// SPDX-License-Identifier: Apache-2.0
#include "gltf_images.h"

#include "data_uri.h"
#include "gltf_check.h"
#include "image_header.h"

#include <set>

namespace spa::import::gltf {
namespace {

constexpr std::size_t head_bytes = 65536; // of an image that is not used

// The first bytes of what a "data:" URI holds. Base64 makes 3 bytes of 4 characters.
std::optional<std::vector<std::byte>> decode_head(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) return std::nullopt;
    return decode_data_uri(uri.substr(0, comma + 1 + head_bytes / 3 * 4));
}

} // namespace

Images::Images(Json& document, Buffers& buffers, const Context& context)
    : buffers_(buffers), context_(context), budget_(context.limits) {
    const auto found = document.find("images");
    if (found == document.end()) return;
    for (Json& image : *found) {
        Entry entry;
        if (image.contains("uri")) entry.uri = std::move(image["uri"].get_ref<std::string&>());
        entry.view = integer_of(image, "bufferView");
        entry.name = image.value("name", "");
        entries_.push_back(std::move(entry));
    }
    document.erase(found);
}

std::uint32_t Images::texture(std::size_t image, Model& model) {
    Entry& entry = entries_[image];
    entry.used = true;
    const std::string where = at("images", image);
    const bool external = !entry.uri.empty() && !is_data_uri(entry.uri);
    Reference reference;
    if (external) reference = resolve_reference(context_.asset.path, entry.uri, Encoding::uri);
    const std::string name =
        external ? reference.name : where + (entry.name.empty() ? "" : " '" + entry.name + "'");
    const std::string key = entry.uri.empty() ? at("bufferViews", entry.view) : name;
    const auto found = textures_.find(key);
    if (found != textures_.end()) return found->second;

    std::vector<std::byte> storage;
    std::span<const std::byte> bytes;
    if (external) {
        std::optional<FileContent> content = context_.references.read(reference);
        if (!content) fail(context_, where + ".uri", "the file '" + name + "' does not exist");
        storage = std::move(content->bytes);
        bytes = storage;
    } else if (!entry.uri.empty()) {
        std::optional<std::vector<std::byte>> decoded = decode_data_uri(entry.uri);
        if (!decoded) fail(context_, where + ".uri", "is a malformed data: URI");
        storage = std::move(*decoded);
        bytes = storage;
    } else {
        bytes = buffers_.view(entry.view);
        buffers_.claim_compressed(bytes.size(), where);
    }
    try {
        model.textures.push_back(budget_.decode(bytes, name));
    } catch (const Error& error) {
        throw Error(error.code(),
                    context_.asset.path.string() + ": " + (external ? where + ": " : "") + error.what());
    }
    const auto index = static_cast<std::uint32_t>(model.textures.size() - 1);
    textures_.emplace(key, index);
    return index;
}

std::optional<FileContent> Images::read_unused(const Reference& reference, const std::string& where) {
    try {
        std::optional<FileContent> content = context_.references.read_head(reference, head_bytes);
        if (!content) {
            context_.references.add_missing(reference.name);
            warn(context_, where, "the file '" + reference.name + "' does not exist");
        }
        return content;
    } catch (const Error& error) {
        if (error.code() != ExitCode::input_output) throw;
        warn(context_, where, error.what());
        return std::nullopt;
    }
}

void Images::check_unused() {
    std::set<std::string> checked; // files: many images may share one
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        const Entry& entry = entries_[i];
        if (entry.used ||
            (!is_data_uri(entry.uri) && !entry.uri.empty() && !checked.insert(entry.uri).second))
            continue;
        const std::string where = at("images", i);
        std::vector<std::byte> storage;
        std::span<const std::byte> bytes;
        if (entry.uri.empty()) {
            bytes = buffers_.view(entry.view);
        } else if (is_data_uri(entry.uri)) {
            std::optional<std::vector<std::byte>> decoded = decode_head(entry.uri);
            if (!decoded) {
                warn(context_, where + ".uri", "is a malformed data: URI");
                continue;
            }
            storage = std::move(*decoded);
            bytes = storage;
        } else {
            const Reference reference = resolve_reference(context_.asset.path, entry.uri, Encoding::uri);
            std::optional<FileContent> content = read_unused(reference, where + ".uri");
            if (!content) continue;
            storage = std::move(content->bytes);
            bytes = storage;
        }
        const ImageKind kind = image_kind(bytes);
        if (kind == ImageKind::unknown) warn(context_, where, "is not an image of a known format");
        // In a longer file the header may come after what was read.
        const bool has_header =
            kind == ImageKind::png || (kind == ImageKind::jpeg && bytes.size() < head_bytes / 2);
        if (has_header && read_image_header(bytes, kind).width == 0)
            warn(context_, where, "is a damaged image");
    }
}

} // namespace spa::import::gltf
