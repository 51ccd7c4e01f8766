// SPDX-License-Identifier: Apache-2.0
// Reads the project's own files: the arrows between folders hold, every file names its licence, and long
// files are listed.
#include "arrows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>
#include <set>
#include <sstream>

namespace {

namespace fs = std::filesystem;
using spa::architecture::include_findings;
using spa::architecture::link_findings;

const fs::path root = SPA_SOURCE_DIR;

std::string text_of(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

bool is_cmake(const fs::path& path) {
    return path.filename() == "CMakeLists.txt" || path.extension() == ".cmake";
}

bool is_cpp(const fs::path& path) { return path.extension() == ".h" || path.extension() == ".cpp"; }

bool is_source(const fs::path& path) {
    static const std::set<std::string> extensions = {".sh",    ".in",   ".py",   ".js",   ".mjs",
                                                     ".glsl",  ".hlsl", ".rgen", ".rint", ".rchit",
                                                     ".rmiss", ".comp", ".frag", ".vert", ".hexpat"};
    return is_cpp(path) || is_cmake(path) || extensions.contains(path.extension().string());
}

// Relative to the root, sorted.
std::vector<std::string> source_files() {
    std::vector<std::string> files = {"CMakeLists.txt", ".ci/run"};
    for (const char* folder : {"cmake", "formats", "libspa", "samples", "shaders", "tests", "tools"}) {
        if (!fs::exists(root / folder)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(root / folder))
            if (entry.is_regular_file() && is_source(entry.path()))
                files.push_back(fs::relative(entry.path(), root).generic_string());
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

TEST(Architecture, IncludesFollowTheArrows) {
    std::vector<std::string> findings;
    std::size_t read = 0;
    for (const std::string& file : source_files()) {
        if (!is_cpp(file)) continue;
        ++read;
        const auto found = include_findings(root, file, text_of(root / file));
        findings.insert(findings.end(), found.begin(), found.end());
    }
    EXPECT_GT(read, 10U);
    EXPECT_TRUE(findings.empty()) << joined(findings);
}

TEST(Architecture, LinkLinesFollowTheArrows) {
    std::vector<std::string> findings;
    for (const std::string& file : source_files()) {
        if (!is_cmake(file)) continue;
        const auto found = link_findings(file, text_of(root / file));
        findings.insert(findings.end(), found.begin(), found.end());
    }
    EXPECT_TRUE(findings.empty()) << joined(findings);
}

TEST(Architecture, EveryFileNamesItsLicence) {
    std::vector<std::string> findings;
    for (const std::string& file : source_files()) {
        std::istringstream lines(text_of(root / file));
        std::string first, second;
        std::getline(lines, first);
        std::getline(lines, second);
        if ((first + second).find("SPDX-License-Identifier: Apache-2.0") == std::string::npos)
            findings.push_back(file);
    }
    EXPECT_TRUE(findings.empty()) << "no SPDX line at the top:\n" << joined(findings);
}

// Over 500 lines is listed, for whoever reads the output to judge; over 1000 no file holds one idea.
TEST(Architecture, FilesStayShort) {
    std::vector<std::string> too_long;
    for (const std::string& file : source_files()) {
        const std::string text = text_of(root / file);
        const auto lines = std::count(text.begin(), text.end(), '\n');
        const std::string entry = file + ": " + std::to_string(lines) + " lines";
        if (lines > 500) std::cout << "long: " << entry << "\n";
        if (lines > 1000) too_long.push_back(entry);
    }
    EXPECT_TRUE(too_long.empty()) << joined(too_long);
}

// The rules themselves: what they must refuse, and what they must let pass.
TEST(ArchitectureRules, CoreUsesOnlyTheStandardLibrary) {
    EXPECT_TRUE(
        include_findings(root, "libspa/core/x.cpp", "#include \"vector.h\"\n#include <cmath>\n").empty());
    EXPECT_EQ(include_findings(root, "libspa/core/x.cpp", "#include \"../mesh/model.h\"\n").size(), 1U);
    EXPECT_EQ(include_findings(root, "libspa/core/x.cpp", "\n #  include <zstd.h>\n").size(), 1U);
    EXPECT_EQ(include_findings(root, "libspa/core/x.cpp", "#include <fstream>\n").size(), 1U);
}

TEST(ArchitectureRules, ContainerUsesCoreButNotMesh) {
    const std::string good =
        "#include \"../../libspa/core/vector.h\"\n#include <zstd.h>\n#include <vector>\n";
    EXPECT_TRUE(include_findings(root, "formats/container/x.cpp", good).empty());
    const std::string bad = "#include \"../../libspa/mesh/model.h\"\n#include <OpenImageIO/imageio.h>\n";
    EXPECT_EQ(include_findings(root, "formats/container/x.cpp", bad).size(), 2U);
}

// The text runs on GPUs: it takes nothing of the project, and the tracers take it.
TEST(ArchitectureRules, ShadersUseNothingAndTraceUsesThem) {
    EXPECT_EQ(include_findings(root, "shaders/x.h", "#include \"../libspa/core/vector.h\"\n").size(), 1U);
    EXPECT_EQ(include_findings(root, "shaders/x.h", "#include <immintrin.h>\n").size(), 1U);
    EXPECT_TRUE(include_findings(root, "shaders/x.h", "#include \"spa_map.h\"\n#include <bit>\n").empty());
    const std::string include = "#include \"../../shaders/spa_trace.h\"\n";
    EXPECT_TRUE(include_findings(root, "libspa/trace/x.cpp", include).empty());
    EXPECT_EQ(include_findings(root, "libspa/bake/x.cpp", include).size(), 1U);
}

TEST(ArchitectureRules, IncludesAreRelativeAndExist) {
    EXPECT_EQ(include_findings(root, "tests/x.cpp", "#include \"libspa/core/vector.h\"\n").size(), 1U);
    EXPECT_TRUE(include_findings(root, "tests/x.cpp", "#include \"../libspa/core/vector.h\"\n").empty());
}

TEST(ArchitectureRules, LinkLines) {
    const std::string file = "formats/container/CMakeLists.txt";
    EXPECT_TRUE(link_findings(file, "target_link_libraries(spa_container PUBLIC spa::core)").empty());
    EXPECT_TRUE(link_findings(file, "# target_link_libraries(spa_container spa::mesh)").empty());
    EXPECT_EQ(link_findings(file, "target_link_libraries(spa_container\n PUBLIC spa::core spa::mesh)").size(),
              1U);
    EXPECT_EQ(
        link_findings(file, "target_link_libraries(spa_container PRIVATE OpenImageIO::OpenImageIO)").size(),
        1U);
    EXPECT_TRUE(link_findings(file, "target_link_libraries(x $<IF:$<TARGET_EXISTS:zstd::a>,zstd::a,zstd::b>)")
                    .empty());
    EXPECT_EQ(link_findings(file, "target_link_libraries(x $<TARGET_NAME_IF_EXISTS:spa_orbit>)").size(), 1U);
    EXPECT_TRUE(link_findings("tools/CMakeLists.txt", "target_link_libraries(spa spa::mesh)").empty());
}

} // namespace
