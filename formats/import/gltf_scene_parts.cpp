// SPDX-License-Identifier: Apache-2.0
// Cameras: glTF 2.0, 3.10. Lights: KHR_lights_punctual.
#include "gltf_scene_parts.h"

#include "gltf_check.h"

#include <cmath>
#include <numbers>

namespace spa::import::gltf {
namespace {

constexpr const char* lights_extension = "KHR_lights_punctual";

// Shared children repeat names: what they may add up to.
constexpr std::size_t max_name_bytes = std::size_t{1} << 26U;

std::string name_of(const Json& object) { return object.value("name", std::string()); }

std::optional<Camera> read_camera(const Json& camera, const std::string& where, const Context& context) {
    if (camera["type"] == "orthographic") {
        warn(context, where, "is orthographic, which is not read");
        return {};
    }
    if (!camera.contains("perspective")) fail(context, where + ".perspective", "is missing");
    Camera out;
    out.name = name_of(camera);
    out.vertical_fov = camera["perspective"]["yfov"].get<double>();
    if (!(out.vertical_fov > 0 && out.vertical_fov < std::numbers::pi))
        fail(context, where + ".perspective.yfov",
             "is " + camera["perspective"]["yfov"].dump() + " instead of between 0 and pi");
    return out;
}

void read_cones(const Json& spot, Light& light, const std::string& where, const Context& context) {
    light.inner_cone = spot.value("innerConeAngle", 0.0);
    light.outer_cone = spot.value("outerConeAngle", std::numbers::pi / 4);
    // Half of pi in single precision, as exporters write it, is a little more than in double.
    constexpr double most = std::numbers::pi / 2;
    if (light.outer_cone > most && light.outer_cone <= most * (1 + 1e-6)) light.outer_cone = most;
    if (!(light.inner_cone >= 0 && light.inner_cone < light.outer_cone && light.outer_cone <= most))
        fail(context, where,
             "has the angles " + std::to_string(light.inner_cone) + " and " +
                 std::to_string(light.outer_cone) +
                 "; it must be 0 <= innerConeAngle < outerConeAngle <= pi/2");
}

Light read_light(const Json& source, const std::string& where, const Context& context) {
    Light light;
    light.name = name_of(source);
    const std::string& type = source["type"].get_ref<const std::string&>();
    light.kind = type == "point"  ? LightKind::point
                 : type == "spot" ? LightKind::spot
                                  : LightKind::directional;
    const double intensity = source.value("intensity", 1.0);
    if (intensity < 0) fail(context, where + ".intensity", "is negative");
    Vec3d color{1, 1, 1};
    if (source.contains("color")) {
        const Json& rgb = source["color"];
        color = {rgb[0], rgb[1], rgb[2]};
        if (color.x < 0 || color.y < 0 || color.z < 0) fail(context, where + ".color", "is negative");
        if (color.x > 1 || color.y > 1 || color.z > 1)
            warn(context, where + ".color", "has values outside [0, 1]");
    }
    light.intensity = to_float(color * intensity);
    if (!is_finite(light.intensity)) fail(context, where + ".intensity", "is too large for a float");
    if (source.contains("range")) warn(context, where + ".range", "is ignored: the light reaches all");
    if (light.kind == LightKind::spot)
        read_cones(source.value("spot", Json::object()), light, where + ".spot", context);
    return light;
}

void check_node_lights(const Json& document, std::size_t count, const Context& context) {
    const Json& nodes = member_of(document, "nodes");
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Json& extensions = member_of(nodes[i], "extensions");
        if (!extensions.contains(lights_extension)) continue;
        const std::uint64_t light = integer_of(extensions[lights_extension], "light");
        if (light >= count)
            fail(context, at("nodes", i) + ".extensions." + lights_extension + ".light",
                 std::to_string(light) + " is out of range (the document has " + std::to_string(count) +
                     " lights)");
    }
}

class Filler {
public:
    Filler(const tinygltf::Model& model, const SceneParts& parts, Scene& scene, const Context& context)
        : model_(model), parts_(parts), scene_(scene), context_(context) {}

