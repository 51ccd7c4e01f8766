// SPDX-License-Identifier: Apache-2.0
// Reports of maps that never were, for tests of the page that is made from them.
#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>

namespace spa::test {

// Eight maps: measured, timed, searched for and not, one that could not be read, and names, messages and
// settings that try to become part of a page; two plans, one of which could not be read. One name is not
// UTF-8.
nlohmann::ordered_json hostile_map_report();

// `count` maps without anything special; names in order, figures not. No plan.
nlohmann::ordered_json large_map_report(std::size_t count);

} // namespace spa::test
