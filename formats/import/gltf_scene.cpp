// SPDX-License-Identifier: Apache-2.0
#include "gltf_scene.h"

#include "readers.h"

#include <algorithm>
#include <array>

namespace spa::import::gltf {
namespace {

struct Quaternion {
    double x = 0, y = 0, z = 0, w = 1;
};

Affine from_trs(Vec3d t, Quaternion q, Vec3d s) {
    const double norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    const double k = norm > 0 ? 2.0 / norm : 0.0; // any length, so normalised here
    Affine map;
    map.linear.row[0] = {1 - k * (q.y * q.y + q.z * q.z), k * (q.x * q.y - q.z * q.w),
                         k * (q.x * q.z + q.y * q.w)};
    map.linear.row[1] = {k * (q.x * q.y + q.z * q.w), 1 - k * (q.x * q.x + q.z * q.z),
                         k * (q.y * q.z - q.x * q.w)};
    map.linear.row[2] = {k * (q.x * q.z - q.y * q.w), k * (q.y * q.z + q.x * q.w),
                         1 - k * (q.x * q.x + q.y * q.y)};
    for (Vec3d& row : map.linear.row) row = {row.x * s.x, row.y * s.y, row.z * s.z};
    map.translation = t;
    return map;
}

Affine local_transform(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) { // column-major
        const std::vector<double>& m = node.matrix;
        Affine map;
        for (std::size_t i = 0; i < 3; ++i) map.linear.row[i] = {m[i], m[4 + i], m[8 + i]};
        map.translation = {m[12], m[13], m[14]};
        return map;
    }
    Vec3d t{}, s{1, 1, 1};
    Quaternion q;
    if (node.translation.size() == 3) t = {node.translation[0], node.translation[1], node.translation[2]};
    if (node.rotation.size() == 4)
        q = {node.rotation[0], node.rotation[1], node.rotation[2], node.rotation[3]};
    if (node.scale.size() == 3) s = {node.scale[0], node.scale[1], node.scale[2]};
    return from_trs(t, q, s);
}

[[noreturn]] void refuse_drawings(const Context& context) {
    fail(context, "nodes",
         "shared children and instances multiply to more than " + std::to_string(max_nodes) + " drawings");
}

// The transforms of EXT_mesh_gpu_instancing, relative to the node.
// Throws Error(invalid_data) for more than `most` of them.
std::vector<Affine> gpu_instances(const tinygltf::Model& model, const tinygltf::Value& extension,
                                  Buffers& buffers, std::size_t most, const Context& context) {
    const tinygltf::Value& attributes = extension.Get("attributes");
    std::vector<std::array<float, 3>> translations, scales;
    std::vector<std::array<float, 4>> rotations;
    std::size_t count = 0;
    const auto accessor_of = [&](const char* name) -> const tinygltf::Accessor* {
        if (!attributes.Has(name)) return nullptr;
        return &model.accessors[static_cast<std::size_t>(attributes.Get(name).GetNumberAsInt())];
    };
    const auto read = [&](const char* name, auto& values) {
        const tinygltf::Accessor* accessor = accessor_of(name);
        if (accessor == nullptr) return;
        count = accessor->count;
        if (count > most) refuse_drawings(context);
        values.resize(count);
        read_floats(*accessor, buffers, {}, values[0].size(), values[0].data(), values[0].size(), context);
    };
    read("TRANSLATION", translations);
    read("ROTATION", rotations);
    read("SCALE", scales);
    std::vector<Affine> out(count);
    for (std::size_t i = 0; i < count; ++i) {
        Vec3d t{}, s{1, 1, 1};
        Quaternion q;
        if (!translations.empty()) t = {translations[i][0], translations[i][1], translations[i][2]};
        if (!rotations.empty()) q = {rotations[i][0], rotations[i][1], rotations[i][2], rotations[i][3]};
        if (!scales.empty()) s = {scales[i][0], scales[i][1], scales[i][2]};
        out[i] = from_trs(t, q, s);
    }
    return out;
}

std::vector<std::size_t> roots_of(const tinygltf::Model& model) {
    std::vector<bool> below(model.nodes.size());
    std::vector<std::size_t> listed;
    if (model.scenes.empty()) {
        for (const tinygltf::Node& node : model.nodes)
            for (const int child : node.children) below[static_cast<std::size_t>(child)] = true;
        for (std::size_t i = 0; i < model.nodes.size(); ++i) listed.push_back(i);
    } else {
        const auto scene = static_cast<std::size_t>(std::max(model.defaultScene, 0));
        for (const int node : model.scenes[scene].nodes) listed.push_back(static_cast<std::size_t>(node));
        // Marks what lies below the listed nodes; each node is expanded once.
        std::vector<std::size_t> stack = listed;
        while (!stack.empty()) {
            const std::size_t node = stack.back();
            stack.pop_back();
            for (const int value : model.nodes[node].children) {
                const auto child = static_cast<std::size_t>(value);
                if (!below[child]) stack.push_back(child);
                below[child] = true;
            }
        }
    }
    std::vector<std::size_t> roots;
    for (const std::size_t node : listed) {
        if (below[node]) continue;
        roots.push_back(node);
        below[node] = true; // listed twice, drawn once
    }
    return roots;
}

} // namespace