    void add(const Place& place) {
        const tinygltf::Node& node = model_.nodes[place.node];
        if (!is_finite(place.world))
            fail(context_, at("nodes", place.node), "its transform or that of a parent is not finite");
        const bool is_group = node.mesh >= 0 && node.extensions.count("EXT_mesh_gpu_instancing") != 0;
        const bool is_nameless = is_group && place.kind != Place::Kind::instance;
        scene_.nodes.push_back({is_nameless ? "" : counted(node.name), place.parent, place.world, place.local,
                                static_cast<std::uint32_t>(place.node)});
        if (place.kind != Place::Kind::node) return;
        if (node.camera >= 0) add_camera(place, node);
        const auto light = node.extensions.find(lights_extension);
        if (light != node.extensions.end()) add_light(place, node, light->second);
    }

private:
    const std::string& counted(const std::string& name) {
        name_bytes_ += name.size();
        if (name_bytes_ > max_name_bytes)
            fail(context_, "nodes",
                 "shared children and instances multiply the names to more than " +
                     std::to_string(max_name_bytes) + " bytes");
        return name;
    }

    void add_camera(const Place& place, const tinygltf::Node& node) {
        const std::optional<Camera>& source = parts_.cameras[static_cast<std::size_t>(node.camera)];
        if (!source) return;
        const double size = determinant(place.world.linear);
        if (size == 0 || !std::isfinite(size))
            fail(context_, at("nodes", place.node),
                 "has a camera, but its transform leaves no volume; take the scale of 0 out");
        Camera& camera = scene_.cameras.emplace_back();
        camera.name = counted(source->name.empty() ? node.name : source->name);
        camera.to_world = place.world;
        camera.vertical_fov = source->vertical_fov;
    }

    void add_light(const Place& place, const tinygltf::Node& node, const tinygltf::Value& extension) {
        const Light& source =
            parts_.lights[static_cast<std::size_t>(extension.Get("light").GetNumberAsInt())];
        const Vec3d direction = normalize(transform_vector(place.world, {0, 0, -1}));
        if (source.kind != LightKind::point && !(std::abs(length(direction) - 1) < 1e-6))
            fail(context_, at("nodes", place.node),
                 "has a light, but its transform leaves no direction; take the scale of 0 out");
        Light& light = scene_.lights.emplace_back();
        light.name = counted(source.name.empty() ? node.name : source.name);
        light.kind = source.kind;
        light.position = place.world.translation;
        if (light.kind != LightKind::point) light.direction = direction;
        light.intensity = source.intensity;
        light.inner_cone = source.inner_cone;
        light.outer_cone = source.outer_cone;
    }

    const tinygltf::Model& model_;
    const SceneParts& parts_;
    Scene& scene_;
    const Context& context_;
    std::size_t name_bytes_ = 0;
};

} // namespace

SceneParts read_scene_parts(Json& document, const Context& context) {
    check_scene_schema(document, context);
    SceneParts parts;
    const Json& cameras = member_of(document, "cameras");
    for (std::size_t i = 0; i < cameras.size(); ++i)
        parts.cameras.push_back(read_camera(cameras[i], at("cameras", i), context));
    const Json& lights = member_of(member_of(member_of(document, "extensions"), lights_extension), "lights");
    for (std::size_t i = 0; i < lights.size(); ++i)
        parts.lights.push_back(read_light(
            lights[i], std::string("extensions.") + lights_extension + "." + at("lights", i), context));
    check_node_lights(document, parts.lights.size(), context);
    return parts;
}

void fill_scene(const tinygltf::Model& model, const std::vector<Place>& places, const SceneParts& parts,
                Scene& scene, const Context& context) {
    Filler filler(model, parts, scene, context);
    scene.nodes.reserve(places.size());
    for (const Place& place : places) filler.add(place);
}

} // namespace spa::import::gltf
