// SPDX-License-Identifier: Apache-2.0
#include "render_input.h"

#include "near_names.h"
#include "text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace spa::tools {

namespace {}

void check_apart(const Scene& scene, const std::vector<PlacedMap>& maps) {
    for (const PlacedMap& map : maps)
        if (map.replaces_scene() && maps.size() > 1)
            throw Error(ExitCode::usage, "--map: a map without NODE takes the place of the whole scene; give "
                                         "it alone, or a NODE to each");
    if (maps.size() < 2) return;
    for (const PlacedMap& map : maps)
        for (const PlacedMap& other : maps)
            for (const std::uint32_t node : map.nodes)
                for (const std::uint32_t above : other.nodes)
                    if (is_below(scene, node, above))
                        throw Error(ExitCode::usage, "--map: the node '" + map.node + "' lies below '" +
                                                         other.node +
                                                         "', which has a map too; leave one of them out");
}

struct Box {
    Vec3d low, high;
};

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Box no_box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

void grow(Box& box, Vec3d p) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
}

Vec3d middle(const Box& box) { return (box.low + box.high) * 0.5; }
double half_diagonal(const Box& box) { return length(box.high - box.low) / 2; }

Box bounds(const Model& model) {
    Box box = no_box;
    for (const Vec3f position : model.positions) grow(box, to_double(position));
    return box;
}

// Of what the node and those below it draw, in the space that `from_world` leads to.
Box bounds_of(const Scene& scene, std::uint32_t node, const Affine& from_world) {
    std::vector<bool> of_node(scene.nodes.size()); // a node comes behind its parent
    for (std::uint32_t i = node; i < scene.nodes.size(); ++i)
        of_node[i] = i == node || (scene.nodes[i].parent != no_index && of_node[scene.nodes[i].parent]);
    Box box = no_box;
    for (std::size_t i = 0; i < scene.model.triangles.size(); ++i) {
        if (!of_node[scene.triangle_nodes[i]]) continue;
        for (const std::uint32_t vertex : scene.model.triangles[i].vertex)
            grow(box, transform_point(from_world, to_double(scene.model.positions[vertex])));
    }
    return box;
}

// direction: in the camera's space; irradiance: of what faces it.
Light sun_along(const Camera& camera, Vec3d direction, double irradiance) {
    Light sun;
    sun.name = "sun";
    sun.kind = LightKind::directional;
    sun.direction = normalize(transform_vector(camera.to_world, direction));
    sun.intensity = to_float(Vec3d{irradiance, irradiance, irradiance});
    return sun;
}

// The box of the cubes whose corners lie on the parts' spheres: as large as an object that fills them.
Box sphere_bounds(const SphericalMap& map) {
    Box box = no_box;
    for (const Part& part : map.parts) {
        const double half = part.radius * std::cbrt(std::abs(determinant(part.frame))) / std::sqrt(3.0);
        grow(box, part.center - Vec3d{half, half, half});
        grow(box, part.center + Vec3d{half, half, half});
    }
    return box;
}

} // namespace

std::vector<std::uint32_t> find_nodes(const Scene& scene, const std::string& scene_name,
                                      const std::string& node) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].name == node) found.push_back(i);
    if (found.empty())
        throw Error(ExitCode::usage, "--map: there is no node '" + node + "' in " + scene_name +
                                         suggestion(node, names_of(scene.nodes)));
    std::vector<std::uint32_t> outermost;
    std::copy_if(found.begin(), found.end(), std::back_inserter(outermost), [&](std::uint32_t i) {
        return std::none_of(found.begin(), found.end(),
                            [&](std::uint32_t above) { return is_below(scene, i, above); });
    });
    return outermost;
}

