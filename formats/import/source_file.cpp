// SPDX-License-Identifier: Apache-2.0
#include "source_file.h"

#include "../../libspa/core/error.h"
#include "open_file.h"

#include <algorithm>
#include <cctype>

#include <xxhash.h>

namespace spa::import {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& asset, std::string_view reference,
                         const std::string& why) {
    std::string shown(reference.substr(0, 120));
    std::replace_if(
        shown.begin(), shown.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }, '?');
    throw Error(ExitCode::invalid_data, asset.string() + ": the reference '" + shown + "' " + why +
                                            "; references must stay inside the asset's folder");
}

// Both without symbolic links. Nothing is inside a folder that is not known.
bool is_inside(const std::filesystem::path& path, const std::filesystem::path& folder) {
    if (path.empty() || folder.empty()) return false;
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

FileContent read_content(const OpenFile& file, const std::filesystem::path& path, std::uint64_t most,
                         const Limits& limits) {
    const std::uint64_t size = std::min(most, file.state().size);
    if (size > limits.file_bytes)
        throw Error(ExitCode::input_output,
                    path.string() + ": cannot be read: it has " + std::to_string(file.state().size) +
                        " bytes, more than the limit of " + std::to_string(limits.file_bytes));
    return {file.read(most), file.state()};
}

// A scheme is a letter and then letters, digits, '+', '-' or '.', up to a ':' (RFC 3986, 3.1). A drive
// letter is a scheme of one letter.
bool has_scheme(std::string_view text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos || colon == 0) return false;
    if (std::isalpha(static_cast<unsigned char>(text[0])) == 0) return false;
    return std::all_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(colon), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '+' || c == '-' || c == '.';
    });
}

int hex_value(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

} // namespace

FileContent read_file(const std::filesystem::path& path, const Limits& limits, std::uint64_t most) {
    const std::optional<OpenFile> file = OpenFile::open(path);
    if (!file)
        throw Error(ExitCode::input_output, path.string() + ": cannot be read: no such file; check the path");
    return read_content(*file, path, most, limits);
}

void add_warning(Report& report, std::string warning) {
    if (report.warnings.size() > max_warnings) return;
    if (std::find(report.warnings.begin(), report.warnings.end(), warning) != report.warnings.end()) return;
    if (report.warnings.size() == max_warnings) warning = "there are more warnings, which are left out";
    report.warnings.push_back(std::move(warning));
}

std::string percent_decode(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size()) {
            const int high = hex_value(text[i + 1]), low = hex_value(text[i + 2]);
            if (high >= 0 && low >= 0) {
                out.push_back(static_cast<char>(high * 16 + low));
                i += 2;
                continue;
            }
        }
        out.push_back(text[i]);
    }
    return out;
}

Reference resolve_reference(const std::filesystem::path& asset, std::string_view reference,
                            Encoding encoding) {
    // The scheme is looked for before and after decoding: "%66ile:" must not pass either.
    if (has_scheme(reference)) refuse(asset, reference, "is a URL or has a drive letter");
    std::string name = encoding == Encoding::uri ? percent_decode(reference) : std::string(reference);
    std::replace(name.begin(), name.end(), '\\', '/');
    if (has_scheme(name)) refuse(asset, reference, "is a URL or has a drive letter");
    if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }))
        refuse(asset, reference, "has a control character");
    if (name.empty()) refuse(asset, reference, "is empty");
    if (name.front() == '/') refuse(asset, reference, "is an absolute path");

    // Lexical: "a/../b" is "b" and stays inside, whatever "a" is.
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= name.size();) {
        const std::size_t end = std::min(name.find('/', begin), name.size());
        const std::string part = name.substr(begin, end - begin);
        if (part == "..") {
            if (parts.empty()) refuse(asset, reference, "climbs out of the folder with '..'");
            parts.pop_back();
        } else if (!part.empty() && part != ".") {
            parts.push_back(part);
        }
        begin = end + 1;
    }
    if (parts.empty()) refuse(asset, reference, "names no file");
    Reference result;
    for (const std::string& part : parts) result.name += (result.name.empty() ? "" : "/") + part;
    result.path = asset.parent_path() / result.name;
    return result;
}

References::References(const Asset& asset, const Limits& limits, Report& report)
    : asset_(asset), limits_(limits), report_(report), bytes_(asset.file.bytes.size()) {
    add_source(asset.path.filename().string(), asset.file);
}

std::optional<FileContent> References::read(const Reference& reference) {
    std::optional<FileContent> content = read(reference, whole_file);
    if (content) add_source(reference.name, *content);
    return content;
}

std::optional<FileContent> References::read_head(const Reference& reference, std::uint64_t most) {
    return read(reference, most);
}

std::optional<FileContent> References::read(const Reference& reference, std::uint64_t most) {
    const std::optional<OpenFile> file = OpenFile::open(reference.path);
    if (!file) return std::nullopt;
    if (!limits_.follow_links && !is_inside(file->real_path(), asset_.real_folder))
        refuse(asset_.path, reference.name,
               "is a symbolic link to another place, which only --follow-links allows");
    bytes_ += std::min(most, file->state().size);
    if (bytes_ > limits_.total_bytes)
        throw Error(ExitCode::input_output, asset_.path.string() + ": reads more than the limit of " +
                                                std::to_string(limits_.total_bytes) +
                                                " bytes from all files that it refers to");
    return read_content(*file, reference.path, most, limits_);
}

void References::check_count() const {
    if (report_.files.size() + report_.missing.size() > max_references)
        throw Error(ExitCode::invalid_data, asset_.path.string() + ": refers to more than " +
                                                std::to_string(max_references) + " files");
}

void References::add_source(std::string name, const FileContent& file) {
    if (std::any_of(report_.files.begin(), report_.files.end(),
                    [&](const SourceFile& known) { return known.name == name; }))
        return;
    report_.files.push_back(
        {std::move(name), file.bytes.size(), XXH3_64bits(file.bytes.data(), file.bytes.size()), file.state});
    check_count();
}

void References::add_missing(const std::string& name) {
    if (std::find(report_.missing.begin(), report_.missing.end(), name) != report_.missing.end()) return;
    report_.missing.push_back(name);
    check_count();
}

} // namespace spa::import
