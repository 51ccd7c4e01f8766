// SPDX-License-Identifier: Apache-2.0
#include "batch_assets.h"

#include "glob.h"

#include "../formats/container/checksum.h"
#include "../libspa/core/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <span>
#include <string_view>
#include <sys/stat.h>

namespace spa::tools {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 6> asset_extensions{".gltf", ".glb", ".obj", ".ply", ".stl", ".off"};

bool has_asset_extension(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return std::find(asset_extensions.begin(), asset_extensions.end(), extension) != asset_extensions.end();
}

bool is_inside(const fs::path& path, const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

// What tells whether two paths lead to the same folder.
struct FolderId {
    std::uint64_t device = 0, inode = 0;
    bool operator==(const FolderId&) const = default;
};

FolderId id_of(const fs::path& folder) {
    struct stat status {};
    if (stat(folder.c_str(), &status) != 0) return {};
    return {std::uint64_t(status.st_dev), std::uint64_t(status.st_ino)};
}

class Lister {
public:
    explicit Lister(bool follow_links) : follow_links_(follow_links) {}

    void add_folder(const fs::path& folder) {
        std::error_code error;
        root_ = fs::canonical(folder, error);
        walk(folder, "");
    }

    void add_file(const fs::path& path, const std::string& name) {
        std::error_code error;
        BatchAsset asset{name, path, {}, 0, {}};
        const fs::file_status status = fs::status(path, error);
        if (status.type() == fs::file_type::not_found)
            asset.problem = "no such file; check the path";
        else if (!fs::is_regular_file(status))
            asset.problem = error ? "cannot be read: " + error.message() : "not a regular file";
        else
            asset.bytes = fs::file_size(path, error);
        list_.assets.push_back(std::move(asset));
    }

    AssetList take() {
        if (unfollowed_ > 0)
            list_.warnings.push_back(
                std::to_string(unfollowed_) +
                " symbolic links to folders were not followed; --follow-links follows them");
        std::sort(list_.warnings.begin(), list_.warnings.end());
        return std::move(list_);
    }

private:
    void add_problem(const fs::path& path, const std::string& name, const std::string& problem) {
        list_.assets.push_back({name, path, {}, 0, problem});
    }

    void walk(const fs::path& folder, const std::string& prefix) {
        const FolderId id = id_of(folder);
        if (std::find(above_.begin(), above_.end(), id) != above_.end()) {
            list_.warnings.push_back(folder.string() +
                                     ": leads back to a folder above it; not entered again");
            return;
        }
        above_.push_back(id);
        std::error_code error;
        for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
            visit(*entry, prefix + entry->path().filename().string());
        if (error)
            add_problem(folder, prefix.empty() ? "." : prefix,
                        "the folder cannot be read: " + error.message());
        above_.pop_back();
    }

    void visit(const fs::directory_entry& entry, const std::string& name) {
        std::error_code error;
        const bool is_link = entry.is_symlink(error);
        if (entry.is_directory(error)) {
            if (is_link && !follow_links_)
                ++unfollowed_;
            else
                walk(entry.path(), name + "/");
            return;
        }
        if (!has_asset_extension(entry.path())) return;
        if (is_link && !follow_links_) {
            const fs::path target = fs::canonical(entry.path(), error);
            if (!error && !is_inside(target, root_))
                return add_problem(
                    entry.path(), name,
                    "is a symbolic link that leads out of the folder; --follow-links allows it");
        }
        add_file(entry.path(), name);
    }

    bool follow_links_;
    fs::path root_;               // of the folder that is listed, real path
    std::vector<FolderId> above_; // from it to the one that is walked
    std::uint64_t unfollowed_ = 0;
    AssetList list_;
};

std::vector<std::string> read_list(const std::string& input) {
    std::string text;
    if (input == "-" || input == "@-") {
        text.assign(std::istreambuf_iterator<char>(std::cin), {});
    } else {
        const std::string path = input.substr(1);
        std::ifstream file(path, std::ios::binary);
        if (!file) throw Error(ExitCode::input_output, path + ": the list cannot be opened; check the path");
        text.assign(std::istreambuf_iterator<char>(file), {});
    }
    const char separator = text.find('\0') == std::string::npos ? '\n' : '\0';
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(separator, begin), text.size());
        if (end > begin) lines.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return lines;
}

std::string name_in_list(const fs::path& path) {
    const fs::path normal = path.lexically_normal();
    const bool keeps_folders = normal.is_relative() && *normal.begin() != "..";
    return (keeps_folders ? normal : normal.filename()).string();
}

void add_input(Lister& lister, const std::string& input) {
    if (input == "-" || input.starts_with('@')) {
        for (const std::string& line : read_list(input)) lister.add_file(line, name_in_list(line));
        return;
    }
    std::error_code error;
    const fs::file_status status = fs::status(input, error);
    if (status.type() == fs::file_type::not_found)
        throw Error(ExitCode::input_output, input + ": no such file or folder; check the path");
    if (!fs::exists(status))
        throw Error(ExitCode::input_output, input + ": cannot be read: " + error.message());
    if (fs::is_directory(status))
        lister.add_folder(input);
    else
        lister.add_file(input, fs::path(input).filename().string());
}

// The asset's name with .spa instead of its extension, or with .spa after its whole name.
fs::path output_of(const fs::path& folder, const BatchAsset& asset, bool whole_name) {
    fs::path name = asset.name;
    if (!whole_name && has_asset_extension(name)) name.replace_extension();
    name += ".spa";
    return folder / name;
}

// One that could not be listed.
bool is_folder(const BatchAsset& asset) { return asset.name == "." || asset.name.ends_with('/'); }

void name_outputs(const fs::path& folder, std::vector<BatchAsset>& assets) {
    std::vector<bool> whole(assets.size(), false);
    for (bool changed = true; changed;) {
        changed = false;
        std::map<std::string, std::size_t> first; // by output
        for (std::size_t i = 0; i < assets.size(); ++i) {
            assets[i].output = output_of(folder, assets[i], whole[i]);
            if (is_folder(assets[i])) continue;
            const auto [at, is_new] = first.emplace(assets[i].output.string(), i);
            if (is_new) continue;
            if (whole[i] && whole[at->second])
                throw Error(ExitCode::usage, assets[at->second].path.string() + " and " +
                                                 assets[i].path.string() + " would both be written to " +
                                                 assets[i].output.string() + "; bake them into two folders");
            changed = true;
            whole[i] = whole[at->second] = true;
        }
    }
}

} // namespace

