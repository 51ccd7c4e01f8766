// SPDX-License-Identifier: Apache-2.0
// The report of a batch as one page for a browser: a table of all assets that can be sorted and filtered. It
// holds all it shows, asks no network for anything and runs no script but its own, whatever the names and
// messages in the report.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <functional>
#include <ostream>
#include <vector>

namespace spa::tools {

// The PNG file of an asset's thumbnail, by its place in the report's `assets`; empty: there is none.
using ThumbnailSource = std::function<std::vector<std::byte>(std::size_t asset)>;

// report: as formats/schemas/batch.schema.json says; strings may hold any bytes, and those that are not UTF-8
// are shown as U+FFFD. Each thumbnail is asked for once, in order, and not kept. Whether all was written is
// for the caller to ask `out`; throws what `thumbnail` throws.
void write_batch_page(std::ostream& out, const nlohmann::ordered_json& report,
                      const ThumbnailSource& thumbnail);

} // namespace spa::tools
