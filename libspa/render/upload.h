// SPDX-License-Identifier: Apache-2.0
// Device buffers with contents, through staging memory.
#pragma once

#include "gpu.h"

#include "../vulkan/buffer.h"

#include <span>

namespace spa::render {

// What shaders and builds of acceleration structures may read. Later submissions see it. Of no bytes: an
// empty buffer, whose address is 0.
vulkan::Buffer upload_bytes(const Gpu& gpu, std::span<const std::byte> bytes);

template <class T>
vulkan::Buffer upload(const Gpu& gpu, const std::vector<T>& values) {
    return upload_bytes(gpu, std::as_bytes(std::span(values)));
}

// bytes into `buffer`, which has VK_BUFFER_USAGE_TRANSFER_DST_BIT, from `offset` on.
void copy_bytes(const Gpu& gpu, std::span<const std::byte> bytes, const vulkan::Buffer& buffer,
                VkDeviceSize offset);

// The beginning of `buffer`, which has VK_BUFFER_USAGE_TRANSFER_SRC_BIT, into `bytes`.
void download_bytes(const Gpu& gpu, const vulkan::Buffer& buffer, std::span<std::byte> bytes);

} // namespace spa::render