std::vector<std::string> misfits(const Scene& scene, const std::vector<PlacedMap>& maps, bool is_posed) {
    std::vector<std::string> sentences;
    for (const PlacedMap& map : maps) {
        const std::vector<Part>& parts = map.file.map().parts;
        if (is_posed && std::any_of(parts.begin(), parts.end(), [](const Part& p) { return p.node >= 0; }))
            continue; // they stand where their nodes do
        const Box of_map = sphere_bounds(map.file.map());
        for (const std::uint32_t node : map.nodes) {
            if (node == no_index) continue; // it lies in the world, as the scene does
            const Box box = bounds_of(scene, node, inverse(scene.nodes[node].to_world));
            const Vec3d center = middle(of_map);
            const double size = half_diagonal(box);
            if (!(size > 0)) continue; // it draws nothing
            // A centre that was moved to see more lies off the middle, and its sphere is larger.
            const double ratio = half_diagonal(of_map) / size;
            const double away = length(center - middle(box)) / size;
            // Of the whole file's triangles, as they lie in the world, rather than of the node's own.
            const double away_in_world = length(center - middle(bounds_of(scene, node, {}))) / size;
            if (away < 1 && away < away_in_world + 0.1 && ratio > 0.4 && ratio < 2.5) continue;
            sentences.push_back(
                map.file.name + " does not fit node '" + map.node +
                "': it lies elsewhere or is of another size than the node's triangles. A map takes a "
                "node's place in the node's own space; was it baked from a file whose nodes are moved?");
            break;
        }
    }
    return sentences;
}

std::vector<PlacedMap> place_maps(const Scene& scene, const RenderArguments& arguments) {
    std::vector<PlacedMap> maps;
    for (const MapArgument& map : arguments.maps)
        maps.push_back({map.node,
                        {},
                        map.node.empty() ? std::vector{no_index}
                                         : find_nodes(scene, arguments.scene.string(), map.node)});
    check_apart(scene, maps);
    if (!arguments.uses_maps()) return {};
    for (std::size_t i = 0; i < maps.size(); ++i) maps[i].file = open_map(arguments.maps[i].file);
    return maps;
}

bool is_below(const Scene& scene, std::uint32_t node, std::uint32_t above) {
    for (node = scene.nodes[node].parent; node != no_index; node = scene.nodes[node].parent)
        if (node == above) return true;
    return false;
}

render::MapPlacement placement(std::uint32_t node, const SphericalMap* map,
                               const RenderArguments& arguments) {
    render::MapPlacement result;
    result.node = node;
    result.map = map;
    result.layers = arguments.layers;
    result.test_points = arguments.method != MapMethod::projective;
    result.dropped = map == nullptr;
    return result;
}

Camera choose_camera(const Scene& scene, const RenderArguments& arguments) {
    if (arguments.camera) return find_camera(scene, arguments.scene, *arguments.camera);
    if (!scene.cameras.empty()) return scene.cameras.front();
    const render::Settings& settings = arguments.settings;
    return framing_camera(scene.model, double(settings.width) / settings.height);
}

const Camera& find_camera(const Scene& scene, const std::filesystem::path& scene_path,
                          const std::string& camera) {
    const std::vector<Camera>& cameras = scene.cameras;
    const auto named = std::find_if(cameras.begin(), cameras.end(),
                                    [&](const Camera& other) { return other.name == camera; });
    if (named != cameras.end()) return *named;
    const std::optional<std::size_t> index = whole_number(camera);
    if (index && *index < cameras.size()) return cameras[*index];
    throw Error(ExitCode::usage,
                "--camera: there is no camera '" + camera + "' in " + scene_path.string() +
                    (cameras.empty() ? ", and no other" : suggestion(camera, names_of(cameras))));
}

namespace {

void check_apart(const Scene& scene, const std::vector<PlacedMap>& maps) {
    for (const PlacedMap& map : maps)
        if (map.replaces_scene() && maps.size() > 1)
            throw Error(ExitCode::usage, "--map: a map without NODE takes the place of the whole scene; give "
                                         "it alone, or a NODE to each");
    if (maps.size() < 2) return;
    for (const PlacedMap& map : maps)
        for (const PlacedMap& other : maps)
            for (const std::uint32_t node : map.nodes)
                for (const std::uint32_t above : other.nodes)
                    if (is_below(scene, node, above))
                        throw Error(ExitCode::usage, "--map: the node '" + map.node + "' lies below '" +
                                                         other.node +
                                                         "', which has a map too; leave one of them out");
}

struct Box {
    Vec3d low, high;
};

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Box no_box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

void grow(Box& box, Vec3d p) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
}

Vec3d middle(const Box& box) { return (box.low + box.high) * 0.5; }
double half_diagonal(const Box& box) { return length(box.high - box.low) / 2; }

