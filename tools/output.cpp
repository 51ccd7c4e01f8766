// SPDX-License-Identifier: Apache-2.0
#include "output.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <iostream>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace spa::tools {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& what, int error_number = 0) {
    std::string message = path.string() + ": " + what;
    if (error_number != 0) message += ": " + std::generic_category().message(error_number);
    throw OutputError(message, error_number);
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

struct Descriptor {
    int number;
    explicit Descriptor(int n) : number(n) {}
    ~Descriptor() { close(number); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
};

void write_bytes(const fs::path& path, int descriptor, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(path, "cannot be written", errno);
        bytes = bytes.subspan(std::size_t(written));
    }
    // Before the rename, so that a crash of the machine leaves the old file or the new one.
    if (fsync(descriptor) != 0 && errno != EINVAL) fail(path, "cannot be written", errno);
}

constexpr std::string_view random_part = ".XXXXXX"; // as mkstemp wants it

// Of the form FOLDER/.NAME.XXXXXX.
std::string temporary_template(const fs::path& folder, const fs::path& name) {
    return (folder / ("." + staged_name(name.string()).append(random_part))).string();
}

// A new, locked file. Between its making and the lock, remove_leftovers of another process can take it for
// one that was left behind; then it has no name any more.
int make_locked(const fs::path& path, std::string& name) {
    for (int attempt = 0; attempt < 100; ++attempt) {
        name = temporary_template(folder_of(path), path.filename());
        const int descriptor = mkostemp(name.data(), O_CLOEXEC);
        if (descriptor < 0) fail(path, "cannot be written", errno);
        struct stat status {};
        // A file system without locks has no remove_leftovers either.
        if (flock(descriptor, LOCK_EX) != 0 || (fstat(descriptor, &status) == 0 && status.st_nlink > 0))
            return descriptor;
        close(descriptor);
    }
    fail(path, "cannot be written: somebody removes the temporary files");
}

fs::path without_trailing_slash(const fs::path& path) {
    return path.has_filename() ? path : path.parent_path();
}

} // namespace

bool OutputError::concerns_all() const {
    constexpr std::array numbers{ENOSPC, EDQUOT, EROFS, EIO};
    return std::find(numbers.begin(), numbers.end(), number_) != numbers.end();
}

void check_output_file(const fs::path& path, std::span<const fs::path> inputs, OutputFolder folder) {
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
    fs::path there = folder_of(path);
    if (folder == OutputFolder::is_made)
        while (there.has_relative_path() && !fs::exists(there, error)) there = folder_of(there);
    check_writable_folder(there);
    for (const fs::path& input : inputs)
        if (fs::equivalent(path, input, error))
            throw Error(ExitCode::usage, path.string() + ": is both input and output; name another output");
}

void make_folders_of(const fs::path& path) {
    std::error_code error;
    fs::create_directories(folder_of(path), error);
    if (error) fail(folder_of(path), "the folder cannot be made", error.value());
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
    std::string name;
    descriptor_ = make_locked(path_, name);
    temporary_ = name;
    fchmod(descriptor_, permissions(0666));
}

StagedFile::~StagedFile() {
    std::error_code ignored;
    if (!temporary_.empty()) fs::remove(temporary_, ignored);
    close(descriptor_);
}

void StagedFile::write(std::span<const std::byte> bytes) {
    if (ftruncate(descriptor_, 0) != 0 || lseek(descriptor_, 0, SEEK_SET) != 0)
        fail(path_, "cannot be written", errno);
    write_bytes(path_, descriptor_, bytes);
}

void StagedFile::commit() {
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail(path_, "cannot be written", errno);
    temporary_.clear();
}

std::string staged_name(const std::string& final_name) {
    constexpr std::size_t longest = 200; // with what comes before and after, within any file system's limit
    return final_name.substr(0, longest);
}

void remove_leftovers(const fs::path& folder, const std::function<bool(const std::string&)>& is_ours) {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (name.size() <= 1 + random_part.size() || name[0] != '.' ||
            name[name.size() - random_part.size()] != random_part[0])
            continue;
        if (!is_ours(name.substr(1, name.size() - 1 - random_part.size()))) continue;
        const int descriptor = open(entry->path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        if (descriptor < 0) continue;
        if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) unlink(entry->path().c_str());
        close(descriptor);
    }
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
    const Descriptor descriptor(
        open((temporary_ / name).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode_t(0666)));
    if (descriptor.number < 0) fail(final_path, "cannot be written", errno);
    write_bytes(final_path, descriptor.number, bytes);
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
