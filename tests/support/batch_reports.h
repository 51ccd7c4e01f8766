// SPDX-License-Identifier: Apache-2.0
// Reports of batches that never ran, for tests of what is made from reports.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>

namespace spa::test {

// Nine assets: every status, measured and not, with warnings and diagnostics, and names, messages and
// diagnostics that try to become part of a page. One name is not UTF-8.
nlohmann::ordered_json hostile_batch_report();

// `count` assets without anything special, every 100th failed; names in order, figures not.
nlohmann::ordered_json large_batch_report(std::size_t count);

} // namespace spa::test
