// SPDX-License-Identifier: Apache-2.0
// Buffer views, accessors and images. All sums are of numbers below 2^53, so 64 bits never overflow;
// products are checked by division.
#include "gltf_check.h"

#include <array>

namespace spa::import::gltf {
namespace {

std::string bytes_text(std::uint64_t count) { return std::to_string(count) + " bytes"; }

void check_range(const Context& context, const std::string& where, std::uint64_t offset, std::uint64_t length,
                 const std::string& container, std::uint64_t size) {
    if (offset <= size && length <= size - offset) return;
    fail(context, where,
         "needs bytes " + std::to_string(offset) + " to " + std::to_string(offset + length) + " of " +
             container + ", which has " + bytes_text(size));
}

// The lower bounds are those of the codecs: an encoded vertex takes at least 2 bits for each 16 bytes
// of a column, an encoded triangle or index a byte. So a decoded view is at most 64 times its source.
void check_meshopt(const Json& document, const Json& view, const Json& extension, const std::string& where,
                   const Context& context) {
    const std::uint64_t source = integer_of(extension, "buffer");
    const std::uint64_t length = integer_of(extension, "byteLength");
    check_range(context, where, integer_of(extension, "byteOffset"), length, at("buffers", source),
                integer_of(document["buffers"][source], "byteLength"));
    const std::uint64_t stride = integer_of(extension, "byteStride"), count = integer_of(extension, "count");
    const std::string mode = extension["mode"], filter = extension.value("filter", "NONE");
    const bool attributes = mode == "ATTRIBUTES";
    if (attributes ? (stride == 0 || stride % 4 != 0 || stride > 256) : (stride != 2 && stride != 4))
        fail(context, where + ".byteStride", "is " + std::to_string(stride) + ", not valid for mode " + mode);
    if (filter == "OCTAHEDRAL" && stride != 4 && stride != 8)
        fail(context, where + ".byteStride", "must be 4 or 8 for the filter OCTAHEDRAL");
    if (filter == "QUATERNION" && stride != 8)
        fail(context, where + ".byteStride", "must be 8 for the filter QUATERNION");
    if (filter != "NONE" && !attributes) fail(context, where + ".filter", "is only for mode ATTRIBUTES");
    if (mode == "TRIANGLES" && count % 3 != 0) fail(context, where + ".count", "is not a multiple of 3");
    const std::uint64_t least = attributes ? stride * (count / 64) : mode == "TRIANGLES" ? count / 3 : count;
    if (least > length)
        fail(context, where + ".count",
             "claims " + std::to_string(count) + " elements, which " + bytes_text(length) + " cannot hold");
    if (integer_of(view, "byteLength") != stride * count)
        fail(context, where,
             "decodes to " + bytes_text(stride * count) + ", but the buffer view has " +
                 bytes_text(integer_of(view, "byteLength")));
}

void check_sparse(const Json& document, const Json& accessor, std::size_t element, const std::string& where,
                  const Context& context) {
    const Json& sparse = accessor["sparse"];
    const std::uint64_t count = integer_of(sparse, "count");
    if (count == 0 || count > integer_of(accessor, "count"))
        fail(context, where + ".count",
             "is " + std::to_string(count) + ", the accessor has " +
                 std::to_string(integer_of(accessor, "count")) + " elements");
    const auto check_part = [&](const char* name, std::size_t size) {
        const Json& part = sparse[name];
        const std::uint64_t view = integer_of(part, "bufferView");
        const std::string place = where + "." + name;
        if (document["bufferViews"][view].contains("byteStride"))
            fail(context, place, "uses " + at("bufferViews", view) + ", which must not have a byteStride");
        check_range(context, place, integer_of(part, "byteOffset"), count * size, at("bufferViews", view),
                    integer_of(document["bufferViews"][view], "byteLength"));
    };
    check_part("indices", component_size(integer_of(sparse["indices"], "componentType")));
    check_part("values", element);
}

void check_accessor(const Json& document, std::size_t index, const Context& context) {
    const Json& accessor = document["accessors"][index];
    const std::string where = at("accessors", index);
    const std::uint64_t type = integer_of(accessor, "componentType"), count = integer_of(accessor, "count");
    const std::size_t component = component_size(type);
    const std::size_t components = component_count(accessor["type"].get_ref<const std::string&>());
    const std::size_t element = component * components;
    const bool float_or_int = type == 5126 || type == 5125;
    if (count == 0) fail(context, where + ".count", "is 0");
    if (accessor.value("normalized", false) && float_or_int)
        warn(context, where + ".normalized",
             "is true for component type " + std::to_string(type) + ", which cannot be normalized");
    for (const char* bound : {"min", "max"})
        if (accessor.contains(bound) && accessor[bound].size() != components)
            fail(context, where + "." + bound,
                 "has " + std::to_string(accessor[bound].size()) + " elements, the accessor's have " +
                     std::to_string(components));
    if (accessor.contains("sparse")) check_sparse(document, accessor, element, where + ".sparse", context);
    if (!accessor.contains("bufferView")) return;

    const std::uint64_t view_index = integer_of(accessor, "bufferView");
    const std::uint64_t offset = integer_of(accessor, "byteOffset");
    const Json& view = document["bufferViews"][view_index];
    const std::uint64_t stride = integer_of(view, "byteStride", element);
    if (stride < element)
        fail(context, where,
             at("bufferViews", view_index) + ".byteStride is " + std::to_string(stride) +
                 ", smaller than an element of " + bytes_text(element));
    if ((offset + integer_of(view, "byteOffset")) % component != 0 || offset % component != 0 ||
        stride % component != 0)
        warn(context, where, "is not aligned to its component size of " + bytes_text(component));
    const std::uint64_t size = integer_of(view, "byteLength");
    const bool too_many = (count - 1) > size / stride; // so that the product below cannot overflow
    check_range(context, where, offset, too_many ? size + 1 : (count - 1) * stride + element,
                at("bufferViews", view_index), size);
}

} // namespace

std::size_t component_count(std::string_view type) {
    if (type == "SCALAR") return 1;
    const auto digit = static_cast<std::size_t>(type.back() - '0');
    return type.substr(0, 3) == "MAT" ? digit * digit : digit;
}

std::uint64_t integer_of(const Json& object, const char* key, std::uint64_t missing) {
    const auto found = object.find(key);
    return found == object.end() ? missing : found->get<std::uint64_t>();
}

const Json& member_of(const Json& object, const char* key) {
    static const Json empty = Json::array();
    const auto found = object.find(key);
    return found == object.end() ? empty : *found;
}

void check_buffer_views(const Json& document, const Context& context) {
    const Json& buffers = member_of(document, "buffers");
    for (std::size_t i = 0; i < buffers.size(); ++i)
        if (integer_of(buffers[i], "byteLength") == 0)
            fail(context, at("buffers", i) + ".byteLength", "is 0");

    const Json& views = member_of(document, "bufferViews");
    for (std::size_t i = 0; i < views.size(); ++i) {
        const Json& view = views[i];
        const std::string where = at("bufferViews", i);
        const std::uint64_t length = integer_of(view, "byteLength"), buffer = integer_of(view, "buffer");
        if (length == 0) fail(context, where + ".byteLength", "is 0");
        check_range(context, where, integer_of(view, "byteOffset"), length, at("buffers", buffer),
                    integer_of(buffers[buffer], "byteLength"));
        if (view.contains("byteStride")) {
            const std::uint64_t stride = integer_of(view, "byteStride");
            if (stride < 4 || stride > 252 || stride % 4 != 0)
                fail(context, where + ".byteStride",
                     "is " + std::to_string(stride) + ", not a multiple of 4 from 4 to 252");
            if (stride > length)
                warn(context, where + ".byteStride",
                     "is greater than the byteLength of " + std::to_string(length));
        }
        const Json& extensions = member_of(view, "extensions");
        if (extensions.contains("EXT_meshopt_compression"))
            check_meshopt(document, view, extensions["EXT_meshopt_compression"],
                          where + ".extensions.EXT_meshopt_compression", context);
    }
}

void check_accessors(const Json& document, const Context& context) {
    for (std::size_t i = 0; i < member_of(document, "accessors").size(); ++i)
        check_accessor(document, i, context);
}

void check_images(const Json& document, const Context& context) {
    const Json& images = member_of(document, "images");
    for (std::size_t i = 0; i < images.size(); ++i) {
        const std::string where = at("images", i);
        const bool uri = images[i].contains("uri"), view = images[i].contains("bufferView");
        if (uri == view)
            fail(context, where, uri ? "has both a uri and a bufferView" : "has no uri and no bufferView");
        if (view && !images[i].contains("mimeType")) warn(context, where, "has a bufferView but no mimeType");
        if (uri && images[i]["uri"].get_ref<const std::string&>().rfind("data:", 0) != 0)
            (void)resolve_reference(context.asset.path, images[i]["uri"].get_ref<const std::string&>(),
                                    Encoding::uri);
    }
}

} // namespace spa::import::gltf
