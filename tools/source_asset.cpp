// SPDX-License-Identifier: Apache-2.0
#include "source_asset.h"

#include "../libspa/bake/auto_parts.h"
#include "../libspa/core/error.h"

#include <nlohmann/json.hpp>

#include <utility>

namespace spa::tools {

namespace {

constexpr PartsKind all_kinds[] = {PartsKind::whole, PartsKind::components, PartsKind::nodes,
                                   PartsKind::bones, PartsKind::automatic};

Partition divide(const Scene& scene, const Division& division) {
    switch (division.kind) {
    case PartsKind::components: return divide_by_components(scene.model, division.max_parts);
    case PartsKind::nodes: return divide_by_nodes(scene, division.max_parts);
    case PartsKind::bones: return divide_by_bones(scene, division.max_parts);
    case PartsKind::automatic: return bake::divide_by_need(scene.model, division.layers, division.max_parts);
    case PartsKind::whole: break;
    }
    return whole(scene.model);
}

} // namespace

const char* name(PartsKind kind) {
    switch (kind) {
    case PartsKind::components: return "components";
    case PartsKind::nodes: return "nodes";
    case PartsKind::bones: return "bones";
    case PartsKind::automatic: return "auto";
    case PartsKind::whole: break;
    }
    return "whole";
}

SourceAsset read_source_asset(const std::filesystem::path& path, const Division& division,
                              bool follow_links) {
    const spa::import::Limits limits{.follow_links = follow_links};
    SourceAsset source;
    Scene scene;
    if (division.kind == PartsKind::nodes || division.kind == PartsKind::bones) {
        spa::import::SceneResult read =
            spa::import::read_scene(path, limits, {.rig = division.kind == PartsKind::bones});
        scene = std::move(read.scene);
        source.asset.report = std::move(read.report);
    } else {
        source.asset = spa::import::read_model(path, limits);
        scene.model = std::move(source.asset.model);
    }
    try {
        source.partition = divide(scene, division);
    } catch (const Error& error) {
        throw Error(error.code(), path.string() + ": " + error.what());
    }
    source.asset.model = std::move(scene.model);
    return source;
}

Division division_of(const nlohmann::ordered_json& metadata) {
    Division division;
    if (!metadata.is_object() || !metadata.contains("options") || !metadata["options"].is_object())
        return division;
    const auto& options = metadata["options"];
    const auto number = [&](const char* key, std::uint32_t most, std::uint32_t otherwise) {
        const auto found = options.find(key);
        if (found == options.end() || !found->is_number_unsigned()) return otherwise;
        const auto value = found->get<std::uint64_t>();
        return value >= 1 && value <= most ? std::uint32_t(value) : otherwise;
    };
    for (const PartsKind kind : all_kinds)
        if (options.value("parts", nlohmann::ordered_json()) == name(kind)) division.kind = kind;
    division.max_parts = number("max_parts", most_parts, division.max_parts);
    division.layers = number("layers", 64, division.layers);
    return division;
}

} // namespace spa::tools
