// SPDX-License-Identifier: Apache-2.0
// What a search for a map tells: in the file, in the report of a bake, and when it finds none.
#pragma once

#include "bake_settings.h"

#include "../libspa/plan/search.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace spa::tools {

// settings with what the search decided. search: with a candidate that was chosen.
BakeSettings decided(const BakeSettings& settings, const plan::SearchResult& search);

// settings.search is set in all of these.

// Without times and without what was tried, which is in the report alone: the same for the same input.
nlohmann::ordered_json search_metadata(const BakeSettings& settings, const plan::SearchResult& search);
// "search" of the report of a bake.
nlohmann::ordered_json search_json(const BakeSettings& settings, const plan::SearchResult& search);
// For people: a line of the verdict, then a table of what was tried.
std::string search_text(const BakeSettings& settings, const plan::SearchResult& search);

// Of a search that met no target: what came nearest, what stopped it and what may help.
std::string unmet_text(const BakeSettings& settings, const plan::SearchResult& search);

} // namespace spa::tools
