// SPDX-License-Identifier: Apache-2.0
// Which files a report is about.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace spa::tools {

enum class ReportFileKind : std::uint8_t { map, plan };

struct ReportFile {
    ReportFileKind kind = ReportFileKind::map;
    std::string name;           // below the folder that was given, with '/'; of a file its own name
    std::filesystem::path path; // to open
};

struct ReportFiles {
    std::vector<ReportFile> files; // sorted by name, then path, bytewise
    std::vector<std::string> warnings;
};

// inputs: of a folder all .spa files below it, and the plans (PLAN.json, *.plan.json); of files, any: one
// that ends in .json is a plan. The same file given twice counts once. Links to folders are not followed.
// What cannot be listed is a warning. Throws Error{input_output} for an input that is not there, and for a
// folder without any such file.
ReportFiles find_report_files(const std::vector<std::string>& inputs);

} // namespace spa::tools
