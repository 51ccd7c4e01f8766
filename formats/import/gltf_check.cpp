// SPDX-License-Identifier: Apache-2.0
// Version, extensions, meshes, skins and animations.
#include "gltf_check.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace spa::import::gltf {
namespace {

// Required extensions that are read, or that change neither geometry nor base colour. A '*' at the end
// stands for any rest.
constexpr std::array<std::string_view, 14> accepted_extensions{"KHR_draco_mesh_compression",
                                                               "EXT_meshopt_compression",
                                                               "KHR_mesh_quantization",
                                                               "KHR_texture_transform",
                                                               "EXT_mesh_gpu_instancing",
                                                               "EXT_texture_webp",
                                                               "KHR_materials_*",
                                                               "KHR_lights_punctual",
                                                               "KHR_xmp*",
                                                               "KHR_animation_pointer",
                                                               "EXT_lights_*",
                                                               "KHR_audio*",
                                                               "MSFT_lod",
                                                               "MSFT_packing_*"};

bool is_accepted(std::string_view name) {
    return std::any_of(accepted_extensions.begin(), accepted_extensions.end(),
                       [&](std::string_view accepted) {
                           if (accepted.back() != '*') return accepted == name;
                           accepted.remove_suffix(1);
                           return name.substr(0, accepted.size()) == accepted;
                       });
}

struct Version {
    unsigned long major = 0, minor = 0;
};

Version parse_version(const Json& asset, const char* key, const Context& context) {
    const std::string& text = asset[key].get_ref<const std::string&>();
    const std::size_t dot = text.find('.');
    const auto digits = [](std::string_view part) {
        return !part.empty() && part.size() < 6 &&
               std::all_of(part.begin(), part.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
    };
    if (dot == std::string::npos || !digits(text.substr(0, dot)) || !digits(text.substr(dot + 1)))
        fail(context, std::string("asset.") + key, "'" + text.substr(0, 40) + "' is not a version like 2.0");
    return {std::stoul(text.substr(0, dot)), std::stoul(text.substr(dot + 1))};
}

enum Components : unsigned { // bits of AttributeRule::components
    byte_ = 1,
    unsigned_byte = 2,
    short_ = 4,
    unsigned_short = 8,
    float_ = 64,
    any_small = byte_ | unsigned_byte | short_ | unsigned_short,
};

// What an attribute may be, KHR_mesh_quantization included; "_" at the end: a set number follows.
struct AttributeRule {
    std::string_view name;
    std::string_view types; // blank-separated
    unsigned components;
};
constexpr AttributeRule attribute_rules[] = {
    {"POSITION", "VEC3", float_ | any_small},
    {"NORMAL", "VEC3", float_ | byte_ | short_},
    {"TANGENT", "VEC3 VEC4", float_ | byte_ | short_}, // VEC3 in morph targets
    {"TEXCOORD_", "VEC2", float_ | any_small},
    {"COLOR_", "VEC3 VEC4", float_ | unsigned_byte | unsigned_short},
    {"JOINTS_", "VEC4", unsigned_byte | unsigned_short},
    {"WEIGHTS_", "VEC4", float_ | unsigned_byte | unsigned_short},
};
constexpr AttributeRule instance_rules[] = {
    {"TRANSLATION", "VEC3", float_},
    {"ROTATION", "VEC4", float_ | byte_ | short_},
    {"SCALE", "VEC3", float_},
};

const AttributeRule* rule_for(std::span<const AttributeRule> rules, std::string_view name) {
    for (const AttributeRule& rule : rules) {
        if (rule.name.back() != '_') {
            if (rule.name == name) return &rule;
            continue;
        }
        if (name.substr(0, rule.name.size()) != rule.name) continue;
        const std::string_view set = name.substr(rule.name.size());
        const bool number =
            !set.empty() && set.size() < 4 && (set == "0" || set.front() != '0') &&
            std::all_of(set.begin(), set.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
        if (number) return &rule;
    }
    return nullptr;
}

// What an accessor without a buffer view may claim where nothing else in the file backs its elements.
constexpr std::uint64_t max_unbacked_elements = 65536;

void check_claim(const Json& document, std::uint64_t index, const Context& context) {
    const Json& accessor = document["accessors"][index];
    const std::uint64_t count = integer_of(accessor, "count");
    if (!accessor.contains("bufferView") && count > max_unbacked_elements)
        fail(context, at("accessors", index) + ".count",
             "claims " + std::to_string(count) + " elements without a bufferView");
}

// Types of the known attributes; one count for all of them.
void check_attributes(const Json& document, const Json& attributes, std::span<const AttributeRule> rules,
                      std::uint64_t count, const std::string& where, const Context& context) {
    for (const auto& [name, index] : attributes.items()) {
        const std::string place = where + "." + name;
        const AttributeRule* rule = rule_for(rules, name);
        if (rule == nullptr) {
            if (name.empty() || name.front() != '_')
                warn(context, place, "is not an attribute that glTF knows");
            continue;
        }
        const Json& accessor = document["accessors"][index.get<std::size_t>()];
        const std::string type = accessor["type"];
        const std::uint64_t component = integer_of(accessor, "componentType");
        if (!is_one_of(rule->types, type))
            fail(context, place, "has type " + type + " instead of " + std::string(rule->types));
        if ((rule->components & 1U << (component - 5120)) == 0)
            fail(context, place,
                 "has component type " + std::to_string(component) + ", which is not allowed");
        if (integer_of(accessor, "count") != count)
            fail(context, place,
                 "has " + std::to_string(integer_of(accessor, "count")) + " elements, the others " +
                     std::to_string(count));
        const Json& views = member_of(document, "bufferViews");
        const std::uint64_t offset = integer_of(accessor, "byteOffset");
        if (accessor.contains("bufferView")) {
            const Json& view = views[integer_of(accessor, "bufferView")];
            const std::size_t element = component_size(component) * component_count(type);
            if (offset % 4 != 0 || integer_of(view, "byteStride", element) % 4 != 0)
                warn(context, place, "is not aligned to 4 bytes");
        }
    }
}

void check_indices(const Json& document, const Json& primitive, const std::string& where,
                   const Context& context) {
    const std::uint64_t index = integer_of(primitive, "indices");
    const Json& accessor = document["accessors"][index];
    const std::uint64_t type = integer_of(accessor, "componentType");
    if (accessor["type"] != "SCALAR" || (type != 5121 && type != 5123 && type != 5125))
        fail(context, where, at("accessors", index) + " is not a SCALAR of unsigned integers");
    if (member_of(primitive, "extensions").contains("KHR_draco_mesh_compression")) return;
    if (!accessor.contains("bufferView") || accessor.contains("sparse"))
        fail(context, where, at("accessors", index) + " needs a bufferView and no sparse values");
    const std::uint64_t view = integer_of(accessor, "bufferView");
    if (document["bufferViews"][view].contains("byteStride"))
        fail(context, where, at("bufferViews", view) + " has a byteStride, which indices must not have");
}

void check_primitive(const Json& document, const Json& primitive, const std::string& where,
                     const Context& context) {
    const Json& attributes = primitive["attributes"];
    if (primitive.contains("indices")) check_indices(document, primitive, where + ".indices", context);
    if (!attributes.contains("POSITION")) {
        warn(context, where + ".attributes", "has no POSITION, so the primitive is not drawn");
        return;
    }
    const std::uint64_t position = integer_of(attributes, "POSITION");
    const Json& accessor = document["accessors"][position];
    const std::uint64_t count = integer_of(accessor, "count");
    check_attributes(document, attributes, attribute_rules, count, where + ".attributes", context);
    const auto warn_bounds = [&](const Json& of, std::uint64_t index) {
        if (!of.contains("min") || !of.contains("max"))
            warn(context, at("accessors", index), "holds POSITION but has no min and max");
    };
    warn_bounds(accessor, position);
    const bool draco = member_of(primitive, "extensions").contains("KHR_draco_mesh_compression");
    if (!draco) check_claim(document, position, context);
    if (!accessor.contains("bufferView") && !draco)
        warn(context, where + ".attributes.POSITION", "has no bufferView: all its points are the origin");

    const Json& targets = member_of(primitive, "targets");
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const std::string place = where + "." + at("targets", i);
        check_attributes(document, targets[i], attribute_rules, count, place, context);
        for (const auto& [name, index] : targets[i].items())
            if (!attributes.contains(name)) warn(context, place + "." + name, "has no attribute to add to");
        if (targets[i].contains("POSITION")) {
            const std::uint64_t index = integer_of(targets[i], "POSITION");
            warn_bounds(document["accessors"][index], index);
        }
    }
    const auto set_count = [&](const std::string& prefix) {
        std::size_t sets = 0;
        for (const auto& [name, index] : attributes.items())
            if (name.rfind(prefix, 0) == 0 && rule_for(attribute_rules, name) != nullptr) ++sets;
        for (std::size_t i = 0; i < sets; ++i)
            if (!attributes.contains(prefix + std::to_string(i)))
                warn(context, where + ".attributes",
                     "has " + std::to_string(sets) + " " + prefix + "n, but no " + prefix +
                         std::to_string(i));
        return sets;
    };
    (void)set_count("TEXCOORD_");
    (void)set_count("COLOR_");
    constexpr std::size_t most_sets = 8;
    const std::size_t joints = set_count("JOINTS_");
    if (joints > most_sets)
        fail(context, where + ".attributes",
             "has " + std::to_string(joints) + " JOINTS_n, more than the limit of " +
                 std::to_string(most_sets));
    if (joints != set_count("WEIGHTS_"))
        fail(context, where + ".attributes", "JOINTS_n and WEIGHTS_n do not come in pairs");
}

} // namespace

void check_asset(const Json& document, const Context& context) {
    const Json& asset = document["asset"];
    const std::string version = asset["version"];
    if (parse_version(asset, "version", context).major != 2)
        fail(context, "asset.version", "is " + version + "; only glTF 2 is read");
    if (asset.contains("minVersion")) {
        const Version least = parse_version(asset, "minVersion", context);
        if (least.major > 2 || (least.major == 2 && least.minor > 0))
            fail(context, "asset.minVersion",
                 "is " + asset["minVersion"].get<std::string>() + "; what 2.0 specifies is read");
    }
    for (const Json& extension : member_of(document, "extensionsRequired")) {
        const std::string& name = extension.get_ref<const std::string&>();
        if (!is_accepted(name))
            throw Error(ExitCode::unsupported, context.asset.path.string() + ": extensionsRequired: " + name +
                                                   " is not supported; export the asset without it");
    }
}

void check_meshes(const Json& document, const Context& context) {
    const Json& meshes = member_of(document, "meshes");
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const Json& primitives = meshes[i]["primitives"];
        for (std::size_t j = 0; j < primitives.size(); ++j)
            check_primitive(document, primitives[j], at("meshes", i) + "." + at("primitives", j), context);
    }
    const Json& nodes = member_of(document, "nodes");
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Json& extensions = member_of(nodes[i], "extensions");
        if (!extensions.contains("EXT_mesh_gpu_instancing")) continue;
        const Json& attributes = extensions["EXT_mesh_gpu_instancing"]["attributes"];
        if (attributes.empty()) continue;
        const std::uint64_t first = attributes.begin()->get<std::uint64_t>();
        for (const Json& index : attributes) check_claim(document, index.get<std::uint64_t>(), context);
        check_attributes(document, attributes, instance_rules,
                         integer_of(document["accessors"][first], "count"),
                         at("nodes", i) + ".extensions.EXT_mesh_gpu_instancing.attributes", context);
    }
}

