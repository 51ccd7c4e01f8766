// SPDX-License-Identifier: Apache-2.0
#include "gltf_schema.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace spa::import::gltf {
namespace {

enum class Kind {
    object,     // `of`: its schema; empty: any object
    dictionary, // an object whose members are all indices into the root array `of`
    string,     // `of`: the allowed values, separated by blanks; empty: any
    boolean,
    number,
    integer, // not negative; `of`: the allowed values, separated by blanks; empty: any up to `maximum`
    index,   // into the root array `of`
};

enum class Occurs { optional, required };

struct Items {
    std::size_t fewest = 0, most = 0; // most 0: not an array
};
constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();
constexpr Items single{}, some{1, any_number}, any_items{0, any_number};

struct Property {
    std::string_view name;
    Kind kind;
    std::string_view of = {};
    Occurs occurs = Occurs::optional;
    Items items = single;
    double maximum = 9007199254740992.0; // 2^53: integers above are not exact in JSON
};

struct Schema {
    std::string_view name;
    std::span<const Property> properties;
};

constexpr Occurs required = Occurs::required, optional = Occurs::optional;
constexpr double int_max = 2147483647.0;

constexpr Property root[] = {
    {"asset", Kind::object, "asset", required},
    {"extensionsUsed", Kind::string, "", optional, some},
    {"extensionsRequired", Kind::string, "", optional, some},
    {"buffers", Kind::object, "buffer", optional, some},
    {"bufferViews", Kind::object, "bufferView", optional, some},
    {"accessors", Kind::object, "accessor", optional, some},
    {"images", Kind::object, "image", optional, some},
    {"samplers", Kind::object, "sampler", optional, some},
    {"textures", Kind::object, "texture", optional, some},
    {"materials", Kind::object, "material", optional, some},
    {"meshes", Kind::object, "mesh", optional, some},
    {"skins", Kind::object, "skin", optional, some},
    {"cameras", Kind::object, "camera", optional, some},
    {"nodes", Kind::object, "node", optional, some},
    {"scenes", Kind::object, "scene", optional, some},
    {"scene", Kind::index, "scenes"},
    {"animations", Kind::object, "animation", optional, some},
};
constexpr Property asset[] = {
    {"version", Kind::string, "", required},
    {"minVersion", Kind::string},
    {"generator", Kind::string},
    {"copyright", Kind::string},
};
constexpr Property buffer[] = {
    {"byteLength", Kind::integer, "", required},
    {"uri", Kind::string},
    {"extensions", Kind::object, "buffer.extensions"},
};
constexpr Property buffer_extensions[] = {{"EXT_meshopt_compression", Kind::object, "meshopt buffer"}};
constexpr Property meshopt_buffer[] = {{"fallback", Kind::boolean}};
constexpr Property buffer_view[] = {
    {"buffer", Kind::index, "buffers", required}, {"byteOffset", Kind::integer},
    {"byteLength", Kind::integer, "", required},  {"byteStride", Kind::integer},
    {"target", Kind::integer, "34962 34963"},     {"extensions", Kind::object, "bufferView.extensions"},
};
constexpr Property buffer_view_extensions[] = {{"EXT_meshopt_compression", Kind::object, "meshopt view"}};
constexpr Property meshopt_view[] = {
    {"buffer", Kind::index, "buffers", required},
    {"byteOffset", Kind::integer},
    {"byteLength", Kind::integer, "", required},
    {"byteStride", Kind::integer, "", required},
    {"count", Kind::integer, "", required},
    {"mode", Kind::string, "ATTRIBUTES TRIANGLES INDICES", required},
    {"filter", Kind::string, "NONE OCTAHEDRAL QUATERNION EXPONENTIAL"},
};
constexpr std::string_view component_types = "5120 5121 5122 5123 5125 5126";
constexpr Property accessor[] = {
    {"bufferView", Kind::index, "bufferViews"},
    {"byteOffset", Kind::integer},
    {"componentType", Kind::integer, component_types, required},
    {"count", Kind::integer, "", required},
    {"type", Kind::string, "SCALAR VEC2 VEC3 VEC4 MAT2 MAT3 MAT4", required},
    {"normalized", Kind::boolean},
    {"min", Kind::number, "", optional, {1, 16}},
    {"max", Kind::number, "", optional, {1, 16}},
    {"sparse", Kind::object, "sparse"},
};
constexpr Property sparse[] = {
    {"count", Kind::integer, "", required, single, int_max},
    {"indices", Kind::object, "sparse.indices", required},
    {"values", Kind::object, "sparse.values", required},
};
constexpr Property sparse_indices[] = {
    {"bufferView", Kind::index, "bufferViews", required},
    {"byteOffset", Kind::integer, "", optional, single, int_max},
    {"componentType", Kind::integer, "5121 5123 5125", required},
};
constexpr Property sparse_values[] = {
    {"bufferView", Kind::index, "bufferViews", required},
    {"byteOffset", Kind::integer, "", optional, single, int_max},
};
constexpr Property image[] = {
    {"uri", Kind::string},
    {"mimeType", Kind::string},
    {"bufferView", Kind::index, "bufferViews"},
};
constexpr Property sampler[] = {
    {"magFilter", Kind::integer, "9728 9729"},
    {"minFilter", Kind::integer, "9728 9729 9984 9985 9986 9987"},
    {"wrapS", Kind::integer, "33071 33648 10497"},
    {"wrapT", Kind::integer, "33071 33648 10497"},
};
constexpr Property texture[] = {
    {"sampler", Kind::index, "samplers"},
    {"source", Kind::index, "images"},
    {"extensions", Kind::object, "texture.extensions"},
};
constexpr Property texture_extensions[] = {
    {"EXT_texture_webp", Kind::object, "texture source"},
    {"KHR_texture_basisu", Kind::object, "texture source"},
    {"MSFT_texture_dds", Kind::object, "texture source"},
};
constexpr Property texture_source[] = {{"source", Kind::index, "images"}};
constexpr Property texture_info[] = {
    {"index", Kind::index, "textures", required},
    {"texCoord", Kind::integer, "", optional, single, int_max},
    {"scale", Kind::number},    // normalTexture
    {"strength", Kind::number}, // occlusionTexture
    {"extensions", Kind::object, "textureInfo.extensions"},
};
constexpr Property texture_info_extensions[] = {{"KHR_texture_transform", Kind::object, "textureTransform"}};
constexpr Property texture_transform[] = {
    {"offset", Kind::number, "", optional, {2, 2}},
    {"rotation", Kind::number},
    {"scale", Kind::number, "", optional, {2, 2}},
    {"texCoord", Kind::integer, "", optional, single, int_max},
};
constexpr Property material[] = {
    {"pbrMetallicRoughness", Kind::object, "pbrMetallicRoughness"},
    {"normalTexture", Kind::object, "textureInfo"},
    {"occlusionTexture", Kind::object, "textureInfo"},
    {"emissiveTexture", Kind::object, "textureInfo"},
    {"emissiveFactor", Kind::number, "", optional, {3, 3}},
    {"alphaMode", Kind::string, "OPAQUE MASK BLEND"},
    {"alphaCutoff", Kind::number},
    {"doubleSided", Kind::boolean},
    {"extensions", Kind::object, "material.extensions"},
};
constexpr Property pbr_metallic_roughness[] = {
    {"baseColorFactor", Kind::number, "", optional, {4, 4}},
    {"baseColorTexture", Kind::object, "textureInfo"},
    {"metallicFactor", Kind::number},
    {"roughnessFactor", Kind::number},
    {"metallicRoughnessTexture", Kind::object, "textureInfo"},
};
constexpr Property material_extensions[] = {
    {"KHR_materials_pbrSpecularGlossiness", Kind::object, "pbrSpecularGlossiness"},
};
constexpr Property pbr_specular_glossiness[] = {
    {"diffuseFactor", Kind::number, "", optional, {4, 4}},
    {"diffuseTexture", Kind::object, "textureInfo"},
};
constexpr Property mesh[] = {
    {"primitives", Kind::object, "primitive", required, {1, any_number}},
    {"weights", Kind::number, "", optional, some},
};
constexpr Property primitive[] = {
    {"attributes", Kind::dictionary, "accessors", required},
    {"indices", Kind::index, "accessors"},
    {"material", Kind::index, "materials"},
    {"mode", Kind::integer, "0 1 2 3 4 5 6"},
    {"targets", Kind::dictionary, "accessors", optional, some},
    {"extensions", Kind::object, "primitive.extensions"},
};
constexpr Property primitive_extensions[] = {{"KHR_draco_mesh_compression", Kind::object, "draco"}};
constexpr Property draco[] = {
    {"bufferView", Kind::index, "bufferViews", required},
    {"attributes", Kind::dictionary, "", required},
};
constexpr Property skin[] = {
    {"joints", Kind::index, "nodes", required, {1, any_number}},
    {"inverseBindMatrices", Kind::index, "accessors"},
    {"skeleton", Kind::index, "nodes"},
};
constexpr Property node[] = {
    {"children", Kind::index, "nodes", optional, some},
    {"mesh", Kind::index, "meshes"},
    {"skin", Kind::index, "skins"},
    {"camera", Kind::index, "cameras"},
    {"matrix", Kind::number, "", optional, {16, 16}},
    {"translation", Kind::number, "", optional, {3, 3}},
    {"rotation", Kind::number, "", optional, {4, 4}},
    {"scale", Kind::number, "", optional, {3, 3}},
    {"weights", Kind::number, "", optional, some},
    {"extensions", Kind::object, "node.extensions"},
};
constexpr Property node_extensions[] = {{"EXT_mesh_gpu_instancing", Kind::object, "gpuInstancing"}};
constexpr Property gpu_instancing[] = {{"attributes", Kind::dictionary, "accessors", required}};
constexpr Property scene[] = {{"nodes", Kind::index, "nodes", optional, some}};
constexpr Property camera[] = {
    {"type", Kind::string, "", required},
    {"perspective", Kind::object},
    {"orthographic", Kind::object},
};
constexpr Property animation[] = {
    {"channels", Kind::object, "channel", required, any_items},
    {"samplers", Kind::object, "animation sampler", required, any_items},
};
constexpr Property channel[] = {
    {"sampler", Kind::integer, "", required},
    {"target", Kind::object, "channel target", required},
};
constexpr Property channel_target[] = {{"node", Kind::index, "nodes"}, {"path", Kind::string, "", required}};
constexpr Property animation_sampler[] = {
    {"input", Kind::index, "accessors", required},
    {"output", Kind::index, "accessors", required},
    {"interpolation", Kind::string, "LINEAR STEP CUBICSPLINE"},
};

constexpr Schema schemas[] = {
    {"asset", asset},
    {"buffer", buffer},
    {"buffer.extensions", buffer_extensions},
    {"meshopt buffer", meshopt_buffer},
    {"bufferView", buffer_view},
    {"bufferView.extensions", buffer_view_extensions},
    {"meshopt view", meshopt_view},
    {"accessor", accessor},
    {"sparse", sparse},
    {"sparse.indices", sparse_indices},
    {"sparse.values", sparse_values},
    {"image", image},
    {"sampler", sampler},
    {"texture", texture},
    {"texture.extensions", texture_extensions},
    {"texture source", texture_source},
    {"textureInfo", texture_info},
    {"textureInfo.extensions", texture_info_extensions},
    {"textureTransform", texture_transform},
    {"material", material},
    {"pbrMetallicRoughness", pbr_metallic_roughness},
    {"material.extensions", material_extensions},
    {"pbrSpecularGlossiness", pbr_specular_glossiness},
    {"mesh", mesh},
    {"primitive", primitive},
    {"primitive.extensions", primitive_extensions},
    {"draco", draco},
    {"skin", skin},
    {"node", node},
    {"node.extensions", node_extensions},
    {"gpuInstancing", gpu_instancing},
    {"scene", scene},
    {"camera", camera},
    {"animation", animation},
    {"channel", channel},
    {"channel target", channel_target},
    {"animation sampler", animation_sampler},
};

// Every object of glTF may have these.
constexpr Property common[] = {{"name", Kind::string}, {"extensions", Kind::object}};

class Checker {
public:
    Checker(const Json& document, const Context& context) : document_(document), context_(context) {}

