// SPDX-License-Identifier: Apache-2.0
#include "small_disk.h"

#include <sched.h>
#include <sys/mount.h>

namespace spa::test {

std::unique_ptr<SmallDisk> SmallDisk::mount_on(const std::filesystem::path& folder,
                                               const std::string& options) {
    std::filesystem::create_directories(folder);
    if (unshare(CLONE_NEWNS) != 0 || mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        mount("tmpfs", folder.c_str(), "tmpfs", 0, options.c_str()) != 0)
        return nullptr;
    return std::unique_ptr<SmallDisk>(new SmallDisk(folder));
}

SmallDisk::~SmallDisk() { umount2(folder_.c_str(), MNT_DETACH); }

bool SmallDisk::change(const std::string& options, bool read_only) const {
    const unsigned long flags = read_only ? MS_REMOUNT | MS_RDONLY : MS_REMOUNT;
    return mount("tmpfs", folder_.c_str(), "tmpfs", flags, options.c_str()) == 0;
}

} // namespace spa::test
