// SPDX-License-Identifier: Apache-2.0
// The bake of a map that a target decides.
#pragma once

#include "bake_arguments.h"

#include "../libspa/mesh/model.h"
#include "../libspa/plan/search.h"

namespace spa::tools {

// arguments.settings.search is set. Shows progress on stderr unless arguments.quiet. Throws as plan::search
// does, with messages that begin with the asset's path, and Error{limits} if no map meets the target and
// --best was not given: nothing was chosen then.
plan::SearchResult search_with_progress(const BakeArguments& arguments, const SourceAsset& source);

} // namespace spa::tools
