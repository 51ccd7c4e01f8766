// SPDX-License-Identifier: Apache-2.0
#include "compute.h"

#include "spirv_file.h"

#include "../../libspa/core/error.h"

#include <algorithm>
#include <string>
#include <vector>

namespace spa::test {
Buffer::Buffer(const VulkanDevice& device, std::size_t words)
    : device_(device.handle()), buffer_(device), memory_(device) {
    const VkDeviceSize bytes = words * sizeof(std::uint32_t);
    if (bytes > device.limits().maxStorageBufferRange)
        throw Error(ExitCode::internal,
                    "a storage buffer of " + std::to_string(bytes) + " bytes is too large");
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = bytes;
    info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
    check(vkCreateBuffer(device_, &info, nullptr, buffer_.out()), "vkCreateBuffer");

    VkMemoryRequirements requirements{};
    vkGetBufferMemoryRequirements(device_, buffer_.get(), &requirements);
    VkMemoryAllocateInfo allocation{};
    allocation.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    allocation.allocationSize = requirements.size;
    allocation.memoryTypeIndex = device.host_memory_type(requirements.memoryTypeBits);
    check(vkAllocateMemory(device_, &allocation, nullptr, memory_.out()), "vkAllocateMemory");
    check(vkBindBufferMemory(device_, buffer_.get(), memory_.get(), 0), "vkBindBufferMemory");

    void* mapped = nullptr;
    check(vkMapMemory(device_, memory_.get(), 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
    words_ = {static_cast<std::uint32_t*>(mapped), words};
    std::fill(words_.begin(), words_.end(), 0U);
}

Buffer::~Buffer() { vkUnmapMemory(device_, memory_.get()); }

ComputePipeline::ComputePipeline(const VulkanDevice& device, const std::filesystem::path& spirv,
                                 std::uint32_t buffer_count, std::uint32_t push_constant_bytes)
    : device_(device), set_layout_(device), layout_(device), descriptor_pool_(device), pipeline_(device),
      command_pool_(device) {
    create_layouts(buffer_count, push_constant_bytes);
    create_descriptor_set(buffer_count);
    create_pipeline(spirv);
    VkCommandPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    info.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    info.queueFamilyIndex = device_.queue_family();
    check(vkCreateCommandPool(device_.handle(), &info, nullptr, command_pool_.out()), "vkCreateCommandPool");
}

void ComputePipeline::create_layouts(std::uint32_t buffer_count, std::uint32_t push_constant_bytes) {
    std::vector<VkDescriptorSetLayoutBinding> bindings(buffer_count);
    for (std::uint32_t i = 0; i < buffer_count; ++i) {
        bindings[i].binding = i;
        bindings[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        bindings[i].descriptorCount = 1;
        bindings[i].stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
    }
    VkDescriptorSetLayoutCreateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    set.bindingCount = buffer_count;
    set.pBindings = bindings.data();
    check(vkCreateDescriptorSetLayout(device_.handle(), &set, nullptr, set_layout_.out()),
          "vkCreateDescriptorSetLayout");

    VkPushConstantRange range{};
    range.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
    range.size = push_constant_bytes;
    const VkDescriptorSetLayout set_layout = set_layout_.get();
    VkPipelineLayoutCreateInfo layout{};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &set_layout;
    layout.pushConstantRangeCount = push_constant_bytes > 0 ? 1 : 0;
    layout.pPushConstantRanges = &range;
    check(vkCreatePipelineLayout(device_.handle(), &layout, nullptr, layout_.out()),
          "vkCreatePipelineLayout");
}

void ComputePipeline::create_descriptor_set(std::uint32_t buffer_count) {
    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, buffer_count};
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    check(vkCreateDescriptorPool(device_.handle(), &pool, nullptr, descriptor_pool_.out()),
          "vkCreateDescriptorPool");
    const VkDescriptorSetLayout set_layout = set_layout_.get();
    VkDescriptorSetAllocateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    set.descriptorPool = descriptor_pool_.get();
    set.descriptorSetCount = 1;
    set.pSetLayouts = &set_layout;
    check(vkAllocateDescriptorSets(device_.handle(), &set, &set_), "vkAllocateDescriptorSets");
}

void ComputePipeline::create_pipeline(const std::filesystem::path& spirv) {
    const std::vector<std::uint32_t> code = read_spirv(spirv);
    DeviceHandle<VkShaderModule, vkDestroyShaderModule> module(device_);
    VkShaderModuleCreateInfo shader{};
    shader.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    shader.codeSize = code.size() * sizeof(code[0]);
    shader.pCode = code.data();
    check(vkCreateShaderModule(device_.handle(), &shader, nullptr, module.out()), "vkCreateShaderModule");

    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module.get();
    info.stage.pName = "main";
    info.layout = layout_.get();
    check(vkCreateComputePipelines(device_.handle(), VK_NULL_HANDLE, 1, &info, nullptr, pipeline_.out()),
          "vkCreateComputePipelines");
}

void ComputePipeline::bind(std::span<const Buffer* const> buffers) const {
    std::vector<VkDescriptorBufferInfo> infos(buffers.size());
    std::vector<VkWriteDescriptorSet> writes(buffers.size());
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        infos[i] = {buffers[i]->handle(), 0, VK_WHOLE_SIZE};
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = set_;
        writes[i].dstBinding = std::uint32_t(i);
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
        writes[i].pBufferInfo = &infos[i];
    }
    vkUpdateDescriptorSets(device_.handle(), std::uint32_t(writes.size()), writes.data(), 0, nullptr);
}

void ComputePipeline::run(std::span<const Buffer* const> buffers, std::span<const std::byte> push_constants,
                          std::uint32_t groups) const {
    bind(buffers);
    VkCommandBufferAllocateInfo allocation{};
    allocation.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocation.commandPool = command_pool_.get();
    allocation.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocation.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    check(vkAllocateCommandBuffers(device_.handle(), &allocation, &commands), "vkAllocateCommandBuffers");

    VkCommandBufferBeginInfo begin{};
    begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_.get(), 0, 1, &set_, 0, nullptr);
    if (!push_constants.empty())
        vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                           std::uint32_t(push_constants.size()), push_constants.data());
    vkCmdDispatch(commands, groups, 1, 1);
    // The fence alone does not make the device's writes visible to the CPU.
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                         &barrier, 0, nullptr, 0, nullptr);
    check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");

    DeviceHandle<VkFence, vkDestroyFence> fence(device_);
    VkFenceCreateInfo fence_info{};
    fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    check(vkCreateFence(device_.handle(), &fence_info, nullptr, fence.out()), "vkCreateFence");
    VkSubmitInfo submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    check(vkQueueSubmit(device_.queue(), 1, &submit, fence.get()), "vkQueueSubmit");
    const VkFence waited = fence.get();
    check(vkWaitForFences(device_.handle(), 1, &waited, VK_TRUE, UINT64_MAX), "vkWaitForFences");
    vkFreeCommandBuffers(device_.handle(), command_pool_.get(), 1, &commands);
}

} // namespace spa::test