Box bounds(const Model& model) {
    Box box = no_box;
    for (const Vec3f position : model.positions) grow(box, to_double(position));
    return box;
}

// Of what the node and those below it draw, in the space that `from_world` leads to.
Box bounds_of(const Scene& scene, std::uint32_t node, const Affine& from_world) {
    std::vector<bool> of_node(scene.nodes.size()); // a node comes behind its parent
    for (std::uint32_t i = node; i < scene.nodes.size(); ++i)
        of_node[i] = i == node || (scene.nodes[i].parent != no_index && of_node[scene.nodes[i].parent]);
    Box box = no_box;
    for (std::size_t i = 0; i < scene.model.triangles.size(); ++i) {
        if (!of_node[scene.triangle_nodes[i]]) continue;
        for (const std::uint32_t vertex : scene.model.triangles[i].vertex)
            grow(box, transform_point(from_world, to_double(scene.model.positions[vertex])));
    }
    return box;
}

// direction: in the camera's space; irradiance: of what faces it.
Light sun_along(const Camera& camera, Vec3d direction, double irradiance) {
    Light sun;
    sun.name = "sun";
    sun.kind = LightKind::directional;
    sun.direction = normalize(transform_vector(camera.to_world, direction));
    sun.intensity = to_float(Vec3d{irradiance, irradiance, irradiance});
    return sun;
}

// The box of the cubes whose corners lie on the parts' spheres: as large as an object that fills them.
Box sphere_bounds(const SphericalMap& map) {
    Box box = no_box;
    for (const Part& part : map.parts) {
        const double half = part.radius * std::cbrt(std::abs(determinant(part.frame))) / std::sqrt(3.0);
        grow(box, part.center - Vec3d{half, half, half});
        grow(box, part.center + Vec3d{half, half, half});
    }
    return box;
}

} // namespace

std::vector<std::uint32_t> find_nodes(const Scene& scene, const std::string& scene_name,
                                      const std::string& node) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].name == node) found.push_back(i);
    if (found.empty())
        throw Error(ExitCode::usage, "--map: there is no node '" + node + "' in " + scene_name +
                                         suggestion(node, names_of(scene.nodes)));
    std::vector<std::uint32_t> outermost;
    std::copy_if(found.begin(), found.end(), std::back_inserter(outermost), [&](std::uint32_t i) {
        return std::none_of(found.begin(), found.end(),
                            [&](std::uint32_t above) { return is_below(scene, i, above); });
    });
    return outermost;
}

std::vector<std::string> misfits(const Scene& scene, const std::vector<PlacedMap>& maps, bool is_posed) {
    std::vector<std::string> sentences;
    for (const PlacedMap& map : maps) {
        const std::vector<Part>& parts = map.file.map().parts;
        if (is_posed && std::any_of(parts.begin(), parts.end(), [](const Part& p) { return p.node >= 0; }))
            continue; // they stand where their nodes do
        const Box of_map = sphere_bounds(map.file.map());
        for (const std::uint32_t node : map.nodes) {
            if (node == no_index) continue; // it lies in the world, as the scene does
            const Box box = bounds_of(scene, node, inverse(scene.nodes[node].to_world));
            const Vec3d center = middle(of_map);
            const double size = half_diagonal(box);
            if (!(size > 0)) continue; // it draws nothing
            // A centre that was moved to see more lies off the middle, and its sphere is larger.
            const double ratio = half_diagonal(of_map) / size;
            const double away = length(center - middle(box)) / size;
            // Of the whole file's triangles, as they lie in the world, rather than of the node's own.
            const double away_in_world = length(center - middle(bounds_of(scene, node, {}))) / size;
            if (away < 1 && away < away_in_world + 0.1 && ratio > 0.4 && ratio < 2.5) continue;
            sentences.push_back(
                map.file.name + " does not fit node '" + map.node +
                "': it lies elsewhere or is of another size than the node's triangles. A map takes a "
                "node's place in the node's own space; was it baked from a file whose nodes are moved?");
            break;
        }
    }
    return sentences;
}

