// SPDX-License-Identifier: Apache-2.0
#include "source_file.h"

#include "../../libspa/core/error.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include <xxhash.h>

namespace spa::import {
namespace {

struct FileCloser {
    void operator()(std::FILE* file) const {
        if (file != nullptr) (void)std::fclose(file);
    }
};

[[noreturn]] void refuse(const std::filesystem::path& asset, std::string_view reference, const char* why) {
    std::string shown(reference.substr(0, 120));
    std::replace_if(
        shown.begin(), shown.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }, '?');
    throw Error(ExitCode::invalid_data, asset.string() + ": the reference '" + shown + "' " + why +
                                            "; references must stay inside the asset's folder");
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

std::vector<std::byte> read_file(const std::filesystem::path& path, const Limits& limits) {
    const auto fail = [&](const std::string& why) {
        throw Error(ExitCode::input_output, path.string() + ": cannot be read: " + why);
    };
    std::error_code code;
    const std::filesystem::file_status status = std::filesystem::status(path, code);
    if (!std::filesystem::exists(status)) fail("no such file; check the path");
    if (!std::filesystem::is_regular_file(status)) fail("not a regular file");
    const std::uintmax_t size = std::filesystem::file_size(path, code);
    if (code) fail(code.message());
    if (size > limits.file_bytes)
        fail("it has " + std::to_string(size) + " bytes, more than the limit of " +
             std::to_string(limits.file_bytes));

    const std::unique_ptr<std::FILE, FileCloser> file(std::fopen(path.c_str(), "rb"));
    if (!file) fail(std::generic_category().message(errno));
    std::vector<std::byte> bytes(static_cast<std::size_t>(size));
    if (std::fread(bytes.data(), 1, bytes.size(), file.get()) != bytes.size())
        fail("it ended early or the read failed");
    return bytes;
}

SourceFile describe_source(std::string name, std::span<const std::byte> bytes) {
    return {std::move(name), bytes.size(), XXH3_64bits(bytes.data(), bytes.size()), {}};
}

void add_source(Report& report, std::string name, std::span<const std::byte> bytes) {
    if (std::any_of(report.files.begin(), report.files.end(),
                    [&](const SourceFile& file) { return file.name == name; }))
        return;
    report.files.push_back(describe_source(std::move(name), bytes));
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

} // namespace spa::import
