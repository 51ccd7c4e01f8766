// SPDX-License-Identifier: Apache-2.0
#include "paper_methods.h"

#include "../libspa/core/error.h"
#include "../shaders/spa_method.h"

#include <algorithm>

namespace spa::tools {
namespace {

constexpr std::uint32_t most_tests = 50; // of the rule N(d2), section 2.3 of the paper

PaperMethod fan(const std::string& name, std::uint32_t count, std::uint32_t rule) {
    PaperMethod method{name, MapKind::paper, {}};
    method.tracing.tracer = SPA_FAN;
    method.tracing.count = count;
    method.tracing.count_rule = rule;
    method.tracing.fan_start = SPA_FAN_START_LEAVES;
    return method;
}

// Whether a node is `object` or below it.
std::vector<bool> nodes_of_object(const Scene& scene, std::uint32_t object) {
    std::vector<bool> below(scene.nodes.size());
    for (std::uint32_t i = 0; i < scene.nodes.size(); ++i)
        for (std::uint32_t node = i; node != no_index; node = scene.nodes[node].parent)
            if (node == object) below[i] = true;
    return below;
}

// The triangles of a scene that are, or are not, those of the object.
Scene filtered(const PaperScene& from, bool objects) {
    const std::vector<bool> of_object = nodes_of_object(from.scene, from.object);
    Scene result = from.scene;
    result.model.triangles.clear();
    result.model.triangle_materials.clear();
    result.triangle_nodes.clear();
    for (std::size_t i = 0; i < from.scene.model.triangles.size(); ++i) {
        const std::uint32_t node = from.scene.triangle_nodes[i];
        if (of_object[node] != objects) continue;
        result.model.triangles.push_back(from.scene.model.triangles[i]);
        result.model.triangle_materials.push_back(from.scene.model.triangle_materials[i]);
        result.triangle_nodes.push_back(node);
    }
    return result;
}

// Leaves out vertices that no triangle uses.
void compact(Model& model) {
    std::vector<std::uint32_t> place(model.positions.size(), no_index);
    Model result = model;
    result.positions.clear();
    result.normals.clear();
    result.uvs.clear();
    result.colors.clear();
    for (Triangle& triangle : result.triangles)
        for (std::uint32_t& vertex : triangle.vertex) {
            if (place[vertex] == no_index) {
                place[vertex] = std::uint32_t(result.positions.size());
                result.positions.push_back(model.positions[vertex]);
                if (!model.normals.empty()) result.normals.push_back(model.normals[vertex]);
                if (!model.uvs.empty()) result.uvs.push_back(model.uvs[vertex]);
                if (!model.colors.empty()) result.colors.push_back(model.colors[vertex]);
            }
            vertex = place[vertex];
        }
    model = std::move(result);
}

} // namespace

const std::vector<PaperMethod>& paper_methods() {
    static const std::vector<PaperMethod> methods{
        fan("fan 0", 0, SPA_FAN_FIXED),         fan("fan 1", 1, SPA_FAN_FIXED),
        fan("fan 3", 3, SPA_FAN_FIXED),         fan("fan 5", 5, SPA_FAN_FIXED),
        fan("fan 10", 10, SPA_FAN_FIXED),       fan("fan N(d2)", most_tests, SPA_FAN_BY_DISTANCE),
        {"projective", MapKind::one_layer, {}}, {"projective 2 layers", MapKind::two_layers, {}},
        {triangles_name, MapKind::none, {}},
    };
    return methods;
}

const PaperMethod& paper_method(const std::string& name) {
    for (const PaperMethod& method : paper_methods())
        if (method.name == name) return method;
    throw Error(ExitCode::internal, "there is no method " + name);
}

bake::OwnedMap bake_for(const Model& model, MapKind kind) {
    bake::Options options;
    if (kind == MapKind::paper) {
        options.grid = options.color_grid = {Mapping::latlong, 640, 480};
        options.depth = ElementFormat::u8;
        options.normals = ElementFormat::rgb8;
        options.layers = 1;
    } else {
        options.grid = options.color_grid = {Mapping::octahedral, map_cells + 1, map_cells + 1};
        options.layers = kind == MapKind::one_layer ? 1 : 2;
        options.center = bake::Center::captured;
    }
    return bake::bake_model(model, options).map;
}

Scene without_object(const PaperScene& from) {
    Scene scene = filtered(from, false);
    compact(scene.model);
    return scene;
}

Model object_model(const PaperScene& from) {
    Scene scene = filtered(from, true);
    compact(scene.model);
    const Affine to_local = inverse(from.scene.nodes[from.object].to_world);
    const Mat3 normals = normal_matrix(to_local.linear);
    for (Vec3f& p : scene.model.positions) p = to_float(transform_point(to_local, to_double(p)));
    for (Vec3f& n : scene.model.normals) n = to_float(normalize(normals * to_double(n)));
    return std::move(scene.model);
}

Scene with_object(const PaperScene& from, std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                  std::span<const Triangle> triangles) {
    Scene scene = without_object(from);
    Model& model = scene.model;
    const Affine& to_world = from.scene.nodes[from.object].to_world;
    const Mat3 to_world_normal = normal_matrix(to_world.linear);
    const auto first = std::uint32_t(model.positions.size());
    const auto material = std::uint32_t(model.materials.size());
    model.materials.emplace_back();
    for (std::size_t i = 0; i < positions.size(); ++i) {
        model.positions.push_back(to_float(transform_point(to_world, to_double(positions[i]))));
        // A crease of the simplified mesh has no normal; any will do where only distances count.
        const Vec3f normal = length(normals[i]) > 0 ? normals[i] : Vec3f{0, 1, 0};
        model.normals.push_back(to_float(normalize(to_world_normal * to_double(normal))));
    }
    if (!model.uvs.empty()) model.uvs.resize(model.positions.size());
    if (!model.colors.empty()) model.colors.resize(model.positions.size(), Vec4f{1, 1, 1, 1});
    for (const Triangle& triangle : triangles) {
        model.triangles.push_back(
            {{first + triangle.vertex[0], first + triangle.vertex[1], first + triangle.vertex[2]}});
        model.triangle_materials.push_back(material);
        scene.triangle_nodes.push_back(from.object);
    }
    return scene;
}

std::unique_ptr<render::DeviceScene> on_device(const render::Gpu& gpu, const Scene& scene,
                                               std::uint32_t object, const SphericalMap* map,
                                               bool keep_replaced) {
    std::vector<render::MapPlacement> placements;
    if (map != nullptr) {
        render::MapPlacement& placement = placements.emplace_back();
        placement.node = object;
        placement.map = map;
        placement.test_points = map->parts.front().mapping == Mapping::latlong; // met by fans alone
    }
    return std::make_unique<render::DeviceScene>(gpu, scene, placements, keep_replaced);
}

render::Settings settings_of(const PaperMethod& method, const Camera& camera, std::uint32_t width,
                             std::uint32_t height) {
    render::Settings settings;
    settings.width = width;
    settings.height = height;
    settings.camera = camera;
    settings.tracing = method.tracing;
    settings.primary = render::Geometry::triangles;
    settings.shadow = settings.secondary =
        method.map == MapKind::none ? render::Geometry::triangles : render::Geometry::maps;
    return settings;
}

} // namespace spa::tools
