// SPDX-License-Identifier: Apache-2.0
// What a map was made from, in one number: files, options and version of the baker. It is in the metadata of
// every map, and says whether a map is still what a bake would make.
#pragma once

#include "../formats/import/import.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace spa::tools {

// "files" of the metadata: [{"name", "bytes", "xxh3"}]; a name that is not UTF-8 also in hexadecimal,
// "name_hex".
nlohmann::ordered_json files_json(const std::vector<import::SourceFile>& files);
// "missing": the names of what was referred to and not there, written likewise: [{"name"}].
nlohmann::ordered_json missing_json(const std::vector<std::string>& names);
// The name of an entry of either, as bytes; empty if the entry is not as the two write it.
std::string name_of(const nlohmann::ordered_json& entry);

// 16 hexadecimal digits: the hash of files and missing (as above), options (request_json) and version
// (SPA_VERSION). Equal keys, equal bytes.
std::string bake_key(const nlohmann::ordered_json& files, const nlohmann::ordered_json& missing,
                     const nlohmann::ordered_json& options, const std::string& version);

} // namespace spa::tools
