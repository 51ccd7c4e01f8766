// SPDX-License-Identifier: Apache-2.0
// What others decided, as a report shows it: plans of scenes (PLAN.json, formats/schemas/plan.schema.json),
// and the searches that bakes leave in the metadata of their maps.
#pragma once

#include "json_pick.h"
#include "report_files.h"

namespace spa::tools {

// An entry of `plans` in formats/schemas/report.schema.json; what is missing or makes no sense in the file is
// null there. A file that is no plan at all, or cannot be read, gives an entry with `error`. At most 64 MiB
// of a file are read and 20000 objects taken.
PickedJson plan_json(const ReportFile& file);

// `search` of a map's entry, from its metadata; null if there was none. At most 1000 candidates.
PickedJson search_json(const PickedJson& metadata);

} // namespace spa::tools
