// SPDX-License-Identifier: Apache-2.0
#include "kernel.h"

namespace spa::render {
namespace {

bool equal(const vulkan::TraceConstants& a, const vulkan::TraceConstants& b) {
    return a.tracer == b.tracer && a.count == b.count && a.count_rule == b.count_rule &&
           a.fan_start == b.fan_start && a.hole_threshold == b.hole_threshold;
}

} // namespace

Kernel& kernel_for(const Gpu& gpu, Backend backend, const vulkan::TraceConstants& tracing) {
    std::vector<CachedKernel>& kernels = gpu.state().kernels;
    for (const CachedKernel& cached : kernels)
        if (cached.pipeline == (backend == Backend::pipeline) && equal(cached.tracing, tracing))
            return *cached.kernel;
    CachedKernel made{backend == Backend::pipeline, tracing,
                      backend == Backend::pipeline ? make_pipeline_kernel(gpu, tracing)
                                                   : make_query_kernel(gpu, tracing)};
    kernels.push_back(std::move(made));
    return *kernels.back().kernel;
}

ShaderModule::ShaderModule(const Gpu& gpu, std::span<const std::uint32_t> words) : gpu_(gpu) {
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = words.size_bytes();
    info.pCode = words.data();
    vulkan::check(gpu.state().call.vkCreateShaderModule(gpu.device().handle(), &info,
                                                        gpu.device().callbacks(), &module_),
                  "vkCreateShaderModule");
}

ShaderModule::~ShaderModule() {
    gpu_.state().call.vkDestroyShaderModule(gpu_.device().handle(), module_, gpu_.device().callbacks());
}

VkPipelineShaderStageCreateInfo ShaderModule::stage(VkShaderStageFlagBits stage,
                                                    const VkSpecializationInfo& constants) const {
    VkPipelineShaderStageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage = stage;
    info.module = module_;
    info.pName = "main";
    info.pSpecializationInfo = &constants;
    return info;
}

PipelineLayout::PipelineLayout(const Gpu& gpu, VkShaderStageFlags stages) : gpu_(gpu), stages_(stages) {
    const VkPushConstantRange range{stages, 0, sizeof(data::RenderBatch)};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &range;
    vulkan::check(gpu.state().call.vkCreatePipelineLayout(gpu.device().handle(), &info,
                                                          gpu.device().callbacks(), &layout_),
                  "vkCreatePipelineLayout");
}

PipelineLayout::~PipelineLayout() {
    gpu_.state().call.vkDestroyPipelineLayout(gpu_.device().handle(), layout_, gpu_.device().callbacks());
}

void PipelineLayout::push(VkCommandBuffer commands, const data::RenderBatch& batch) const {
    gpu_.state().call.vkCmdPushConstants(commands, layout_, stages_, 0, sizeof batch, &batch);
}

} // namespace spa::render