    void check_object(Json& object, std::span<const Property> properties, const std::string& where) const {
        // What is there first: a wrong member says more than a missing one.
        for (const Property& property : properties) check_member(object, property, where);
        for (const Property& property : properties)
            if (property.occurs == Occurs::required && !object.contains(property.name))
                fail(context_, place_of(where, property), "is missing");
        for (const Property& property : common) {
            bool listed = false;
            for (const Property& own : properties) listed = listed || own.name == property.name;
            if (!listed) check_member(object, property, where);
        }
    }

private:
    const Json& document_;
    const Context& context_;

    static std::string place_of(const std::string& where, const Property& property) {
        return where.empty() ? std::string(property.name) : where + "." + std::string(property.name);
    }

    void check_member(Json& object, const Property& property, const std::string& where) const {
        const auto found = object.find(property.name);
        if (found == object.end()) return;
        const std::string place = place_of(where, property);
        if (property.items.most == 0) {
            check_value(*found, property, place);
            return;
        }
        if (!found->is_array()) wrong_type(*found, property, place);
        if (found->empty() && property.items.fewest > 0 && property.occurs == Occurs::optional) {
            warn(context_, place, "is an empty array");
            return;
        }
        if (found->size() < property.items.fewest || found->size() > property.items.most)
            fail(context_, place,
                 "has " + std::to_string(found->size()) + " elements instead of " +
                     (property.items.most == any_number ? "at least " + std::to_string(property.items.fewest)
                      : property.items.fewest == property.items.most
                          ? std::to_string(property.items.most)
                          : std::to_string(property.items.fewest) + " to " +
                                std::to_string(property.items.most)));
        for (std::size_t i = 0; i < found->size(); ++i) check_value((*found)[i], property, at(place, i));
    }

