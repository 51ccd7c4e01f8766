// SPDX-License-Identifier: Apache-2.0
#include "upload.h"

#include "../vulkan/build.h"
#include "../vulkan/submit.h"

#include <algorithm>
#include <cstring>

namespace spa::render {
namespace {

// More is copied piece by piece, so that staging memory stays small.
constexpr std::size_t staging_bytes = std::size_t(64) << 20;

} // namespace

vulkan::Buffer upload_bytes(const Gpu& gpu, std::span<const std::byte> bytes) {
    if (bytes.empty()) return {};
    const vulkan::Device& device = gpu.device();
    vulkan::Buffer buffer(device, bytes.size(),
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                              VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR,
                          vulkan::MemoryUse::device);
    copy_bytes(gpu, bytes, buffer, 0);
    return buffer;
}

void copy_bytes(const Gpu& gpu, std::span<const std::byte> bytes, const vulkan::Buffer& buffer,
                VkDeviceSize offset) {
    const vulkan::Device& device = gpu.device();
    const vulkan::Buffer staging(device, std::min(bytes.size(), staging_bytes),
                                 VK_BUFFER_USAGE_TRANSFER_SRC_BIT, vulkan::MemoryUse::upload);
    for (std::size_t done = 0; done < bytes.size();) {
        const std::span<const std::byte> piece =
            bytes.subspan(done, std::min(bytes.size() - done, staging_bytes));
        std::memcpy(staging.bytes().data(), piece.data(), piece.size());
        vulkan::submit_and_wait(device, gpu.queue(), gpu.queue_family(), [&](VkCommandBuffer commands) {
            const VkBufferCopy copy{0, offset + done, piece.size()};
            device.call().vkCmdCopyBuffer(commands, staging.handle(), buffer.handle(), 1, &copy);
            vulkan::memory_barrier(device.call(), commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                   VK_ACCESS_TRANSFER_WRITE_BIT,
                                   VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_ACCELERATION_STRUCTURE_READ_BIT_KHR);
        });
        done += piece.size();
    }
}

void download_bytes(const Gpu& gpu, const vulkan::Buffer& buffer, std::span<std::byte> bytes) {
    if (bytes.empty()) return;
    const vulkan::Device& device = gpu.device();
    const vulkan::Buffer staging(device, std::min(bytes.size(), staging_bytes),
                                 VK_BUFFER_USAGE_TRANSFER_DST_BIT, vulkan::MemoryUse::readback);
    for (std::size_t done = 0; done < bytes.size();) {
        const std::span<std::byte> piece = bytes.subspan(done, std::min(bytes.size() - done, staging_bytes));
        vulkan::submit_and_wait(device, gpu.queue(), gpu.queue_family(), [&](VkCommandBuffer commands) {
            vulkan::memory_barrier(device.call(), commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                                   VK_ACCESS_SHADER_WRITE_BIT, VK_ACCESS_TRANSFER_READ_BIT);
            const VkBufferCopy copy{done, 0, piece.size()};
            device.call().vkCmdCopyBuffer(commands, buffer.handle(), staging.handle(), 1, &copy);
            VkMemoryBarrier to_host{};
            to_host.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
            to_host.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
            to_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
            device.call().vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT,
                                               VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &to_host, 0, nullptr, 0,
                                               nullptr);
        });
        std::memcpy(piece.data(), staging.bytes().data(), piece.size());
        done += piece.size();
    }
}

} // namespace spa::render
