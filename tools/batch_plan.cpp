// SPDX-License-Identifier: Apache-2.0
#include "batch_plan.h"

#include "../libspa/core/error.h"

#include <algorithm>

namespace spa::tools {

namespace fs = std::filesystem;

AssetList plan_assets(const Plan& plan, const AssetQuery& query) {
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(plan.scene, error);
    if (error)
        throw Error(ExitCode::input_output, plan.scene.string() + ": the scene of " + plan.path.string() +
                                                " cannot be read: " + error.message());
    AssetList list;
    list.warnings = changed_sources(plan, plan.scene);
    for (const PlanObject& object : plan.objects) {
        if (object.map.empty()) continue;
        BatchAsset asset;
        asset.name = fs::path(object.map).replace_extension().generic_string();
        asset.path = plan.scene;
        asset.output = map_path(plan, object, query.output, query.follow_links);
        asset.bytes = bytes;
        asset.node = object.node;
        asset.settings = object.settings;
        if (is_wanted(asset, query)) list.assets.push_back(std::move(asset));
    }
    std::sort(list.assets.begin(), list.assets.end(),
              [](const BatchAsset& a, const BatchAsset& b) { return a.name < b.name; });
    return list;
}

} // namespace spa::tools
