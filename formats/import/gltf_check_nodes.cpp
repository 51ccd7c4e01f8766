// SPDX-License-Identifier: Apache-2.0
// The node hierarchy: transforms, loops, depth, several parents, scenes.
#include "gltf_check.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace spa::import::gltf {
namespace {

void check_transform(const Json& node, const std::string& where, const Context& context) {
    if (node.contains("matrix")) {
        const Json& matrix = node["matrix"]; // column-major
        const double row[] = {matrix[3], matrix[7], matrix[11], matrix[15]};
        constexpr double slack = 1e-6;
        if (std::abs(row[0]) > slack || std::abs(row[1]) > slack || std::abs(row[2]) > slack ||
            std::abs(row[3] - 1.0) > slack)
            fail(context, where + ".matrix", "is not affine: its last row is not 0 0 0 1");
        for (const char* other : {"translation", "rotation", "scale"})
            if (node.contains(other))
                warn(context, where, std::string("has a matrix; its ") + other + " is ignored");
    }
    if (node.contains("rotation")) {
        double square = 0;
        for (const Json& value : node["rotation"]) square += value.get<double>() * value.get<double>();
        if (square == 0 || !std::isfinite(square)) fail(context, where + ".rotation", "is no quaternion");
        if (std::abs(square - 1.0) > 1e-2) warn(context, where + ".rotation", "is not of unit length");
    }
}

// Depth-first with an explicit stack: each node is entered once, so shared children cost nothing.
class LoopFinder {
public:
    LoopFinder(const Json& nodes, const Context& context)
        : nodes_(nodes), context_(context), state_(nodes.size(), State::unseen), height_(nodes.size()) {}

    void visit(std::size_t root) {
        if (state_[root] != State::unseen) return;
        std::vector<Frame> stack;
        enter(root, stack);
        while (!stack.empty()) {
            Frame& frame = stack.back();
            const Json& children = member_of(nodes_[frame.node], "children");
            if (frame.next == children.size()) {
                leave(stack);
                continue;
            }
            const auto child = children[frame.next++].get<std::size_t>();
            if (state_[child] == State::open)
                fail(context_, at("nodes", frame.node) + ".children",
                     "node " + std::to_string(child) + " is its own descendant: a loop");
            if (state_[child] == State::unseen)
                enter(child, stack);
            else
                raise(stack.back().node, height_[child] + 1);
        }
    }

private:
    enum class State : unsigned char { unseen, open, done };
    struct Frame {
        std::size_t node = 0, next = 0;
    };
    const Json& nodes_;
    const Context& context_;
    std::vector<State> state_;
    std::vector<std::uint32_t> height_; // of the tree below

    void enter(std::size_t node, std::vector<Frame>& stack) {
        state_[node] = State::open;
        height_[node] = 1;
        stack.push_back({node, 0});
    }
    void leave(std::vector<Frame>& stack) {
        const std::size_t node = stack.back().node;
        state_[node] = State::done;
        stack.pop_back();
        if (!stack.empty()) raise(stack.back().node, height_[node] + 1);
    }
    void raise(std::size_t node, std::uint32_t height) {
        if (height > height_[node]) height_[node] = height;
        if (height > context_.limits.node_depth)
            fail(context_, at("nodes", node),
                 "the hierarchy below is deeper than the limit of " +
                     std::to_string(context_.limits.node_depth));
    }
};

} // namespace

void check_nodes(const Json& document, const Context& context) {
    const Json& nodes = member_of(document, "nodes");
    std::vector<std::size_t> parent(nodes.size(), nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        check_transform(nodes[i], at("nodes", i), context);
        if (nodes[i].contains("skin") && !nodes[i].contains("mesh"))
            warn(context, at("nodes", i), "has a skin but no mesh");
        for (const Json& value : member_of(nodes[i], "children")) {
            const auto child = value.get<std::size_t>();
            if (parent[child] != nodes.size())
                warn(context, at("nodes", child), "has more than one parent: it is drawn below each");
            parent[child] = i;
        }
    }
    LoopFinder finder(nodes, context);
    for (std::size_t i = 0; i < nodes.size(); ++i) finder.visit(i);

    std::vector<bool> skinned; // by mesh: many nodes may share one
    for (const Json& mesh : member_of(document, "meshes"))
        skinned.push_back(
            std::any_of(mesh["primitives"].begin(), mesh["primitives"].end(),
                        [](const Json& primitive) { return primitive["attributes"].contains("JOINTS_0"); }));
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!nodes[i].contains("skin") || !nodes[i].contains("mesh")) continue;
        if (!skinned[integer_of(nodes[i], "mesh")])
            warn(context, at("nodes", i), "has a skin, but its mesh has no JOINTS_0 and WEIGHTS_0");
    }
}

void check_scenes(const Json& document, const Context& context) {
    const Json& nodes = member_of(document, "nodes");
    std::vector<bool> is_child(nodes.size());
    for (const Json& node : nodes)
        for (const Json& child : member_of(node, "children")) is_child[child.get<std::size_t>()] = true;
    const Json& scenes = member_of(document, "scenes");
    for (std::size_t i = 0; i < scenes.size(); ++i)
        for (const Json& value : member_of(scenes[i], "nodes")) {
            const auto node = value.get<std::size_t>();
            if (is_child[node])
                warn(context, at("scenes", i) + ".nodes", "node " + std::to_string(node) + " is not a root");
        }
}

} // namespace spa::import::gltf
