// SPDX-License-Identifier: Apache-2.0
// The objects and groups of an OBJ file as the nodes of a scene.
#pragma once

#include "../../libspa/mesh/scene.h"
#include "polygon_soup.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace spa::import {

// An object is a root, a group a node below the object that it stands in, or a root where there is none. A
// name that comes again at the same place is the same node. A node is made with its first face.
class ObjNodes {
public:
    explicit ObjNodes(const std::filesystem::path& path) : path_(path) {}

    void begin_object(std::string_view name); // ends the group
    void begin_group(std::string_view name);  // may be several names: they stay together

    // Before the polygon is added: begins a run of the soup where the node is another one. Throws
    // Error(invalid_data) if there are too many nodes.
    void add_polygon(PolygonSoup& soup);

    std::vector<SceneNode> take() { return std::move(nodes_); }

private:
    std::uint32_t node_of(std::uint32_t parent, const std::string& name);

    const std::filesystem::path& path_;
    std::string object_, group_;
    bool is_new_ = true; // object_ or group_ since the last polygon
    std::vector<SceneNode> nodes_;
    std::map<std::pair<std::uint32_t, std::string>, std::uint32_t> known_; // by parent and name
};

} // namespace spa::import
