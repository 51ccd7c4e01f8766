// SPDX-License-Identifier: Apache-2.0
// As much of JSON Schema (draft 2020-12) as formats/schemas uses.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace spa::test {

// Where and how `value` breaks `schema`; empty if it does not. A keyword that is not known here is reported
// too, so that no rule goes unchecked.
std::string schema_error(const nlohmann::json& schema, const nlohmann::json& value,
                         const std::string& where = "$");

// The schema of a verb's --format json.
nlohmann::json load_schema(const std::string& verb);

} // namespace spa::test
