// SPDX-License-Identifier: Apache-2.0
// The arrows between folders: which folder may use which, and which third-party code, read from #include
// lines and CMake link lines. The table in arrows.cpp is the enforced form of the one in the design.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace spa::architecture {

struct Module {
    std::string folder;                // relative to the project root, with '/' at its end
    std::vector<std::string> targets;  // the NAMEs of spa::NAME that its files make
    std::vector<std::string> uses;     // folders besides its own
    std::vector<std::string> includes; // beginnings of allowed third-party and system headers
    std::vector<std::string> links;    // beginnings of allowed third-party link items
};

// The folders with rules. tests/ and tools/ may use everything and have none.
const std::vector<Module>& modules();

// Each finding is one line that names the file, the offending line and the rule. `file` is relative to
// `root`; `text` is what it holds. Files outside the folders of modules() only have to include files that
// exist.
std::vector<std::string> include_findings(const std::filesystem::path& root, const std::string& file,
                                          const std::string& text);
std::vector<std::string> link_findings(const std::string& file, const std::string& text);

} // namespace spa::architecture