    void check_value(Json& value, const Property& property, const std::string& place) const {
        switch (property.kind) {
        case Kind::object:
            if (!value.is_object()) wrong_type(value, property, place);
            for (const Schema& schema : schemas)
                if (schema.name == property.of) check_object(value, schema.properties, place);
            return;
        case Kind::dictionary:
            if (!value.is_object()) wrong_type(value, property, place);
            for (auto& [key, member] : value.items()) check_index(member, property.of, place + "." + key);
            return;
        case Kind::string:
            if (!value.is_string()) wrong_type(value, property, place);
            if (!property.of.empty() && !is_one_of(property.of, value.get_ref<const std::string&>()))
                fail(context_, place,
                     "is '" + value.get<std::string>() + "' instead of one of: " + std::string(property.of));
            return;
        case Kind::boolean:
            if (!value.is_boolean()) wrong_type(value, property, place);
            return;
        case Kind::number:
            if (!value.is_number()) wrong_type(value, property, place);
            if (!std::isfinite(value.get<double>())) fail(context_, place, "is not a finite number");
            return;
        case Kind::integer:
            make_integer(value, property, place);
            if (!property.of.empty() && !is_one_of(property.of, value.dump()))
                fail(context_, place,
                     "is " + value.dump() + " instead of one of: " + std::string(property.of));
            if (value.get<double>() > property.maximum)
                fail(context_, place, "is " + value.dump() + ", too large");
            return;
        case Kind::index: check_index(value, property.of, place); return;
        }
    }

