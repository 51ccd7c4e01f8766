// SPDX-License-Identifier: Apache-2.0
// An asset as it is baked and measured: the model, and the pieces that become parts of the map.
#pragma once

#include "../formats/import/import.h"
#include "../libspa/mesh/partition.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>

namespace spa::tools {

enum class PartsKind : std::uint8_t { whole, components, nodes, bones, automatic };
const char* name(PartsKind kind);

constexpr std::uint32_t default_max_parts = 64;
constexpr std::uint32_t most_parts = 4096;

// How a model is divided.
struct Division {
    PartsKind kind = PartsKind::whole;
    std::uint32_t max_parts = default_max_parts;
    std::uint32_t layers = 2; // of the bake; `automatic` asks for it
};

struct SourceAsset {
    import::Result asset;
    Partition partition; // at least one piece
};

// Throws Error as read_model and the divisions (partition.h, auto_parts.h) do, with messages that begin with
// the path.
SourceAsset read_source_asset(const std::filesystem::path& path, const Division& division, bool follow_links);

// The division that a map was baked with, by the options in its metadata; what another program wrote may lack
// them, and is taken as whole.
Division division_of(const nlohmann::ordered_json& metadata);

} // namespace spa::tools
