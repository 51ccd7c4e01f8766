// SPDX-License-Identifier: Apache-2.0
#include "kernel.h"

#include <cstddef>

namespace spa::render {

Constants::Constants(const vulkan::TraceConstants& tracing, Pass pass)
    : values_{tracing, std::uint32_t(pass)} {
    const VkSpecializationInfo loader = vulkan::specialization(values_.tracing);
    entries_.assign(loader.pMapEntries, loader.pMapEntries + loader.mapEntryCount);
    entries_.push_back({4, offsetof(Values, pass), sizeof(std::uint32_t)});
    info_ = {std::uint32_t(entries_.size()), entries_.data(), sizeof values_, &values_};
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
                                                    const Constants& constants) const {
    VkPipelineShaderStageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage = stage;
    info.module = module_;
    info.pName = "main";
    info.pSpecializationInfo = constants.info();
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
