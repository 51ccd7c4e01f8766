// SPDX-License-Identifier: Apache-2.0
// The shaders on a device, by one way to trace or the other.
#pragma once

#include "device_scene.h"
#include "gpu_state.h"

#include <memory>

namespace spa::render {

class Kernel {
public:
    Kernel() = default;
    virtual ~Kernel() = default;
    Kernel(const Kernel&) = delete;
    Kernel& operator=(const Kernel&) = delete;

    // What is recorded from now on is of this scene. While nothing submitted is on its way.
    virtual void use(const DeviceScene::State& scene) = 0;
    // Rows batch.first_row to batch.end_row of pictures of this width. Without rows shaders start all the
    // same.
    virtual void record(VkCommandBuffer commands, const data::RenderBatch& batch, std::uint32_t width) = 0;
};

// Throw Error{unsupported} if the device was made without what they trace by.
std::unique_ptr<Kernel> make_query_kernel(const Gpu& gpu, const vulkan::TraceConstants& tracing);
std::unique_ptr<Kernel> make_pipeline_kernel(const Gpu& gpu, const vulkan::TraceConstants& tracing);

// The kernel of this kind, made if it is not there yet; the Gpu keeps it.
Kernel& kernel_for(const Gpu& gpu, Backend backend, const vulkan::TraceConstants& tracing);

class ShaderModule {
public:
    ShaderModule(const Gpu& gpu, std::span<const std::uint32_t> words);
    ~ShaderModule();
    ShaderModule(const ShaderModule&) = delete;
    ShaderModule& operator=(const ShaderModule&) = delete;
    [[nodiscard]] VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits stage,
                                                        const VkSpecializationInfo& constants) const;

private:
    const Gpu& gpu_;
    VkShaderModule module_ = VK_NULL_HANDLE;
};

// RenderBatch as push constants, and no descriptors.
class PipelineLayout {
public:
    PipelineLayout(const Gpu& gpu, VkShaderStageFlags stages);
    ~PipelineLayout();
    PipelineLayout(const PipelineLayout&) = delete;
    PipelineLayout& operator=(const PipelineLayout&) = delete;
    [[nodiscard]] VkPipelineLayout handle() const { return layout_; }
    void push(VkCommandBuffer commands, const data::RenderBatch& batch) const;

private:
    const Gpu& gpu_;
    VkShaderStageFlags stages_;
    VkPipelineLayout layout_ = VK_NULL_HANDLE;
};

class Pipeline {
public:
    // handle: from now on this object's.
    Pipeline(const Gpu& gpu, VkPipeline handle) : gpu_(gpu), handle_(handle) {}
    ~Pipeline() {
        gpu_.state().call.vkDestroyPipeline(gpu_.device().handle(), handle_, gpu_.device().callbacks());
    }
    Pipeline(const Pipeline&) = delete;
    Pipeline& operator=(const Pipeline&) = delete;
    [[nodiscard]] VkPipeline handle() const { return handle_; }

private:
    const Gpu& gpu_;
    VkPipeline handle_;
};

} // namespace spa::render
