// SPDX-License-Identifier: Apache-2.0
// Bakes the assets of a batch, each in a process of its own.
#pragma once

#include "batch_report.h"

#include <cstddef>
#include <functional>
#include <span>

namespace spa::tools {

// Gets the picture of an asset's map as soon as there is one (PNG).
using PictureSink = std::function<void(std::size_t asset, std::span<const std::byte> png)>;

// Fills in report.results, stopped_by and seconds. Assets are begun largest first, so that the last ones are
// short; as many run at once as arguments.jobs and arguments.memory_bytes allow. No asset can do harm to
// another: one that crashes, is malformed, or exceeds time or memory has failed, and the others go on. After
// a signal, or where an output cannot be written for a reason that holds for all (unless
// arguments.keep_going), no further asset is begun; a run after this one goes on from there. Nothing
// half-written is left; what killed runs left behind beside these outputs is removed. No other thread may be
// at work (worker.h), and the caller has an InterruptGuard. Throws Error{input_output} if the output folder
// cannot be made or the system gives no process.
void run_batch(BatchReport& report, const PictureSink& pictures);

} // namespace spa::tools
