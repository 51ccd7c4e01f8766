// SPDX-License-Identifier: Apache-2.0
// A file system in memory that is small, or read-only. Linux.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace spa::test {

class SmallDisk {
public:
    // Mounts one on `folder`, which is made; only this process and those that it starts see it. options: of
    // tmpfs, such as "size=64k" or "nr_inodes=10". Null where this process may not mount.
    static std::unique_ptr<SmallDisk> mount_on(const std::filesystem::path& folder,
                                               const std::string& options);
    ~SmallDisk();
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;

    // Changes the options. False if the system refuses, as it does to make read-only what is written to.
    [[nodiscard]] bool change(const std::string& options, bool read_only = false) const;

private:
    explicit SmallDisk(std::filesystem::path folder) : folder_(std::move(folder)) {}
    std::filesystem::path folder_;
};

} // namespace spa::test