void check_skins(const Json& document, const Context& context) {
    const Json& skins = member_of(document, "skins");
    for (std::size_t i = 0; i < skins.size(); ++i) {
        if (!skins[i].contains("inverseBindMatrices")) continue;
        const std::string where = at("skins", i) + ".inverseBindMatrices";
        const std::uint64_t index = integer_of(skins[i], "inverseBindMatrices");
        const Json& accessor = document["accessors"][index];
        if (accessor["type"] != "MAT4" || integer_of(accessor, "componentType") != 5126)
            fail(context, where, at("accessors", index) + " is not a MAT4 of floats");
        if (integer_of(accessor, "count") < skins[i]["joints"].size())
            fail(context, where,
                 at("accessors", index) + " has " + std::to_string(integer_of(accessor, "count")) +
                     " matrices for " + std::to_string(skins[i]["joints"].size()) + " joints");
        if (!accessor.contains("bufferView")) continue;
        const std::uint64_t view = integer_of(accessor, "bufferView");
        if (document["bufferViews"][view].contains("byteStride"))
            fail(context, where,
                 at("bufferViews", view) + " has a byteStride, which these matrices must not have");
    }
}

void check_animations(const Json& document, const Context& context) {
    const Json& animations = member_of(document, "animations");
    for (std::size_t i = 0; i < animations.size(); ++i)
        for (std::size_t j = 0; j < animations[i]["channels"].size(); ++j)
            if (integer_of(animations[i]["channels"][j], "sampler") >= animations[i]["samplers"].size())
                fail(context, at("animations", i) + "." + at("channels", j) + ".sampler",
                     "is out of range (the animation has " +
                         std::to_string(animations[i]["samplers"].size()) + " samplers)");
}

} // namespace spa::import::gltf