std::vector<PlacedMap> place_maps(const Scene& scene, const RenderArguments& arguments) {
    std::vector<PlacedMap> maps;
    for (const MapArgument& map : arguments.maps)
        maps.push_back({map.node,
                        {},
                        map.node.empty() ? std::vector{no_index}
                                         : find_nodes(scene, arguments.scene.string(), map.node)});
    check_apart(scene, maps);
    if (!arguments.uses_maps()) return {};
    for (std::size_t i = 0; i < maps.size(); ++i) maps[i].file = open_map(arguments.maps[i].file);
    return maps;
}

bool is_below(const Scene& scene, std::uint32_t node, std::uint32_t above) {
    for (node = scene.nodes[node].parent; node != no_index; node = scene.nodes[node].parent)
        if (node == above) return true;
    return false;
}

render::MapPlacement placement(std::uint32_t node, const SphericalMap* map,
                               const RenderArguments& arguments) {
    render::MapPlacement result;
    result.node = node;
    result.map = map;
    result.layers = arguments.layers;
    result.test_points = arguments.method != MapMethod::projective;
    result.dropped = map == nullptr;
    return result;
}

Camera choose_camera(const Scene& scene, const RenderArguments& arguments) {
    if (arguments.camera) return find_camera(scene, arguments.scene, *arguments.camera);
    if (!scene.cameras.empty()) return scene.cameras.front();
    const render::Settings& settings = arguments.settings;
    return framing_camera(scene.model, double(settings.width) / settings.height);
}

const Camera& find_camera(const Scene& scene, const std::filesystem::path& scene_path,
                          const std::string& camera) {
    const std::vector<Camera>& cameras = scene.cameras;
    const auto named = std::find_if(cameras.begin(), cameras.end(),
                                    [&](const Camera& other) { return other.name == camera; });
    if (named != cameras.end()) return *named;
    const std::optional<std::size_t> index = whole_number(camera);
    if (index && *index < cameras.size()) return cameras[*index];
    throw Error(ExitCode::usage,
                "--camera: there is no camera '" + camera + "' in " + scene_path.string() +
                    (cameras.empty() ? ", and no other" : suggestion(camera, names_of(cameras))));
}

namespace {

// backward: unit, from the scene to the camera; not straight up or down.
Camera camera_from(Vec3d backward, const Model& model, double aspect) {
    constexpr double margin = 1.08; // a little more than what has to be seen
    Camera camera;
    camera.name = "framing";
    camera.vertical_fov = 35 * std::numbers::pi / 180;
    const Vec3d right = normalize(cross(Vec3d{0, 1, 0}, backward));
    const Vec3d up = cross(backward, right);
    const double tan_y = std::tan(camera.vertical_fov / 2) / margin, tan_x = tan_y * aspect;
    const Box box = bounds(model);
    const Vec3d center = (box.low + box.high) * 0.5;
    // Every corner of the box is to lie between the planes of the frustum.
    double distance = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vec3d p =
            Vec3d{(corner & 1U) != 0 ? box.high.x : box.low.x, (corner & 2U) != 0 ? box.high.y : box.low.y,
                  (corner & 4U) != 0 ? box.high.z : box.low.z} -
            center;
        const double aside = std::max(std::abs(dot(p, right)) / tan_x, std::abs(dot(p, up)) / tan_y);
        distance = std::max(distance, dot(p, backward) + aside);
    }
    camera.to_world.linear = transpose({{right, up, backward}});
    camera.to_world.translation = center + backward * distance;
    return camera;
}

Vec3d from_the_front() { return normalize(Vec3d{0.55, 0.45, 1}); }

} // namespace

Camera framing_camera(const Model& model, double aspect) {
    return camera_from(from_the_front(), model, aspect);
}

std::vector<Camera> surrounding_cameras(const Model& model, double aspect, std::uint32_t count) {
    std::vector<Camera> cameras;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        const double c = std::cos(angle), s = std::sin(angle);
        const Vec3d f = from_the_front();
        cameras.push_back(camera_from({f.x * c + f.z * s, f.y, f.z * c - f.x * s}, model, aspect));
        cameras.back().name = "view " + std::to_string(i + 1);
    }
    cameras.front().name = "framing";
    return cameras;
}

Light default_sun(const Camera& camera) { return sun_along(camera, {1, -1.5, -1}, std::numbers::pi); }

Light default_fill(const Camera& camera) { return sun_along(camera, {-1, -0.4, -1}, std::numbers::pi / 3); }

} // namespace spa::tools
