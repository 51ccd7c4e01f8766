// SPDX-License-Identifier: Apache-2.0
// Values of JSON that strangers wrote: what is not there, or is not what is asked for, is null, and nothing
// is longer than a report can bear.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <string>

namespace spa::tools {

using PickedJson = nlohmann::ordered_json;

// The member itself; null where there is none.
const PickedJson& pick(const PickedJson& json, const char* key);
// A string, cut after `most` bytes with an ellipsis, never within a character.
PickedJson pick_text(const PickedJson& json, const char* key, std::size_t most = 1000);
// A finite number >= 0, at most `highest` (a share: 1).
PickedJson pick_measure(const PickedJson& json, const char* key, double highest = 1e300);
// A whole number from 0 to 2^53, which every reader of JSON holds exactly.
PickedJson pick_count(const PickedJson& json, const char* key);
PickedJson pick_flag(const PickedJson& json, const char* key);
// The strings of an array, at most `most` of them; never null.
PickedJson pick_texts(const PickedJson& json, const char* key, std::size_t most = 100);
// {name: text} of an object's strings, numbers and booleans, at most 40 of them.
PickedJson pick_settings(const PickedJson& json, const char* key);

// As pick_text cuts.
std::string cut_text(const std::string& text, std::size_t most);

} // namespace spa::tools
