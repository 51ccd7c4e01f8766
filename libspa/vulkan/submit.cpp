// SPDX-License-Identifier: Apache-2.0
#include "submit.h"

namespace spa::vulkan {
namespace {

// Destroyed with its command buffer and fence, which the device no longer uses then.
class Submission {
public:
    Submission(const Device& device, std::uint32_t queue_family) : device_(device) {
        const DeviceFunctions& call = device.call();
        VkCommandPoolCreateInfo pool{};
        pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
        pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
        pool.queueFamilyIndex = queue_family;
        check(call.vkCreateCommandPool(device.handle(), &pool, device.callbacks(), &pool_),
              "vkCreateCommandPool");
    }
    ~Submission() {
        device_.call().vkDestroyFence(device_.handle(), fence_, device_.callbacks());
        device_.call().vkDestroyCommandPool(device_.handle(), pool_, device_.callbacks());
    }
    Submission(const Submission&) = delete;
    Submission& operator=(const Submission&) = delete;

    VkCommandBuffer begin() {
        VkCommandBufferAllocateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        info.commandPool = pool_;
        info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
        info.commandBufferCount = 1;
        check(device_.call().vkAllocateCommandBuffers(device_.handle(), &info, &commands_),
              "vkAllocateCommandBuffers");
        VkCommandBufferBeginInfo begin{};
        begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
        check(device_.call().vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
        return commands_;
    }
    void submit_and_wait(VkQueue queue) {
        const DeviceFunctions& call = device_.call();
        check(call.vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
        VkFenceCreateInfo fence{};
        fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        check(call.vkCreateFence(device_.handle(), &fence, device_.callbacks(), &fence_), "vkCreateFence");
        VkSubmitInfo submit{};
        submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        submit.commandBufferCount = 1;
        submit.pCommandBuffers = &commands_;
        check(call.vkQueueSubmit(queue, 1, &submit, fence_), "vkQueueSubmit");
        check(call.vkWaitForFences(device_.handle(), 1, &fence_, VK_TRUE, UINT64_MAX), "vkWaitForFences");
    }

private:
    const Device& device_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE; // belongs to the pool
    VkFence fence_ = VK_NULL_HANDLE;
};

} // namespace

void submit_and_wait(const Device& device, VkQueue queue, std::uint32_t queue_family,
                     const std::function<void(VkCommandBuffer)>& record) {
    Submission submission(device, queue_family);
    record(submission.begin());
    submission.submit_and_wait(queue);
}

} // namespace spa::vulkan