    void check_index(Json& value, std::string_view array, const std::string& place) const {
        make_integer(value, {.name = {}, .kind = Kind::index}, place);
        if (array.empty()) return;
        const auto found = document_.find(array);
        const std::size_t count = found != document_.end() && found->is_array() ? found->size() : 0;
        if (value.get<std::uint64_t>() >= count)
            fail(context_, place,
                 value.dump() + " is out of range (the document has " + std::to_string(count) + " " +
                     std::string(array) + ")");
    }

    void make_integer(Json& value, const Property& property, const std::string& place) const {
        if (value.is_number_float()) {
            const double number = value.get<double>();
            if (number >= 0 && number <= 9007199254740992.0 && number == std::floor(number))
                value = static_cast<std::uint64_t>(number);
        }
        if (value.is_number_integer() && !value.is_number_unsigned())
            fail(context_, place, value.dump() + " is out of range: it is negative");
        if (!value.is_number_unsigned()) wrong_type(value, property, place);
    }

    [[noreturn]] void wrong_type(const Json& value, const Property& property,
                                 const std::string& place) const {
        constexpr const char* names[] = {"object", "object of indices", "string", "boolean",
                                         "number", "integer",           "index"};
        const bool whole_array = property.items.most != 0 && !place.ends_with(']');
        fail(context_, place,
             std::string("must be ") + (whole_array ? "an array, each element: " : "of type ") +
                 names[static_cast<std::size_t>(property.kind)] + ", but is of type " + value.type_name());
    }
};

} // namespace

bool is_one_of(std::string_view words, std::string_view word) {
    while (!words.empty()) {
        const std::size_t end = std::min(words.find(' '), words.size());
        if (words.substr(0, end) == word) return true;
        words.remove_prefix(std::min(end + 1, words.size()));
    }
    return false;
}

void check_schema(Json& document, const Context& context) {
    if (!document.is_object()) fail(context, "", "the JSON is not an object");
    Checker(document, context).check_object(document, root, "");
}

} // namespace spa::import::gltf
