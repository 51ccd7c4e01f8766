// SPDX-License-Identifier: Apache-2.0
// A scene as binary glTF: nodes, meshes in their local spaces, cameras, lights.
#include "glb_writer.h"
#include "scenes.h"

#include "../libspa/core/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace spa::samples {
namespace {

using Json = GlbWriter::Json;

constexpr const char* lights_extension = "KHR_lights_punctual";

[[noreturn]] void fail(const std::string& what) {
    throw Error(ExitCode::internal, "GLB writer: the scene " + what);
}

void check(const Scene& scene) {
    if (scene.triangle_nodes.size() != scene.model.triangles.size()) fail("lacks nodes of triangles");
    for (const std::uint32_t node : scene.triangle_nodes)
        if (node >= scene.nodes.size()) fail("has a node index out of range");
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (scene.nodes[i].parent != no_index && scene.nodes[i].parent >= i)
            fail("has a node before its parent");
}

Affine inverse_of(const SceneNode& node) {
    const double size = determinant(node.to_world.linear);
    if (size == 0 || !std::isfinite(size)) fail("has the node '" + node.name + "' without an inverse");
    return inverse(node.to_world);
}

Json matrix_of(const Affine& map) { // column-major
    Json matrix = Json::array();
    const Mat3 columns = transpose(map.linear);
    for (const Vec3d& c : columns.row)
        for (const double value : {c.x, c.y, c.z, 0.0}) matrix.push_back(value);
    for (const double value : {map.translation.x, map.translation.y, map.translation.z, 1.0})
        matrix.push_back(value);
    return matrix;
}

// The triangles of one node after the other, as meshes of their own.
class NodeMeshes {
public:
    explicit NodeMeshes(const Scene& scene)
        : scene_(scene), triangles_(scene.nodes.size()), number_(scene.model.positions.size(), no_index) {
        for (std::uint32_t i = 0; i < scene.triangle_nodes.size(); ++i)
            triangles_[scene.triangle_nodes[i]].push_back(i);
    }

    [[nodiscard]] bool has_mesh(std::size_t node) const { return !triangles_[node].empty(); }

    // In the local space of the node; vertices in the order of the scene.
    Model mesh_of(std::size_t node) {
        const Model& all = scene_.model;
        const Affine to_local = inverse_of(scene_.nodes[node]);
        const Mat3 normals_to_local = normal_matrix(to_local.linear);
        const bool is_mirrored = determinant(to_local.linear) < 0;
        Model mesh;
        std::vector<std::uint32_t> used;
        bool is_textured = false;
        for (const std::uint32_t i : triangles_[node]) {
            if (i >= all.triangle_materials.size() || all.triangle_materials[i] >= all.materials.size())
                fail("has a material index out of range");
            is_textured = is_textured || all.materials[all.triangle_materials[i]].texture != no_index;
            for (const std::uint32_t v : all.triangles[i].vertex) {
                if (v >= number_.size()) fail("has a vertex index out of range");
                if (number_[v] == no_index) used.push_back(v);
                number_[v] = 0;
            }
        }
        std::sort(used.begin(), used.end());
        for (std::uint32_t k = 0; k < used.size(); ++k) {
            const std::uint32_t v = used[k];
            number_[v] = k;
            mesh.positions.push_back(to_float(transform_point(to_local, to_double(all.positions[v]))));
            if (!all.normals.empty())
                mesh.normals.push_back(to_float(normalize(normals_to_local * to_double(all.normals.at(v)))));
            if (is_textured && !all.uvs.empty()) mesh.uvs.push_back(all.uvs.at(v));
            if (!all.colors.empty()) mesh.colors.push_back(all.colors.at(v));
        }
        for (const std::uint32_t i : triangles_[node]) {
            auto [a, b, c] = all.triangles[i].vertex;
            if (is_mirrored) std::swap(b, c);
            mesh.triangles.push_back({{number_[a], number_[b], number_[c]}});
            mesh.triangle_materials.push_back(all.triangle_materials[i]);
        }
        for (const std::uint32_t v : used) number_[v] = no_index;
        return mesh;
    }

private:
    const Scene& scene_;
    std::vector<std::vector<std::uint32_t>> triangles_; // of each node
    std::vector<std::uint32_t> number_;                 // of a vertex in the mesh; no_index: not in it
};

class Writer {
public:
    explicit Writer(const Scene& scene) : scene_(scene), glb_(scene.model.materials, scene.model.textures) {}

