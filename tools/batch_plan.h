// SPDX-License-Identifier: Apache-2.0
// The assets of a batch that follows a plan: the objects of a scene that are to be maps.
#pragma once

#include "batch_assets.h"
#include "plan_file.h"

namespace spa::tools {

// Those objects that have a map of their own and that the query's patterns and shard want, by name: the path
// of the map in the plan without .spa. The maps go below query.output. A scene that is no longer what the
// plan was made for is a warning. Throws Error as read_plan and map_path; input_output if the scene is not
// there.
AssetList plan_assets(const Plan& plan, const AssetQuery& query);

} // namespace spa::tools
