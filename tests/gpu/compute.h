// SPDX-License-Identifier: Apache-2.0
// Runs a compute shader on buffers of words:
//
//   Buffer in(device, count), out(device, count);
//   write to in.words();
//   ComputePipeline pipeline(device, "twice.spv", 2, sizeof(count));
//   const Buffer* buffers[] = {&in, &out};
//   pipeline.run(buffers, std::as_bytes(std::span(&count, 1)), (count + 63) / 64);
//   read from out.words();
//
// The shader has the entry point "main", `buffer_count` storage buffers at the bindings 0, 1, ... of set 0,
// and maybe push constants. Everything throws Error{internal} if Vulkan does.
#pragma once

#include "vulkan_device.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace spa::test {

// Memory that CPU and device both see. The words are zero at first.
class Buffer {
public:
    Buffer(const VulkanDevice& device, std::size_t words); // at least one
    ~Buffer();
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;

    [[nodiscard]] std::span<std::uint32_t> words() { return words_; }
    [[nodiscard]] std::span<const std::uint32_t> words() const { return words_; }
    [[nodiscard]] VkBuffer handle() const { return buffer_.get(); }

private:
    VkDevice device_;
    DeviceHandle<VkBuffer, vkDestroyBuffer> buffer_;
    DeviceHandle<VkDeviceMemory, vkFreeMemory> memory_;
    std::span<std::uint32_t> words_;
};

class ComputePipeline {
public:
    ComputePipeline(const VulkanDevice& device, const std::filesystem::path& spirv,
                    std::uint32_t buffer_count, std::uint32_t push_constant_bytes);

    // Returns when the device has finished and what it wrote can be read. `buffers` in the order of their
    // bindings; `push_constants` has as many bytes as was said above.
    void run(std::span<const Buffer* const> buffers, std::span<const std::byte> push_constants,
             std::uint32_t groups) const;

private:
    void create_layouts(std::uint32_t buffer_count, std::uint32_t push_constant_bytes);
    void create_descriptor_set(std::uint32_t buffer_count);
    void create_pipeline(const std::filesystem::path& spirv);
    void bind(std::span<const Buffer* const> buffers) const;

    const VulkanDevice& device_;
    DeviceHandle<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout> set_layout_;
    DeviceHandle<VkPipelineLayout, vkDestroyPipelineLayout> layout_;
    DeviceHandle<VkDescriptorPool, vkDestroyDescriptorPool> descriptor_pool_;
    DeviceHandle<VkPipeline, vkDestroyPipeline> pipeline_;
    DeviceHandle<VkCommandPool, vkDestroyCommandPool> command_pool_;
    VkDescriptorSet set_ = VK_NULL_HANDLE; // belongs to the pool
};

} // namespace spa::test
