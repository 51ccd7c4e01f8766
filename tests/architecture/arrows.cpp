// SPDX-License-Identifier: Apache-2.0
#include "arrows.h"

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

namespace spa::architecture {
namespace {

namespace fs = std::filesystem;

bool starts_with_any(const std::string& text, const std::vector<std::string>& beginnings) {
    return std::any_of(beginnings.begin(), beginnings.end(),
                       [&](const std::string& beginning) { return text.starts_with(beginning); });
}

const Module* module_of(const std::string& file) {
    const auto found = std::find_if(modules().begin(), modules().end(),
                                    [&](const Module& module) { return file.starts_with(module.folder); });
    return found == modules().end() ? nullptr : &*found;
}

// Headers of the standard library have neither a folder nor an extension.
bool is_standard(const std::string& header) {
    return header.find('/') == std::string::npos && header.find('.') == std::string::npos;
}

// The core neither reads nor writes files, nor prints.
bool is_input_output(const std::string& header) {
    static const std::vector<std::string> headers = {"cstdio",   "filesystem", "fstream",
                                                     "iostream", "print",      "syncstream"};
    return std::find(headers.begin(), headers.end(), header) != headers.end();
}

std::string angle_finding(const Module& module, const std::string& header) {
    if (is_standard(header)) {
        if (module.folder == "libspa/core/" && is_input_output(header))
            return "libspa/core does no input or output";
        return {};
    }
    if (starts_with_any(header, module.includes)) return {};
    return module.folder + " may not use this header";
}

std::string quoted_finding(const fs::path& root, const std::string& file, const std::string& header) {
    const std::string target = (fs::path(file).parent_path() / header).lexically_normal().generic_string();
    if (!fs::exists(root / target)) return "no such file beside the including one";
    const Module* from = module_of(file);
    if (from == nullptr || target.starts_with(from->folder) || starts_with_any(target, from->uses)) return {};
    return from->folder + " may not use " + target;
}

// word: a link item without keywords and generator expressions.
bool may_link(const Module& from, const std::string& word) {
    const std::string name = word.starts_with("spa::")  ? word.substr(5)
                             : word.starts_with("spa_") ? word.substr(4)
                                                        : "";
    if (name.empty()) return starts_with_any(word, from.links);
    const auto target = std::find_if(modules().begin(), modules().end(), [&](const Module& module) {
        return std::find(module.targets.begin(), module.targets.end(), name) != module.targets.end();
    });
    if (target == modules().end()) return false;
    return &*target == &from ||
           std::find(from.uses.begin(), from.uses.end(), target->folder) != from.uses.end();
}

} // namespace

std::vector<std::string> include_findings(const fs::path& root, const std::string& file,
                                          const std::string& text) {
    static const std::regex include(R"re(^\s*#\s*include\s*([<"])([^>"]+)[>"])re");
    std::vector<std::string> findings;
    const Module* from = module_of(file);
    std::istringstream lines(text);
    std::smatch match;
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        if (!std::regex_search(line, match, include)) continue;
        const std::string header = match[2];
        std::string finding;
        if (match[1] == "\"")
            finding = quoted_finding(root, file, header);
        else if (from != nullptr)
            finding = angle_finding(*from, header);
        if (!finding.empty())
            findings.push_back(file + ":" + std::to_string(number) + ": " + header + ": " + finding);
    }
    return findings;
}

std::vector<std::string> link_findings(const std::string& file, const std::string& text) {
    static const std::regex comment(R"(#[^\n]*)");
    static const std::regex link(R"(target_link_libraries\s*\(\s*\S+([^)]*)\))");
    // Generator expressions: what they choose from is linked, one way or another.
    static const std::regex condition(R"(\$<TARGET_EXISTS:[^>]*>)"), operation(R"(\$<[A-Z_]+:|[>,])");
    static const std::set<std::string> keywords = {"PUBLIC", "PRIVATE", "INTERFACE"};
    std::vector<std::string> findings;
    const Module* from = module_of(file);
    if (from == nullptr) return findings;
    const std::string code = std::regex_replace(text, comment, "");
    for (std::sregex_iterator call(code.begin(), code.end(), link), none; call != none; ++call) {
        const std::string items = std::regex_replace((*call)[1].str(), condition, "");
        std::istringstream words(std::regex_replace(items, operation, " "));
        for (std::string word; words >> word;)
            if (!keywords.contains(word) && !may_link(*from, word))
                findings.push_back(file + ": " + from->folder + " may not link " + word);
    }
    return findings;
}