std::vector<Instance> flatten_scene(const tinygltf::Model& model, Buffers& buffers, const Context& context,
                                    std::vector<Place>* places) {
    std::vector<Place> stack;
    const auto push = [&](std::size_t node, std::uint32_t parent, const Affine& world) {
        stack.push_back({node, parent, world * local_transform(model.nodes[node])});
    };
    // The number of the place; 0 if nobody wants them.
    const auto note = [&](const Place& place) {
        if (places == nullptr) return std::uint32_t{0};
        places->push_back(place);
        return static_cast<std::uint32_t>(places->size() - 1);
    };
    const std::vector<std::size_t> roots = roots_of(model);
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) push(*root, no_index, {});

    std::vector<Instance> instances;
    std::size_t visits = 0;
    while (!stack.empty()) {
        const Place visit = stack.back();
        stack.pop_back();
        const std::uint32_t own = note(visit);
        const tinygltf::Node& node = model.nodes[visit.node];
        ++visits;
        if (node.mesh >= 0) {
            const auto extension = node.extensions.find("EXT_mesh_gpu_instancing");
            if (extension == node.extensions.end()) {
                instances.push_back({visit.node, visit.world, own});
            } else {
                const std::size_t most = max_nodes - std::min(max_nodes, visits + instances.size());
                for (const Affine& local : gpu_instances(model, extension->second, buffers, most, context)) {
                    const Affine world = visit.world * local;
                    instances.push_back({visit.node, world, note({visit.node, own, world, true})});
                }
            }
        }
        if (visits + stack.size() + instances.size() > max_nodes) refuse_drawings(context);
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            push(static_cast<std::size_t>(*child), own, visit.world);
    }
    return instances;
}

std::vector<Affine> global_transforms(const tinygltf::Model& model) {
    constexpr std::size_t none = static_cast<std::size_t>(-1);
    std::vector<std::size_t> parent(model.nodes.size(), none);
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
        for (const int child : model.nodes[i].children)
            if (parent[static_cast<std::size_t>(child)] == none) parent[static_cast<std::size_t>(child)] = i;

    std::vector<Affine> globals(model.nodes.size());
    std::vector<bool> known(model.nodes.size());
    std::vector<std::size_t> chain;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        chain.clear();
        for (std::size_t node = i; node != none && !known[node]; node = parent[node]) chain.push_back(node);
        for (auto node = chain.rbegin(); node != chain.rend(); ++node) {
            const Affine local = local_transform(model.nodes[*node]);
            globals[*node] = parent[*node] == none ? local : globals[parent[*node]] * local;
            known[*node] = true;
        }
    }
    return globals;
}

} // namespace spa::import::gltf
