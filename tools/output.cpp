// SPDX-License-Identifier: Apache-2.0
#include "output.h"

#include "../libspa/core/error.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <iostream>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace spa::tools {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& what, int error_number = 0) {
    std::string message = path.string() + ": " + what;
    if (error_number != 0) message += ": " + std::generic_category().message(error_number);
    throw Error(ExitCode::input_output, message);
}

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

void check_writable_folder(const fs::path& folder) {
    std::error_code error;
    const fs::file_status status = fs::status(folder, error);
    if (status.type() == fs::file_type::not_found) fail(folder, "no such folder; create it first");
    if (!fs::is_directory(status)) fail(folder, "is not a folder; name an output in a folder that exists");
    if (access(folder.c_str(), W_OK | X_OK) != 0) fail(folder, "the folder may not be written to", errno);
}

// New files get the permissions that open() would have given them, not mkstemp's private ones.
mode_t permissions(mode_t wanted) {
    const mode_t mask = umask(0);
    umask(mask);
    return wanted & ~mask;
}

void write_bytes(const fs::path& path, int descriptor, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) {
            const int error_number = errno;
            close(descriptor);
            fail(path, "cannot be written", error_number);
        }
        bytes = bytes.subspan(std::size_t(written));
    }
    // Before the rename, so that a crash of the machine leaves the old file or the new one.
    if (fsync(descriptor) != 0 && errno != EINVAL) {
        const int error_number = errno;
        close(descriptor);
        fail(path, "cannot be written", error_number);
    }
    if (close(descriptor) != 0) fail(path, "cannot be written", errno);
}

// Of the form FOLDER/.NAME.XXXXXX. The name is cut so that the whole stays within any file system's limit.
std::string temporary_template(const fs::path& folder, const fs::path& name) {
    std::string file = ".";
    file.append(name.string(), 0, 200).append(".XXXXXX");
    return (folder / file).string();
}

fs::path without_trailing_slash(const fs::path& path) {
    return path.has_filename() ? path : path.parent_path();
}

} // namespace

void check_output_file(const fs::path& path, std::span<const fs::path> inputs) {
    if (path.empty()) throw Error(ExitCode::usage, "the name of the output file is empty");
    if (path == "-")
        throw Error(ExitCode::usage, "the output cannot be standard output: it is written under a temporary "
                                     "name and renamed; name a file");
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::is_directory(status)) fail(path, "is a folder; name a file in it");
    if (!path.has_filename()) fail(path, "names a folder; name a file in it");
    if (fs::exists(status) && !fs::is_regular_file(status))
        fail(path, "is not a regular file, and would be replaced by one; name another file");
    check_writable_folder(folder_of(path));
    for (const fs::path& input : inputs)
        if (fs::equivalent(path, input, error))
            throw Error(ExitCode::usage, path.string() + ": is both input and output; name another output");
}

void check_output_folder(const fs::path& given) {
    if (given.empty()) throw Error(ExitCode::usage, "the name of the output folder is empty");
    const fs::path path = without_trailing_slash(given);
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::exists(status)) {
        if (!fs::is_directory(status)) fail(path, "is not a folder; name another folder");
        check_writable_folder(path);
    } else {
        check_writable_folder(folder_of(path));
    }
}

StagedFile::StagedFile(fs::path path) : path_(std::move(path)) {
    std::string name = temporary_template(folder_of(path_), path_.filename());
    const int descriptor = mkstemp(name.data());
    if (descriptor < 0) fail(path_, "cannot be written", errno);
    temporary_ = name;
    fchmod(descriptor, permissions(0666));
    close(descriptor);
}

StagedFile::~StagedFile() {
    std::error_code ignored;
    if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void StagedFile::write(std::span<const std::byte> bytes) {
    const int descriptor = open(temporary_.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
    if (descriptor < 0) fail(path_, "cannot be written", errno);
    write_bytes(path_, descriptor, bytes);
}

void StagedFile::commit() {
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_, "cannot be written", errno);
    temporary_.clear();
}

StagedFolder::StagedFolder(const fs::path& path)
    : path_(without_trailing_slash(path)), exists_(fs::exists(path_)) {
    std::string name = temporary_template(exists_ ? path_ : folder_of(path_), path_.filename());
    if (mkdtemp(name.data()) == nullptr) fail(path_, "cannot be written", errno);
    temporary_ = name;
    chmod(temporary_.c_str(), permissions(0777));
}

StagedFolder::~StagedFolder() {
    std::error_code ignored;
    if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
}

void StagedFolder::write(const std::string& name, std::span<const std::byte> bytes) {
    const fs::path final_path = path_ / name;
    if (exists_ && fs::is_directory(final_path))
        fail(final_path, "is a folder, where a file is to be written");
    const int descriptor =
        open((temporary_ / name).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode_t(0666));
    if (descriptor < 0) fail(final_path, "cannot be written", errno);
    write_bytes(final_path, descriptor, bytes);
    names_.push_back(name);
}

void StagedFolder::commit() {
    if (!exists_) {
        if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_, "cannot be written", errno);
        temporary_.clear();
        return;
    }
    for (const std::string& name : names_)
        if (std::rename((temporary_ / name).c_str(), (path_ / name).c_str()) != 0)
            fail(path_ / name, "cannot be written", errno);
}

void print(std::string_view text) {
    std::cout << text << std::flush;
    if (!std::cout)
        throw Error(ExitCode::input_output, "standard output cannot be written; the result was lost");
}

} // namespace spa::tools
