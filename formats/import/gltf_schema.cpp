// SPDX-License-Identifier: Apache-2.0
#include "gltf_schema.h"

#include "gltf_schema_tables.h"
#include "readers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>

namespace spa::import::gltf {
namespace {

using namespace schema; // NOLINT(google-build-using-namespace): the tables are made for this file

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
            object.erase(found); // so that nobody reads what is not in it
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

void check_counts(const Json& document, const Context& context) {
    struct Row {
        const char* name;
        std::size_t most;
    };
    constexpr std::size_t many = std::size_t{1} << 21U, some = std::size_t{1} << 18U,
                          few = std::size_t{1} << 16U;
    constexpr Row rows[] = {{"accessors", many},   {"bufferViews", many}, {"nodes", max_nodes},
                            {"meshes", max_nodes}, {"buffers", few},      {"images", few},
                            {"samplers", few},     {"textures", few},     {"materials", few},
                            {"cameras", few},      {"skins", some},       {"animations", some},
                            {"scenes", some}};
    if (!document.is_object()) return;
    const auto check = [&](const std::string& name, std::size_t count, std::size_t most) {
        if (count > most)
            fail(context, name,
                 "has " + std::to_string(count) + " elements, more than the limit of " +
                     std::to_string(most));
    };
    for (const Row& row : rows) {
        const auto found = document.find(row.name);
        if (found != document.end()) check(row.name, found->size(), row.most);
    }
    const auto meshes = document.find("meshes");
    if (meshes == document.end() || !meshes->is_array()) return;
    std::size_t primitives = 0;
    for (const Json& mesh : *meshes)
        if (mesh.is_object() && mesh.contains("primitives")) primitives += mesh["primitives"].size();
    check("meshes.primitives", primitives, many);
}

namespace {

template <std::size_t count>
void keep_only(Json& object, const std::array<std::string_view, count>& names) {
    for (auto member = object.begin(); member != object.end();)
        member = std::find(names.begin(), names.end(), member.key()) == names.end() ? object.erase(member)
                                                                                    : std::next(member);
}

// What is left of an extension: what it says itself. "attributes" may have members of any name; extensions of
// its own are those of remove_unread.
void keep_read(Json& value) {
    constexpr std::array<std::string_view, 12> members{
        "bufferView", "attributes", "index", "texCoord",      "offset",         "rotation",
        "scale",      "source",     "light", "diffuseFactor", "diffuseTexture", "extensions"};
    if (!value.is_object()) return;
    keep_only(value, members);
    for (const auto& [name, member] : value.items())
        if (name != "attributes" && name != "extensions") keep_read(member);
}

} // namespace

void remove_unread(Json& document) {
    constexpr std::array<std::string_view, 8> read{
        "KHR_draco_mesh_compression", "EXT_mesh_gpu_instancing",
        "KHR_texture_transform",      "EXT_texture_webp",
        "KHR_texture_basisu",         "MSFT_texture_dds",
        "KHR_lights_punctual",        "KHR_materials_pbrSpecularGlossiness"};
    if (document.is_object()) {
        document.erase("extras");
        const auto extensions = document.find("extensions");
        if (extensions != document.end() && extensions->is_object()) {
            keep_only(*extensions, read);
            for (Json& extension : *extensions) keep_read(extension);
        }
    }
    if (document.is_structured())
        for (Json& member : document) remove_unread(member);
}

void check_scene_schema(Json& document, const Context& context) {
    Checker(document, context).check_object(document, scene_root, "");
}

} // namespace spa::import::gltf