bool is_wanted(const BatchAsset& asset, const AssetQuery& query) {
    const auto matches = [&](const std::string& pattern) { return glob_matches(pattern, asset.name); };
    const auto includes = [&](const std::string& pattern) {
        return is_folder(asset) ? glob_may_match_below(pattern, asset.name) : matches(pattern);
    };
    if (!query.include.empty() && std::none_of(query.include.begin(), query.include.end(), includes))
        return false;
    if (std::any_of(query.exclude.begin(), query.exclude.end(), matches)) return false;
    if (!query.shard) return true;
    const std::uint64_t hash = container::checksum(std::as_bytes(std::span(asset.name)));
    return hash % query.shard->count == query.shard->index % query.shard->count;
}

AssetList find_assets(const AssetQuery& query) {
    Lister lister(query.follow_links);
    for (const std::string& input : query.inputs) add_input(lister, input);
    AssetList list = lister.take();
    std::sort(list.assets.begin(), list.assets.end(), [](const BatchAsset& a, const BatchAsset& b) {
        return a.name != b.name ? a.name < b.name : a.path < b.path;
    });
    // The same file named twice is one asset.
    const auto same = [](const BatchAsset& a, const BatchAsset& b) {
        return a.name == b.name && a.path.lexically_normal() == b.path.lexically_normal();
    };
    list.assets.erase(std::unique(list.assets.begin(), list.assets.end(), same), list.assets.end());
    name_outputs(query.output, list.assets);
    std::erase_if(list.assets, [&](const BatchAsset& asset) { return !is_wanted(asset, query); });
    return list;
}

} // namespace spa::tools
