// SPDX-License-Identifier: Apache-2.0
// An asset as the model that is baked or measured: as a whole, or what one of its nodes draws (--node).
#pragma once

#include "../formats/import/import.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace spa::tools {

struct AssetModel {
    import::Result source;             // the report is that of the whole file
    std::optional<std::uint32_t> node; // index into the nodes as import::read_scene lists them
    std::string node_name;
    std::string warning; // about the choice; empty: none
};

// node: a whole number is an index into the nodes as import::read_scene lists them, anything else the name of
// one; of several with that name the first is taken, with a warning. No node: the whole asset in its own
// space. Throws Error as read_model and node_model do, and Error{usage} if there is no such node; messages
// begin with the path.
AssetModel read_asset_model(const std::filesystem::path& path, const std::optional<std::string>& node,
                            const import::Limits& limits);

// The node of a scene that the text means, as above. option: what the message begins with.
struct NodeChoice {
    std::uint32_t node = 0;
    std::string warning;
};
NodeChoice choose_node(const Scene& scene, const std::string& text, const std::string& option);

} // namespace spa::tools
