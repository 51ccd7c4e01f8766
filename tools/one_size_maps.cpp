// SPDX-License-Identifier: Apache-2.0
#include "one_size_maps.h"

#include "interrupt.h"
#include "map_file.h"
#include "progress.h"

#include "../formats/container/writer.h"
#include "../libspa/mesh/node_model.h"

#include <chrono>
#include <map>
#include <utility>

namespace spa::tools {

namespace {

// Nodes of objects that are drawn as one mesh.
std::vector<std::vector<std::uint32_t>> groups_of(const Plan& plan) {
    std::vector<std::vector<std::uint32_t>> groups;
    std::map<std::uint32_t, std::size_t> group_of; // by the node whose mesh it is
    for (const PlanObject& object : plan.objects) {
        if (object.decision == PlanDecision::drop) continue;
        const auto [at, is_new] = group_of.emplace(object.same_as.value_or(object.node), groups.size());
        if (is_new) groups.emplace_back();
        groups[at->second].push_back(object.node);
    }
    return groups;
}

std::uint64_t file_bytes(const SphericalMap& map, bool compress, const std::string& name) {
    container::WriteOptions options;
    options.compression = compress ? container::Compression::zstd : container::Compression::none;
    std::vector<std::byte> bytes;
    require(container::write(map, options, bytes), name);
    return bytes.size();
}

} // namespace

OneSizeMaps bake_one_size(const Scene& scene, const Plan& plan, bool quiet) {
    const auto start = std::chrono::steady_clock::now();
    const BakeSettings settings = parse_settings({{"--size", std::to_string(plan.one_size)}});
    const auto groups = groups_of(plan);
    ProgressReport progress("baking maps of size " + std::to_string(plan.one_size), quiet);
    OneSizeMaps result;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const std::uint32_t node = groups[i].front();
        try {
            bake::Result baked =
                bake::bake_model(node_model(scene, node), settings.options, [&](double share) {
                    progress.update((double(i) + share) / double(groups.size()));
                    return interrupt_signal() == 0;
                });
            OneSizeMap& map = result.maps.emplace_back();
            map.map = std::move(baked.map);
            map.file_bytes = file_bytes(map.map.map, settings.compress, node_text(scene, node));
            map.nodes = groups[i];
        } catch (const Error& error) {
            if (error.code() != ExitCode::invalid_data) throw;
            result.not_baked.emplace_back(error.what());
        }
    }
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
}

} // namespace spa::tools
