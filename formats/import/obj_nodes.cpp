// SPDX-License-Identifier: Apache-2.0
#include "obj_nodes.h"

#include "readers.h"
#include "text.h"

namespace spa::import {

void ObjNodes::begin_object(std::string_view name) {
    object_ = name;
    group_.clear();
    is_new_ = true;
}

void ObjNodes::begin_group(std::string_view name) {
    group_ = name;
    is_new_ = true;
}

void ObjNodes::add_polygon(PolygonSoup& soup) {
    if (!is_new_) return;
    is_new_ = false;
    std::uint32_t node = no_index;
    if (!object_.empty()) node = node_of(no_index, object_);
    if (!group_.empty()) node = node_of(node, group_);
    if (node == no_index) node = node_of(no_index, path_.stem().string());
    if (soup.runs.empty() || soup.runs.back().node != node) soup.runs.push_back({soup.polygons.size(), node});
}

std::uint32_t ObjNodes::node_of(std::uint32_t parent, const std::string& name) {
    const auto [entry, is_new] = known_.try_emplace({parent, name}, std::uint32_t(nodes_.size()));
    if (!is_new) return entry->second;
    if (nodes_.size() >= max_nodes)
        fail(path_, "has more than " + std::to_string(max_nodes) + " objects and groups; join some");
    nodes_.push_back({name, parent, {}});
    return entry->second;
}

} // namespace spa::import
