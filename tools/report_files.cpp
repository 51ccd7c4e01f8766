// SPDX-License-Identifier: Apache-2.0
#include "report_files.h"

#include "../libspa/core/error.h"

#include <algorithm>

namespace spa::tools {

namespace fs = std::filesystem;

namespace {

bool is_plan_name(const std::string& name) { return name == "PLAN.json" || name.ends_with(".plan.json"); }

void add_folder(const fs::path& folder, ReportFiles& found) {
    std::error_code error;
    constexpr auto options = fs::directory_options::skip_permission_denied;
    for (fs::recursive_directory_iterator entry(folder, options, error), end; !error && entry != end;
         entry.increment(error)) {
        std::error_code ignored;
        if (!entry->is_regular_file(ignored)) continue;
        const std::string name = entry->path().filename().string();
        const bool plan = is_plan_name(name);
        if (!plan && entry->path().extension() != ".spa") continue;
        found.files.push_back({plan ? ReportFileKind::plan : ReportFileKind::map,
                               entry->path().lexically_relative(folder).generic_string(), entry->path()});
    }
    if (error)
        found.warnings.push_back(folder.string() + ": not all of the folder was read: " + error.message());
}

} // namespace

ReportFiles find_report_files(const std::vector<std::string>& inputs) {
    ReportFiles found;
    for (const std::string& input : inputs) {
        std::error_code error;
        const fs::file_status status = fs::status(input, error);
        if (!fs::exists(status))
            throw Error(ExitCode::input_output, input + (status.type() == fs::file_type::not_found
                                                             ? ": no such file or folder; check the path"
                                                             : ": cannot be read: " + error.message()));
        if (!fs::is_directory(status)) {
            const fs::path path = input;
            found.files.push_back({path.extension() == ".json" ? ReportFileKind::plan : ReportFileKind::map,
                                   path.filename().string(), path});
            continue;
        }
        const std::size_t before = found.files.size();
        add_folder(input, found);
        if (found.files.size() == before)
            throw Error(ExitCode::input_output,
                        input +
                            ": no .spa file and no PLAN.json in this folder or below it; bake some first");
    }
    std::sort(found.files.begin(), found.files.end(), [](const ReportFile& a, const ReportFile& b) {
        return a.name != b.name ? a.name < b.name : a.path < b.path;
    });
    const auto same = [](const ReportFile& a, const ReportFile& b) {
        std::error_code ignored;
        return a.name == b.name && fs::equivalent(a.path, b.path, ignored);
    };
    found.files.erase(std::unique(found.files.begin(), found.files.end(), same), found.files.end());
    return found;
}

} // namespace spa::tools