    std::vector<std::byte> write() && {
        check(scene_);
        for (const SceneNode& node : scene_.nodes) add_node(node);
        for (const Camera& camera : scene_.cameras) add_camera(camera);
        for (const Light& light : scene_.lights) add_light(light);
        glb_.json["asset"] = {{"version", "2.0"}, {"generator", "spa sample"}};
        if (!lights_.empty()) {
            glb_.json["extensionsUsed"] = {lights_extension};
            glb_.json["extensions"] = {{lights_extension, {{"lights", lights_}}}};
        }
        glb_.json["scene"] = 0;
        glb_.json["scenes"] = Json::array({{{"nodes", roots_}}});
        add_meshes();
        glb_.json["nodes"] = std::move(nodes_);
        if (!cameras_.empty()) glb_.json["cameras"] = std::move(cameras_);
        return std::move(glb_).finish();
    }

private:
    static Json new_node(const std::string& name, const Affine& local) {
        Json node = Json::object();
        if (!name.empty()) node["name"] = name;
        if (!(local == Affine{})) node["matrix"] = matrix_of(local);
        return node;
    }

    void add_node(const SceneNode& node) {
        const std::size_t number = nodes_.size();
        if (node.parent == no_index) {
            nodes_.push_back(new_node(node.name, node.to_world));
            roots_.push_back(number);
            return;
        }
        nodes_.push_back(new_node(node.name, inverse_of(scene_.nodes[node.parent]) * node.to_world));
        nodes_[node.parent]["children"].push_back(number);
    }

    void add_meshes() {
        NodeMeshes meshes(scene_);
        for (std::size_t node = 0; node < scene_.nodes.size(); ++node)
            if (meshes.has_mesh(node)) nodes_[node]["mesh"] = glb_.add_mesh(meshes.mesh_of(node));
    }

    // The node of this name that `is_there`, without the member `key` so far; else a new root.
    template <class IsThere>
    Json& carrier(const std::string& name, const char* key, const Affine& to_world, IsThere is_there) {
        for (std::size_t i = 0; i < scene_.nodes.size(); ++i)
            if (scene_.nodes[i].name == name && is_there(scene_.nodes[i].to_world) &&
                !nodes_[i].contains(key))
                return nodes_[i];
        roots_.push_back(nodes_.size());
        nodes_.push_back(new_node(name, to_world));
        return nodes_.back();
    }

    void add_camera(const Camera& camera) {
        Json& node = carrier(camera.name, "camera", camera.to_world,
                             [&](const Affine& place) { return place == camera.to_world; });
        node["camera"] = cameras_.size();
        constexpr double near = 0.01; // glTF wants one
        Json entry = Json::object();
        if (!camera.name.empty()) entry["name"] = camera.name;
        entry["type"] = "perspective";
        entry["perspective"] = {{"yfov", camera.vertical_fov}, {"znear", near}};
        cameras_.push_back(std::move(entry));
    }

    void add_light(const Light& light) {
        // Any turn that takes -Z to the direction.
        const Vec3d back = -light.direction;
        const Vec3d aside = std::abs(back.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0};
        const Vec3d right = normalize(cross(aside, back));
        const bool is_point = light.kind == LightKind::point;
        Affine place{{}, light.position};
        if (!is_point) place.linear = transpose({{right, cross(back, right), back}});
        Json& node = carrier(light.name, "extensions", place, [&](const Affine& to_world) {
            const Vec3d way = normalize(transform_vector(to_world, {0, 0, -1}));
            return to_world.translation == light.position && (is_point || way == light.direction);
        });
        node["extensions"] = {{lights_extension, {{"light", lights_.size()}}}};

        Json entry = Json::object();
        if (!light.name.empty()) entry["name"] = light.name;
        entry["type"] = is_point ? "point" : light.kind == LightKind::spot ? "spot" : "directional";
        const Vec3f rgb = light.intensity;
        const float most = std::max({rgb.x, rgb.y, rgb.z}); // a colour is at most 1
        if (!(rgb == Vec3f{most, most, most}))
            entry["color"] = {double(rgb.x) / double(most), double(rgb.y) / double(most),
                              double(rgb.z) / double(most)};
        entry["intensity"] = most;
        if (light.kind == LightKind::spot)
            entry["spot"] = {{"innerConeAngle", light.inner_cone}, {"outerConeAngle", light.outer_cone}};
        lights_.push_back(std::move(entry));
    }

    const Scene& scene_;
    GlbWriter glb_;
    Json nodes_ = Json::array(), roots_ = Json::array(), cameras_ = Json::array(), lights_ = Json::array();
};

} // namespace

std::vector<std::byte> to_glb(const Scene& scene) { return Writer(scene).write(); }

} // namespace spa::samples
