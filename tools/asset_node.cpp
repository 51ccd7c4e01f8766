// SPDX-License-Identifier: Apache-2.0
#include "asset_node.h"

#include "near_names.h"

#include "../libspa/core/error.h"
#include "../libspa/mesh/node_model.h"

#include <algorithm>
#include <charconv>
#include <utility>
#include <vector>

namespace spa::tools {

namespace {

bool is_number(const std::string& text) {
    return !text.empty() &&
           std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::uint32_t node_of_index(const Scene& scene, const std::string& text, const std::string& option) {
    std::uint32_t index = no_index;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error == std::errc{} && index < scene.nodes.size()) return index;
    throw Error(ExitCode::usage, option + ": there is no node " + text + "; there are " +
                                     std::to_string(scene.nodes.size()) + ", counted from 0");
}

} // namespace

NodeChoice choose_node(const Scene& scene, const std::string& text, const std::string& option) {
    if (is_number(text)) return {node_of_index(scene, text, option), {}};
    const auto has_name = [&](const SceneNode& node) { return node.name == text; };
    const auto found = std::find_if(scene.nodes.begin(), scene.nodes.end(), has_name);
    if (text.empty() || found == scene.nodes.end()) {
        std::vector<std::string> names;
        for (const SceneNode& node : scene.nodes)
            if (!node.name.empty()) names.push_back(node.name);
        throw Error(ExitCode::usage,
                    option + ": there is no node '" + text + "'" + did_you_mean(text, names));
    }
    NodeChoice choice{std::uint32_t(found - scene.nodes.begin()), {}};
    const auto count = std::count_if(found, scene.nodes.end(), has_name);
    if (count > 1)
        choice.warning = option + ": " + std::to_string(count) + " nodes have the name '" + text +
                         "'; the first is taken, number " + std::to_string(choice.node);
    return choice;
}

AssetModel read_asset_model(const std::filesystem::path& path, const std::optional<std::string>& node,
                            const import::Limits& limits) {
    AssetModel result;
    if (!node) {
        result.source = import::read_model(path, limits);
        return result;
    }
    import::SceneResult read = import::read_scene(path, limits);
    try {
        NodeChoice choice = choose_node(read.scene, *node, "--node");
        result.node = choice.node;
        result.node_name = read.scene.nodes[choice.node].name;
        if (!choice.warning.empty()) result.warning = path.string() + ": " + choice.warning;
        result.source = {node_model(read.scene, choice.node), std::move(read.report)};
    } catch (const Error& error) {
        throw Error(error.code(), path.string() + ": " + error.what());
    }
    return result;
}

} // namespace spa::tools
