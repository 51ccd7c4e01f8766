// SPDX-License-Identifier: Apache-2.0
#include "file_io.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace spa::container {
namespace {

class Descriptor {
public:
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    [[nodiscard]] int get() const { return fd_; }
    // The outcome of close matters where data may still be on its way to a remote disk.
    bool close() {
        const int fd = std::exchange(fd_, -1);
        return ::close(fd) == 0;
    }

private:
    int fd_;
};

class PosixInput final : public InputFile {
public:
    explicit PosixInput(int fd) : file_(fd) {
        struct stat info {};
        regular_ = ::fstat(fd, &info) == 0 && S_ISREG(info.st_mode);
        if (regular_) size_ = std::uint64_t(info.st_size);
    }
    ~PosixInput() override {
        if (mapped_ != nullptr) ::munmap(mapped_, std::size_t(size_));
    }
    PosixInput(const PosixInput&) = delete;
    PosixInput& operator=(const PosixInput&) = delete;

    [[nodiscard]] bool is_regular() const override { return regular_; }
    [[nodiscard]] std::uint64_t size() const override { return size_; }
    std::span<const std::byte> map() override {
        if (!regular_ || size_ == 0 || size_ > std::uint64_t(PTRDIFF_MAX)) return {};
        void* const address = ::mmap(nullptr, std::size_t(size_), PROT_READ, MAP_PRIVATE, file_.get(), 0);
        if (address == MAP_FAILED) return {};
        mapped_ = address;
        return {static_cast<const std::byte*>(address), std::size_t(size_)};
    }
    bool read(std::span<std::byte> out) override {
        while (!out.empty()) {
            const ssize_t count = ::read(file_.get(), out.data(), out.size());
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) error_ = errno;
            if (count <= 0) return false;
            out = out.subspan(std::size_t(count));
        }
        return true;
    }

    [[nodiscard]] int error() const override { return error_; }

private:
    Descriptor file_;
    int error_ = 0;
    bool regular_ = false;
    std::uint64_t size_ = 0;
    void* mapped_ = nullptr;
};

Status failed(Issue issue) {
    Status status;
    status.issue = issue;
    status.system_error = errno;
    return status;
}

bool write_all(int fd, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(fd, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return false;
        bytes = bytes.subspan(std::size_t(count));
    }
    return true;
}

bool write_pieces(int fd, std::span<const std::span<const std::byte>> pieces) {
    return std::all_of(pieces.begin(), pieces.end(),
                       [fd](std::span<const std::byte> piece) { return write_all(fd, piece); });
}

// A rename is on the disk once its folder is. Some file systems cannot flush folders: not an error.
void flush_folder(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
    const Descriptor fd(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (fd.get() >= 0) ::fsync(fd.get());
}

bool is_special_file(const std::string& path) {
    struct stat info {};
    return ::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

Status write_special_file(const std::string& path, std::span<const std::span<const std::byte>> pieces) {
    Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (file.get() < 0 || !write_pieces(file.get(), pieces) || !file.close())
        return failed(Issue::cannot_write);
    return {};
}

// A new file beside `path`. Names are tried until one is free.
int create_beside(const std::string& path, std::string& name) {
    constexpr int tries = 1000;
    for (int i = 0; i < tries; ++i) {
        name = path + "." + std::to_string(::getpid()) + "." + std::to_string(i) + ".tmp";
        const int fd = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd >= 0 || errno != EEXIST) return fd;
    }
    return -1;
}

} // namespace

Status open_input(const std::string& path, std::unique_ptr<InputFile>& file) {
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) return failed(Issue::cannot_open);
    file = std::make_unique<PosixInput>(fd);
    return {};
}

Status write_file(const std::string& path, std::span<const std::span<const std::byte>> pieces) {
    if (is_special_file(path)) return write_special_file(path, pieces);
    std::string name;
    Descriptor file(create_beside(path, name));
    if (file.get() < 0) return failed(Issue::cannot_write);
    if (!write_pieces(file.get(), pieces) || ::fsync(file.get()) != 0 || !file.close() ||
        std::rename(name.c_str(), path.c_str()) != 0) {
        const Status status = failed(Issue::cannot_write);
        ::unlink(name.c_str());
        return status;
    }
    flush_folder(path);
    return {};
}

} // namespace spa::container
