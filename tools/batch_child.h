// SPDX-License-Identifier: Apache-2.0
// What the process of one asset does, and how it tells the batch.
#pragma once

#include "batch_report.h"

#include <cstddef>
#include <string>
#include <vector>

namespace spa::tools {

struct ChildTask {
    BatchAsset asset;
    BakeSettings settings; // with the number of threads
    bool follow_links = false;
    BakeReason reason = BakeReason::none; // none: find out first, by reading the sources, whether to bake
    bool dry_run = false;                 // finds out only
    bool is_current = false;              // nothing to bake: the picture alone
    bool wants_picture = false;
};

struct ChildOutcome {
    AssetResult result; // of baked, up_to_date, failed; without what only the parent knows
    int interrupt = 0;  // the signal that asked it to end before it was done; 0 = none
    bool out_of_memory = false;
    bool output_failed = false;     // for a reason that concerns all outputs (OutputError)
    std::vector<std::byte> picture; // PNG; empty if not wanted or not to be had
};

// Runs the task and returns the outcome as bytes. Does not throw.
std::string run_child(const ChildTask& task);

// The outcome from those bytes; a failure if they are not what run_child returns.
ChildOutcome parse_outcome(const std::string& bytes);

} // namespace spa::tools
