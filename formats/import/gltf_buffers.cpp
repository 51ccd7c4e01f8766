// SPDX-License-Identifier: Apache-2.0
#include "gltf_buffers.h"

#include "data_uri.h"
#include "gltf_check.h"
#include "gltf_meshopt.h"

namespace spa::import::gltf {

Buffers::Buffers(Json& document, const Container& container, const Context& context) : context_(context) {
    const std::size_t count = member_of(document, "buffers").size();
    buffers_.resize(count);
    embedded_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        Json& buffer = document["buffers"][i];
        const std::string where = at("buffers", i);
        const std::uint64_t length = integer_of(buffer, "byteLength");
        std::span<const std::byte> bytes;
        if (buffer.contains("uri")) {
            const std::string& uri = buffer["uri"].get_ref<const std::string&>();
            if (is_data_uri(uri)) {
                std::optional<std::vector<std::byte>> decoded = decode_data_uri(uri);
                if (!decoded) fail(context, where + ".uri", "is a malformed data: URI");
                embedded_[i] = std::move(*decoded);
                bytes = embedded_[i];
                buffer.erase("uri");
            } else {
                const Reference reference = resolve_reference(context.asset.path, uri, Encoding::uri);
                auto found = files_.find(reference.name);
                if (found == files_.end()) {
                    std::optional<FileContent> content = context.references.read(reference);
                    if (!content)
                        fail(context, where + ".uri", "the file '" + reference.name + "' does not exist");
                    found = files_.emplace(reference.name, std::move(*content)).first;
                }
                bytes = found->second.bytes;
            }
        } else if (i == 0 && container.bin) {
            bytes = *container.bin;
        } else {
            const bool fallback = member_of(buffer, "extensions").contains("EXT_meshopt_compression");
            if (!fallback)
                warn(context, where,
                     container.binary && i == 0 ? "has no uri, and the GLB has no BIN chunk"
                                                : "has no uri, so its content is unknown");
            continue;
        }
        if (bytes.size() < length)
            fail(context, where + ".byteLength",
                 "is " + std::to_string(length) + ", but there are only " + std::to_string(bytes.size()) +
                     " bytes: the data is cut off");
        buffers_[i] = bytes.first(length);
    }

    for (const Json& view : member_of(document, "bufferViews")) {
        View out{integer_of(view, "buffer"), integer_of(view, "byteOffset"), integer_of(view, "byteLength"),
                 integer_of(view, "byteStride"), nullptr};
        const Json& extensions = member_of(view, "extensions");
        if (extensions.contains("EXT_meshopt_compression"))
            out.meshopt = extensions["EXT_meshopt_compression"];
        views_.push_back(std::move(out));
    }
}

std::span<const std::byte> Buffers::range(std::size_t buffer, std::size_t offset, std::size_t length,
                                          const std::string& where) const {
    if (!buffers_[buffer]) fail(context_, where, "needs " + at("buffers", buffer) + ", which has no data");
    return buffers_[buffer]->subspan(offset, length);
}

std::span<const std::byte> Buffers::view(std::size_t index) {
    const View& view = views_[index];
    const std::string where = at("bufferViews", index);
    if (view.meshopt.is_null()) return range(view.buffer, view.offset, view.length, where);

    const auto found = decoded_.find(index);
    if (found != decoded_.end()) return found->second;
    claim_compressed(integer_of(view.meshopt, "byteLength"), where);
    decoded_bytes_ += view.length;
    if (decoded_bytes_ > context_.limits.model_bytes)
        fail(context_, where,
             "the compressed buffer views take more than the limit of " +
                 std::to_string(context_.limits.model_bytes) + " bytes");
    const MeshoptView settings{integer_of(view.meshopt, "count"), integer_of(view.meshopt, "byteStride"),
                               view.meshopt["mode"], view.meshopt.value("filter", "NONE")};
    std::vector<std::byte> bytes = decode_meshopt(
        settings, range(integer_of(view.meshopt, "buffer"), integer_of(view.meshopt, "byteOffset"),
                        integer_of(view.meshopt, "byteLength"), where));
    if (bytes.size() != view.length)
        fail(context_, where + ".extensions.EXT_meshopt_compression", "the compressed data is damaged");
    return decoded_.emplace(index, std::move(bytes)).first->second;
}

void Buffers::claim_compressed(std::size_t bytes, const std::string& where) {
    std::size_t available = 0;
    for (const auto& buffer : buffers_) available += buffer ? buffer->size() : 0;
    compressed_bytes_ += bytes;
    if (compressed_bytes_ > available)
        fail(context_, where, "the compressed parts together are larger than the buffers");
}

std::size_t Buffers::stride(std::size_t index) const { return views_[index].stride; }

} // namespace spa::import::gltf
