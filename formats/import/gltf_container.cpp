// SPDX-License-Identifier: Apache-2.0
// glTF 2.0, 4 "GLB File Format Specification".
#include "gltf_container.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace spa::import::gltf {
namespace {

constexpr std::size_t header_bytes = 12;
constexpr std::size_t chunk_header_bytes = 8;
constexpr std::uint32_t json_type = 0x4E4F534A, bin_type = 0x004E4942;

// Deeper than any real document; parsers and destructors recurse.
constexpr int max_nesting = 128;

std::uint32_t read_u32(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8U | std::to_integer<std::uint32_t>(bytes[offset + i]);
    return value;
}

std::string_view text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// A value takes up to a hundred bytes in the parser's tree, some thirty times its text.
constexpr std::size_t max_values = std::size_t{1} << 24U;

// Before the parser sees the text.
void check_extent(std::string_view json, const Context& context) {
    int depth = 0;
    std::size_t values = 1;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (c == '"') {
            // Base64 makes strings of many megabytes: memchr skips them.
            for (;;) {
                const std::size_t quote = json.find('"', i + 1);
                if (quote == std::string_view::npos) return; // unterminated: the parser says so
                std::size_t backslashes = 0;
                while (json[quote - 1 - backslashes] == '\\') ++backslashes;
                i = quote;
                if (backslashes % 2 == 0) break;
            }
        } else if (c == ',') {
            ++values;
        } else if (c == '{' || c == '[') {
            ++values;
            if (++depth > max_nesting)
                fail(context, "",
                     "the JSON is nested deeper than " + std::to_string(max_nesting) + " levels");
        } else if (c == '}' || c == ']') {
            --depth;
        }
        if (values > max_values)
            fail(context, "", "the JSON has more than " + std::to_string(max_values) + " values");
    }
}

Container split_glb(std::span<const std::byte> file, const Context& context) {
    if (file.size() < header_bytes) fail(context, "GLB header", "the file ends within it");
    const std::uint32_t version = read_u32(file, 4);
    if (version != 2)
        fail(context, "GLB header", "version is " + std::to_string(version) + ", only 2 is read");
    const std::uint32_t length = read_u32(file, 8);
    if (length < header_bytes + chunk_header_bytes)
        fail(context, "GLB header", "length is " + std::to_string(length) + ", too small for a JSON chunk");
    if (length > file.size())
        fail(context, "GLB header",
             "length is " + std::to_string(length) + ", but the file has only " +
                 std::to_string(file.size()) + " bytes: it is cut off");
    if (length < file.size())
        warn(context, "GLB header",
             std::to_string(file.size() - length) + " bytes after the end are ignored");

    Container container;
    container.binary = true;
    bool has_json = false;
    const std::span<const std::byte> body = file.first(length);
    std::size_t at_byte = header_bytes;
    for (std::size_t chunk = 0; at_byte < body.size(); ++chunk) {
        const std::string where = "GLB " + at("chunk", chunk);
        if (body.size() - at_byte < chunk_header_bytes)
            fail(context, where, "the file ends within its header");
        const std::uint32_t size = read_u32(body, at_byte);
        const std::uint32_t type = read_u32(body, at_byte + 4);
        at_byte += chunk_header_bytes;
        if (size > body.size() - at_byte)
            fail(context, where,
                 "it claims " + std::to_string(size) + " bytes, but only " +
                     std::to_string(body.size() - at_byte) + " are left: the file is cut off");
        const std::span<const std::byte> content = body.subspan(at_byte, size);
        at_byte += size;
        if (chunk == 0 && type != json_type) fail(context, where, "the first chunk is not JSON");
        if (type == json_type) {
            if (has_json) fail(context, where, "a second JSON chunk");
            has_json = true;
            container.json = text_of(content);
        } else if (type == bin_type) {
            if (container.bin) fail(context, where, "a second BIN chunk");
            if (chunk != 1) warn(context, where, "the BIN chunk is not the second chunk");
            container.bin = content;
        }
        if (size % 4 != 0) warn(context, where, "its length is not a multiple of 4");
    }
    if (!has_json) fail(context, "GLB", "it has no JSON chunk");
    return container;
}

} // namespace

Container split_container(std::span<const std::byte> file, const Context& context) {
    Container container;
    if (file.size() >= 4 && text_of(file.first(4)) == "glTF") {
        container = split_glb(file, context);
    } else {
        container.json = text_of(file);
        const std::size_t first = container.json.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
        if (first == std::string_view::npos || container.json[first] != '{')
            fail(context, "",
                 file.empty() ? "the file is empty"
                              : "it starts neither with the GLB magic 'glTF' nor with a JSON object");
        if (container.json.substr(0, 3) == "\xEF\xBB\xBF") {
            warn(context, "JSON", "it starts with a byte order mark, which glTF does not allow");
            container.json.remove_prefix(3);
        }
    }
    check_extent(container.json, context);
    return container;
}

} // namespace spa::import::gltf
