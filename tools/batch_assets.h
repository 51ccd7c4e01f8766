// SPDX-License-Identifier: Apache-2.0
// Which assets a batch has, and where their maps go.
#pragma once

#include "batch_config.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace spa::tools {

// One of `count` shares of the assets. An asset is in the share that the hash of its name says, so that
// machines need not agree on anything, not even on seeing the same files.
struct Shard {
    std::uint32_t index = 1; // 1..count
    std::uint32_t count = 1;
};

struct AssetQuery {
    std::vector<std::string> inputs;           // folders, files, "@list", "-"
    std::filesystem::path output;              // folder
    std::vector<std::string> include, exclude; // patterns (glob.h); no include: all
    bool follow_links = false;
    std::optional<Shard> shard;
};

struct BatchAsset {
    std::string name;             // path below its input folder, with '/'; any bytes
    std::filesystem::path path;   // to open
    std::filesystem::path output; // of the map
    std::uint64_t bytes = 0;      // of the file itself
    std::string problem;          // not empty: it cannot be baked, and why
    // Of a plan's object: the node that is baked, an index as import::read_scene has it, and its settings.
    std::optional<std::uint32_t> node{};
    GivenSettings settings{};
};

struct AssetList {
    std::vector<BatchAsset> assets; // sorted by name, bytewise
    std::vector<std::string> warnings;
};

// Lists the inputs:
// - A folder: all files below it with the extension of an asset, hidden ones too. The map of props/boot.glb
//   goes to OUTPUT/props/boot.spa.
// - A file: that file, whatever its extension; its map goes to OUTPUT/NAME.spa.
// - "@list", or "-" for standard input: one path a line, or ended by zero bytes if there is one; a relative
// path
//   keeps its folders below OUTPUT, an absolute one and one with ".." is placed like a file.
// Assets whose maps would have the same name, such as boot.obj and boot.glb, are told apart by their whole
// name (boot.obj.spa); that does not depend on patterns and shards. Symbolic links to folders are followed,
// and links to files may leave the folder, only with follow_links; a folder is not entered again below
// itself. What cannot be listed or must not be read becomes an asset with a problem. Throws Error:
// input_output for an input that is not there, usage if two inputs would write one file.
AssetList find_assets(const AssetQuery& query);

// Whether patterns and shard of the query want the asset, by its name.
bool is_wanted(const BatchAsset& asset, const AssetQuery& query);

} // namespace spa::tools
