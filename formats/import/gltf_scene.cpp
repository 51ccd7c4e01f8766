// SPDX-License-Identifier: Apache-2.0
#include "gltf_scene.h"

#include "readers.h"

#include <algorithm>
#include <array>

namespace spa::import::gltf {
namespace {

Affine local_transform(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) { // column-major
        const std::vector<double>& m = node.matrix;
        Affine map;
        for (std::size_t i = 0; i < 3; ++i) map.linear.row[i] = {m[i], m[4 + i], m[8 + i]};
        map.translation = {m[12], m[13], m[14]};
        return map;
    }
    const LocalParts parts = local_parts(node);
    return from_trs(parts.translation, parts.rotation, parts.scale);
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

LocalParts local_parts(const tinygltf::Node& node) {
    LocalParts parts;
    const std::vector<double>&t = node.translation, &q = node.rotation, &s = node.scale;
    if (t.size() == 3) parts.translation = {t[0], t[1], t[2]};
    if (q.size() == 4) parts.rotation = {q[0], q[1], q[2], q[3]};
    if (s.size() == 3) parts.scale = {s[0], s[1], s[2]};
    return parts;
}

std::vector<Instance> flatten_scene(const tinygltf::Model& model, Buffers& buffers, const Context& context,
                                    std::vector<Place>* places) {
    std::vector<Place> stack;
    const auto push = [&](std::size_t node, std::uint32_t parent, const Affine& world) {
        const Affine local = local_transform(model.nodes[node]);
        stack.push_back({node, parent, world * local, local});
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
                    instances.push_back(
                        {visit.node, world, note({visit.node, own, world, local, Place::Kind::instance})});
                }
            }
        }
        if (visits + stack.size() + instances.size() > max_nodes) refuse_drawings(context);
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            push(static_cast<std::size_t>(*child), own, visit.world);
    }
    return instances;
}

std::vector<std::uint32_t> first_parents(const tinygltf::Model& model) {
    std::vector<std::uint32_t> parent(model.nodes.size(), no_index);
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
        for (const int value : model.nodes[i].children) {
            std::uint32_t& of_child = parent[static_cast<std::size_t>(value)];
            if (of_child == no_index) of_child = static_cast<std::uint32_t>(i);
        }
    return parent;
}

std::vector<Affine> global_transforms(const tinygltf::Model& model) {
    const std::vector<std::uint32_t> parent = first_parents(model);
    std::vector<Affine> globals(model.nodes.size());
    std::vector<bool> known(model.nodes.size());
    std::vector<std::uint32_t> chain;
    for (std::uint32_t i = 0; i < model.nodes.size(); ++i) {
        chain.clear();
        for (std::uint32_t node = i; node != no_index && !known[node]; node = parent[node])
            chain.push_back(node);
        for (auto node = chain.rbegin(); node != chain.rend(); ++node) {
            const Affine local = local_transform(model.nodes[*node]);
            globals[*node] = parent[*node] == no_index ? local : globals[parent[*node]] * local;
            known[*node] = true;
        }
    }
    return globals;
}

std::vector<std::uint32_t> place_along_first_parents(const tinygltf::Model& model,
                                                     std::span<const std::uint32_t> wanted,
                                                     std::vector<Place>& places) {
    const std::vector<std::uint32_t> parent = first_parents(model);
    std::vector<std::uint32_t> place_of(model.nodes.size(), no_index);
    for (std::uint32_t i = 0; i < places.size(); ++i) { // parents first
        const Place& place = places[i];
        const std::uint32_t above = parent[place.node] == no_index ? no_index : place_of[parent[place.node]];
        if (place.kind == Place::Kind::node && place.parent == above &&
            (above != no_index || parent[place.node] == no_index))
            place_of[place.node] = i;
    }
    std::vector<std::uint32_t> chain, out;
    for (const std::uint32_t node : wanted) {
        chain.clear();
        for (std::uint32_t up = node; up != no_index && place_of[up] == no_index; up = parent[up])
            chain.push_back(up);
        for (auto next = chain.rbegin(); next != chain.rend(); ++next) {
            Place place{*next, no_index, local_transform(model.nodes[*next])};
            place.local = place.world;
            if (parent[*next] != no_index) {
                place.parent = place_of[parent[*next]];
                place.world = places[place.parent].world * place.local;
            }
            place.kind = Place::Kind::outside;
            place_of[*next] = static_cast<std::uint32_t>(places.size());
            places.push_back(place);
        }
        out.push_back(place_of[node]);
    }
    return out;
}

} // namespace spa::import::gltf
