// SPDX-License-Identifier: Apache-2.0
// The schema itself: one table for each object of glTF 2.0 and of the extensions that are read.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string_view>

namespace spa::import::gltf::schema {

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
inline constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();
inline constexpr Items single{}, some{1, any_number}, any_items{0, any_number};

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

inline constexpr Occurs required = Occurs::required, optional = Occurs::optional;
inline constexpr double int_max = 2147483647.0;

inline constexpr Property root[] = {
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
inline constexpr Property asset[] = {
    {"version", Kind::string, "", required},
    {"minVersion", Kind::string},
    {"generator", Kind::string},
    {"copyright", Kind::string},
};
inline constexpr Property buffer[] = {
    {"byteLength", Kind::integer, "", required},
    {"uri", Kind::string},
    {"extensions", Kind::object, "buffer.extensions"},
};
inline constexpr Property buffer_extensions[] = {{"EXT_meshopt_compression", Kind::object, "meshopt buffer"}};
inline constexpr Property meshopt_buffer[] = {{"fallback", Kind::boolean}};
inline constexpr Property buffer_view[] = {
    {"buffer", Kind::index, "buffers", required}, {"byteOffset", Kind::integer},
    {"byteLength", Kind::integer, "", required},  {"byteStride", Kind::integer},
    {"target", Kind::integer, "34962 34963"},     {"extensions", Kind::object, "bufferView.extensions"},
};
inline constexpr Property buffer_view_extensions[] = {
    {"EXT_meshopt_compression", Kind::object, "meshopt view"}};
inline constexpr Property meshopt_view[] = {
    {"buffer", Kind::index, "buffers", required},
    {"byteOffset", Kind::integer},
    {"byteLength", Kind::integer, "", required},
    {"byteStride", Kind::integer, "", required},
    {"count", Kind::integer, "", required},
    {"mode", Kind::string, "ATTRIBUTES TRIANGLES INDICES", required},
    {"filter", Kind::string, "NONE OCTAHEDRAL QUATERNION EXPONENTIAL"},
};
inline constexpr std::string_view component_types = "5120 5121 5122 5123 5125 5126";
inline constexpr Property accessor[] = {
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
inline constexpr Property sparse[] = {
    {"count", Kind::integer, "", required, single, int_max},
    {"indices", Kind::object, "sparse.indices", required},
    {"values", Kind::object, "sparse.values", required},
};
inline constexpr Property sparse_indices[] = {
    {"bufferView", Kind::index, "bufferViews", required},
    {"byteOffset", Kind::integer, "", optional, single, int_max},
    {"componentType", Kind::integer, "5121 5123 5125", required},
};
inline constexpr Property sparse_values[] = {
    {"bufferView", Kind::index, "bufferViews", required},
    {"byteOffset", Kind::integer, "", optional, single, int_max},
};
inline constexpr Property image[] = {
    {"uri", Kind::string},
    {"mimeType", Kind::string},
    {"bufferView", Kind::index, "bufferViews"},
};
inline constexpr Property sampler[] = {
    {"magFilter", Kind::integer, "9728 9729"},
    {"minFilter", Kind::integer, "9728 9729 9984 9985 9986 9987"},
    {"wrapS", Kind::integer, "33071 33648 10497"},
    {"wrapT", Kind::integer, "33071 33648 10497"},
};
inline constexpr Property texture[] = {
    {"sampler", Kind::index, "samplers"},
    {"source", Kind::index, "images"},
    {"extensions", Kind::object, "texture.extensions"},
};
inline constexpr Property texture_extensions[] = {
    {"EXT_texture_webp", Kind::object, "texture source"},
    {"KHR_texture_basisu", Kind::object, "texture source"},
    {"MSFT_texture_dds", Kind::object, "texture source"},
};
inline constexpr Property texture_source[] = {{"source", Kind::index, "images"}};
inline constexpr Property texture_info[] = {
    {"index", Kind::index, "textures", required},
    {"texCoord", Kind::integer, "", optional, single, int_max},
    {"scale", Kind::number},    // normalTexture
    {"strength", Kind::number}, // occlusionTexture
    {"extensions", Kind::object, "textureInfo.extensions"},
};
inline constexpr Property texture_info_extensions[] = {
    {"KHR_texture_transform", Kind::object, "textureTransform"}};
inline constexpr Property texture_transform[] = {
    {"offset", Kind::number, "", optional, {2, 2}},
    {"rotation", Kind::number},
    {"scale", Kind::number, "", optional, {2, 2}},
    {"texCoord", Kind::integer, "", optional, single, int_max},
};
inline constexpr Property material[] = {
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
inline constexpr Property pbr_metallic_roughness[] = {
    {"baseColorFactor", Kind::number, "", optional, {4, 4}},
    {"baseColorTexture", Kind::object, "textureInfo"},
    {"metallicFactor", Kind::number},
    {"roughnessFactor", Kind::number},
    {"metallicRoughnessTexture", Kind::object, "textureInfo"},
};
inline constexpr Property material_extensions[] = {
    {"KHR_materials_pbrSpecularGlossiness", Kind::object, "pbrSpecularGlossiness"},
};
inline constexpr Property pbr_specular_glossiness[] = {
    {"diffuseFactor", Kind::number, "", optional, {4, 4}},
    {"diffuseTexture", Kind::object, "textureInfo"},
};
inline constexpr Property mesh[] = {
    {"primitives", Kind::object, "primitive", required, {1, any_number}},
    {"weights", Kind::number, "", optional, some},
};
inline constexpr Property primitive[] = {
    {"attributes", Kind::dictionary, "accessors", required},
    {"indices", Kind::index, "accessors"},
    {"material", Kind::index, "materials"},
    {"mode", Kind::integer, "0 1 2 3 4 5 6"},
    {"targets", Kind::dictionary, "accessors", optional, some},
    {"extensions", Kind::object, "primitive.extensions"},
};
inline constexpr Property primitive_extensions[] = {{"KHR_draco_mesh_compression", Kind::object, "draco"}};
inline constexpr Property draco[] = {
    {"bufferView", Kind::index, "bufferViews", required},
    {"attributes", Kind::dictionary, "", required},
};
inline constexpr Property skin[] = {
    {"joints", Kind::index, "nodes", required, {1, any_number}},
    {"inverseBindMatrices", Kind::index, "accessors"},
    {"skeleton", Kind::index, "nodes"},
};
inline constexpr Property node[] = {
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
inline constexpr Property node_extensions[] = {{"EXT_mesh_gpu_instancing", Kind::object, "gpuInstancing"}};
inline constexpr Property gpu_instancing[] = {{"attributes", Kind::dictionary, "accessors", required}};
inline constexpr Property scene[] = {{"nodes", Kind::index, "nodes", optional, some}};
inline constexpr Property camera[] = {
    {"type", Kind::string, "", required},
    {"perspective", Kind::object},
    {"orthographic", Kind::object},
};
inline constexpr Property animation[] = {
    {"channels", Kind::object, "channel", required, any_items},
    {"samplers", Kind::object, "animation sampler", required, any_items},
};
inline constexpr Property channel[] = {
    {"sampler", Kind::integer, "", required},
    {"target", Kind::object, "channel target", required},
};
inline constexpr Property channel_target[] = {{"node", Kind::index, "nodes"},
                                              {"path", Kind::string, "", required}};
inline constexpr Property animation_sampler[] = {
    {"input", Kind::index, "accessors", required},
    {"output", Kind::index, "accessors", required},
    {"interpolation", Kind::string, "LINEAR STEP CUBICSPLINE"},
};

// Of what only a scene needs: the same objects again, with more known of them.
inline constexpr Property scene_root[] = {
    {"cameras", Kind::object, "scene camera", optional, some},
    {"nodes", Kind::object, "lit node", optional, some},
    {"extensions", Kind::object, "root.extensions"},
};
inline constexpr Property scene_camera[] = {
    {"type", Kind::string, "perspective orthographic", required},
    {"perspective", Kind::object, "perspective"},
};
inline constexpr Property perspective[] = {
    {"yfov", Kind::number, "", required},
    {"aspectRatio", Kind::number},
    {"znear", Kind::number},
    {"zfar", Kind::number},
};
inline constexpr Property root_extensions[] = {{"KHR_lights_punctual", Kind::object, "punctual lights"}};
inline constexpr Property punctual_lights[] = {{"lights", Kind::object, "light", optional, some}};
inline constexpr Property light[] = {
    {"type", Kind::string, "directional point spot", required},
    {"color", Kind::number, "", optional, {3, 3}},
    {"intensity", Kind::number},
    {"range", Kind::number},
    {"spot", Kind::object, "light.spot"},
};
inline constexpr Property light_spot[] = {
    {"innerConeAngle", Kind::number},
    {"outerConeAngle", Kind::number},
};
inline constexpr Property lit_node[] = {{"extensions", Kind::object, "lit node.extensions"}};
inline constexpr Property lit_node_extensions[] = {{"KHR_lights_punctual", Kind::object, "node light"}};
inline constexpr Property node_light[] = {{"light", Kind::integer, "", required}};

inline constexpr Schema schemas[] = {
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
    {"scene camera", scene_camera},
    {"perspective", perspective},
    {"root.extensions", root_extensions},
    {"punctual lights", punctual_lights},
    {"light", light},
    {"light.spot", light_spot},
    {"lit node", lit_node},
    {"lit node.extensions", lit_node_extensions},
    {"node light", node_light},
};

// Every object of glTF may have these.
inline constexpr Property common[] = {{"name", Kind::string}, {"extensions", Kind::object}};

} // namespace spa::import::gltf::schema
