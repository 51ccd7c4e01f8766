// SPDX-License-Identifier: Apache-2.0
#include "open_file.h"

#include "../../libspa/core/error.h"

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace spa::import {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_to_read(const fs::path& path, const std::string& why) {
    throw Error(ExitCode::input_output, path.string() + ": cannot be read: " + why);
}

std::string system_message(int code) { return std::generic_category().message(code); }

// File systems hold years that 64 bits of nanoseconds do not, so it may wrap around; only equality matters.
std::int64_t nanoseconds(const timespec& time) {
    return std::int64_t(std::uint64_t(time.tv_sec) * 1'000'000'000U + std::uint64_t(time.tv_nsec));
}

FileState state_of(const struct stat& info) {
    return {info.st_dev, info.st_ino, std::uint64_t(info.st_size), nanoseconds(info.st_mtim),
            nanoseconds(info.st_ctim)};
}

// The kernel's own answer if /proc is there; otherwise that of the name, if it still leads to the same file.
fs::path real_path_of(int descriptor, const fs::path& path) {
    std::error_code code;
    fs::path real = fs::read_symlink("/proc/self/fd/" + std::to_string(descriptor), code);
    if (!code && real.is_absolute()) return real;
    real = fs::canonical(path, code);
    struct stat opened {};
    struct stat named {};
    const bool same = !code && ::fstat(descriptor, &opened) == 0 && ::stat(real.c_str(), &named) == 0 &&
                      opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
    return same ? real : fs::path();
}

} // namespace

std::optional<FileState> file_state(const fs::path& path) {
    struct stat info {};
    if (::stat(path.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) return std::nullopt;
    return state_of(info);
}

OpenFile::OpenFile(fs::path path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}

OpenFile::OpenFile(OpenFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), state_(other.state_) {
}

OpenFile::~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

std::optional<OpenFile> OpenFile::open(const fs::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    if (descriptor < 0) {
        // A name that no file can have is that of a missing file too.
        for (const int missing : {ENOENT, ENOTDIR, ENAMETOOLONG, ELOOP})
            if (errno == missing) return std::nullopt;
        fail_to_read(path, errno == ENXIO ? "not a regular file" : system_message(errno));
    }
    OpenFile file(path, descriptor);
    struct stat info {};
    if (::fstat(descriptor, &info) != 0) fail_to_read(path, system_message(errno));
    if (!S_ISREG(info.st_mode)) fail_to_read(path, "not a regular file");
    file.state_ = state_of(info);
    return file;
}

fs::path OpenFile::real_path() const { return real_path_of(descriptor_, path_); }

std::vector<std::byte> OpenFile::read(std::uint64_t most) const {
    std::vector<std::byte> bytes(static_cast<std::size_t>(std::min(most, state_.size)));
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t count = ::pread(descriptor_, bytes.data() + done, bytes.size() - done, off_t(done));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail_to_read(path_, system_message(errno));
        if (count == 0) break;
        done += std::size_t(count);
    }
    struct stat info {};
    if (::fstat(descriptor_, &info) != 0) fail_to_read(path_, system_message(errno));
    // A file that ended early was cut, so its size differs.
    if (state_of(info) != state_)
        throw Error(ExitCode::input_output, path_.string() + ": changed while it was read; try again");
    return bytes;
}

fs::path real_folder(const fs::path& folder) {
    const fs::path path = folder.empty() ? "." : folder;
    const int descriptor = ::open(path.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return {};
    fs::path real = real_path_of(descriptor, path);
    ::close(descriptor);
    return real;
}

} // namespace spa::import