const std::vector<Module>& modules() {
    static const std::vector<Module> table = {
        {.folder = "libspa/core/", .targets = {"core"}, .uses = {}, .includes = {}, .links = {}},
        {.folder = "libspa/mesh/",
         .targets = {"mesh"},
         .uses = {"libspa/core/"},
         .includes = {"OpenMesh/", "tbb/"},
         .links = {"OpenMesh", "TBB::"}},
        {.folder = "libspa/bake/",
         .targets = {"bake", "orbit"},
         .uses = {"libspa/core/", "libspa/mesh/"},
         .includes = {"EGL/", "GL/", "dlfcn.h", "tbb/", "orbit_shaders.h"}, // the last is generated
         .links = {"TBB::", "OpenGL::", "${CMAKE_DL_LIBS}"}},
        {.folder = "shaders/", .targets = {}, .uses = {}, .includes = {}, .links = {}},
        {.folder = "libspa/trace/",
         .targets = {"trace", "trace_map", "trace_embree"},
         .uses = {"libspa/core/", "libspa/mesh/", "shaders/"},
         .includes = {"embree3/", "hwy/", "pmmintrin.h", "tbb/"},
         .links = {"embree", "hwy", "TBB::"}},
        {.folder = "libspa/vulkan/",
         .targets = {"vulkan"},
         .uses = {"libspa/core/", "libspa/trace/", "shaders/"},
         .includes = {"vulkan/vulkan_core.h", "spirv/"}, // the last are generated
         .links = {"Vulkan::Headers"}},
        {.folder = "libspa/dxr/",
         .targets = {"dxr"},
         .uses = {"libspa/core/", "libspa/trace/", "shaders/"},
         .includes = {"directx/d3d12.h", "d3d12.h", "windows.h", "wsl/winadapter.h"},
         .links = {}},
        {.folder = "libspa/render/",
         .targets = {"render"},
         .uses = {"libspa/core/", "libspa/mesh/", "libspa/trace/", "libspa/vulkan/", "shaders/"},
         .includes = {"vulkan/vulkan_core.h", "spirv/", "tbb/"},
         .links = {"Vulkan::Vulkan", "TBB::"}},
        {.folder = "libspa/measure/",
         .targets = {"measure"},
         .uses = {"libspa/core/", "libspa/mesh/", "libspa/bake/", "libspa/trace/", "libspa/render/"},
         .includes = {"malloc.h", "meshoptimizer.h", "sched.h", "tbb/"}, // all but the last for benchmarks
         .links = {"TBB::", "meshoptimizer"}},
        {.folder = "libspa/plan/",
         .targets = {"plan"},
         .uses = {"libspa/core/", "libspa/mesh/", "libspa/bake/", "libspa/trace/", "libspa/measure/",
                  "formats/container/"},
         .includes = {"tbb/"},
         .links = {"TBB::"}},
        {.folder = "formats/container/",
         .targets = {"container"},
         .uses = {"libspa/core/"},
         .includes = {"zstd.h", "xxhash.h", "sys/", "fcntl.h", "unistd.h", "windows.h"},
         .links = {"zstd::", "${zstd}", "xxHash::", "PkgConfig::"}},
        {.folder = "formats/import/",
         .targets = {"import"},
         .uses = {"libspa/core/", "libspa/mesh/"},
         .includes = {"fcntl.h", "sys/stat.h", "unistd.h", "OpenImageIO/", "OpenMesh/", "draco/",
                      "meshoptimizer.h", "nlohmann/", "tiny_gltf.h", "tbb/", "xxhash.h"},
         .links = {"PkgConfig::xxhash", "OpenImageIO::", "OpenMesh", "TBB::", "draco", "meshoptimizer",
                   "nlohmann_json::", "tinygltf"}},
        {.folder = "samples/",
         .targets = {"samples"},
         .uses = {"libspa/core/", "libspa/mesh/", "libspa/bake/", "libspa/trace/", "libspa/vulkan/",
                  "formats/container/", "formats/import/", "shaders/"},
         .includes = {"OpenImageIO/", "embree3/", "nlohmann/", "spirv/", "vulkan/"},
         .links = {"OpenImageIO::", "Vulkan::", "embree", "nlohmann_json::"}},
    };
    return table;
}

} // namespace spa::architecture
