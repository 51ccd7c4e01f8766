// SPDX-License-Identifier: Apache-2.0
// For systems without POSIX: files are read into memory, and flushing to the disk is left to the system.
#include "file_io.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>

namespace spa::container {
namespace {

class StandardInput final : public InputFile {
public:
    StandardInput(const std::string& path, std::ifstream stream) : stream_(std::move(stream)) {
        std::error_code error;
        regular_ = std::filesystem::is_regular_file(path, error) && !error;
        if (regular_) size_ = std::filesystem::file_size(path, error);
        if (error) regular_ = false;
    }
    [[nodiscard]] bool is_regular() const override { return regular_; }
    [[nodiscard]] std::uint64_t size() const override { return size_; }
    std::span<const std::byte> map() override { return {}; }
    bool read(std::span<std::byte> out) override {
        errno = 0;
        if (stream_.read(reinterpret_cast<char*>(out.data()), std::streamsize(out.size()))) return true;
        if (!stream_.eof()) error_ = errno;
        return false;
    }
    [[nodiscard]] int error() const override { return error_; }

private:
    std::ifstream stream_;
    int error_ = 0;
    bool regular_ = false;
    std::uint64_t size_ = 0;
};

Status failed(Issue issue, int system_error) {
    Status status;
    status.issue = issue;
    status.system_error = system_error;
    return status;
}

bool write_pieces(const std::string& name, std::span<const std::span<const std::byte>> pieces) {
    std::ofstream stream(name, std::ios::binary | std::ios::trunc);
    for (const std::span<const std::byte> piece : pieces)
        stream.write(reinterpret_cast<const char*>(piece.data()), std::streamsize(piece.size()));
    stream.close();
    return bool(stream);
}

} // namespace

Status open_input(const std::string& path, std::unique_ptr<InputFile>& file) {
    errno = 0;
    std::ifstream stream(path, std::ios::binary);
    if (!stream) return failed(Issue::cannot_open, errno);
    file = std::make_unique<StandardInput>(path, std::move(stream));
    return {};
}

Status write_file(const std::string& path, std::span<const std::span<const std::byte>> pieces) {
    const std::string name = path + ".tmp";
    errno = 0;
    if (!write_pieces(name, pieces)) {
        const int system_error = errno;
        std::remove(name.c_str());
        return failed(Issue::cannot_write, system_error);
    }
    std::error_code error;
    std::filesystem::rename(name, path, error);
    if (!error) return {};
    std::remove(name.c_str());
    return failed(Issue::cannot_write, error.value());
}

} // namespace spa::container
