// SPDX-License-Identifier: Apache-2.0
// Compute shaders with ray queries.
#include "kernel.h"

#include <spirv/render.comp.h>

#include "../core/error.h"

#include <algorithm>

namespace spa::render {
namespace {

class QueryKernel : public Kernel {
public:
    QueryKernel(const Gpu& gpu, const vulkan::TraceConstants& tracing)
        : gpu_(gpu), layout_(gpu, VK_SHADER_STAGE_COMPUTE_BIT), module_(gpu, render_comp),
          pipeline_(gpu, make(tracing)) {}

    void use(const DeviceScene::State&) override {}
    void record(VkCommandBuffer commands, const data::RenderBatch& batch, std::uint32_t width) override {
        const Functions& call = gpu_.state().call;
        call.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.handle());
        layout_.push(commands, batch);
        const auto groups = [](std::uint32_t count) { return (count + SPA_GROUP_SIZE - 1) / SPA_GROUP_SIZE; };
        call.vkCmdDispatch(commands, groups(width), std::max(1U, groups(batch.end_row - batch.first_row)), 1);
    }

private:
    VkPipeline make(const vulkan::TraceConstants& tracing) {
        const VkSpecializationInfo constants = vulkan::specialization(tracing);
        VkComputePipelineCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
        info.stage = module_.stage(VK_SHADER_STAGE_COMPUTE_BIT, constants);
        info.layout = layout_.handle();
        VkPipeline pipeline = VK_NULL_HANDLE;
        vulkan::check(gpu_.state().call.vkCreateComputePipelines(gpu_.device().handle(), VK_NULL_HANDLE, 1,
                                                                 &info, gpu_.device().callbacks(), &pipeline),
                      "vkCreateComputePipelines");
        return pipeline;
    }

    const Gpu& gpu_;
    PipelineLayout layout_;
    ShaderModule module_;
    Pipeline pipeline_;
};

} // namespace

std::unique_ptr<Kernel> make_query_kernel(const Gpu& gpu, const vulkan::TraceConstants& tracing) {
    if (!gpu.state().tracing.queries)
        throw Error(ExitCode::unsupported,
                    "this device was opened without VK_KHR_ray_query; use the pipeline");
    return std::make_unique<QueryKernel>(gpu, tracing);
}

} // namespace spa::render
