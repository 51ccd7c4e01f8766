// SPDX-License-Identifier: Apache-2.0
// A ray-tracing pipeline. Groups: ray generation, miss, triangles, maps.
#include "kernel.h"
#include "upload.h"

#include <spirv/map.rchit.h>
#include <spirv/render.rgen.h>
#include <spirv/render.rmiss.h>
#include <spirv/triangle.rahit.h>
#include <spirv/triangle.rchit.h>

#include "../core/error.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace spa::render {
namespace {

using vulkan::HitStage;

constexpr std::uint32_t raygen_group = 0, miss_group = 1, triangle_group = 2, map_group = 3, group_count = 4;
constexpr VkDeviceSize record_alignment = 64; // of shader records and tables: what any device asks for

constexpr VkShaderStageFlags stages = VK_SHADER_STAGE_RAYGEN_BIT_KHR | VK_SHADER_STAGE_MISS_BIT_KHR |
                                      VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR | VK_SHADER_STAGE_ANY_HIT_BIT_KHR |
                                      VK_SHADER_STAGE_INTERSECTION_BIT_KHR;

VkRayTracingShaderGroupCreateInfoKHR group(VkRayTracingShaderGroupTypeKHR type, std::uint32_t general,
                                           std::uint32_t closest_hit = VK_SHADER_UNUSED_KHR,
                                           std::uint32_t any_hit = VK_SHADER_UNUSED_KHR,
                                           std::uint32_t intersection = VK_SHADER_UNUSED_KHR) {
    VkRayTracingShaderGroupCreateInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR;
    info.type = type;
    info.generalShader = general;
    info.closestHitShader = closest_hit;
    info.anyHitShader = any_hit;
    info.intersectionShader = intersection;
    return info;
}

class PipelineKernel : public Kernel {
public:
    PipelineKernel(const Gpu& gpu, const vulkan::TraceConstants& tracing)
        : gpu_(gpu), layout_(gpu, stages), pipeline_(gpu, make(tracing)) {}

    // Tables of ray generation, miss and hit, one behind the other, all records of one size.
    void use(const DeviceScene::State& scene) override {
        const std::size_t handle = gpu_.state().pipeline_limits.shaderGroupHandleSize;
        std::vector<std::byte> handles(handle * group_count);
        vulkan::check(
            gpu_.state().call.vkGetRayTracingShaderGroupHandlesKHR(
                gpu_.device().handle(), pipeline_.handle(), 0, group_count, handles.size(), handles.data()),
            "vkGetRayTracingShaderGroupHandlesKHR");
        const VkDeviceSize stride = vulkan::align(handle + sizeof(vulkan::ShaderRecord), record_alignment);
        std::vector<std::byte> table;
        const auto add = [&](std::uint32_t group_index, const vulkan::ShaderRecord* record) {
            table.resize(table.size() + stride);
            std::byte* const at = table.data() + table.size() - stride;
            std::memcpy(at, handles.data() + group_index * handle, handle);
            if (record != nullptr) std::memcpy(at + handle, record, sizeof *record);
        };
        add(raygen_group, nullptr);
        add(miss_group, nullptr);
        add(triangle_group, nullptr);
        for (const vulkan::ShaderRecord& record : scene.records) add(map_group, &record);

        // The buffer may begin anywhere.
        vulkan::Buffer place(gpu_.device(), table.size() + record_alignment,
                             VK_BUFFER_USAGE_SHADER_BINDING_TABLE_BIT_KHR | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                             vulkan::MemoryUse::device);
        const VkDeviceAddress start = vulkan::align(place.address(), record_alignment);
        copy_bytes(gpu_, table, place, start - place.address());
        table_ = std::move(place);
        raygen_ = {start, stride, stride};
        miss_ = {start + stride, stride, stride};
        hit_ = {start + 2 * stride, stride, (first_map_record + scene.records.size()) * stride};
    }

    void record(VkCommandBuffer commands, const data::RenderBatch& batch, std::uint32_t width) override {
        const Functions& call = gpu_.state().call;
        call.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, pipeline_.handle());
        layout_.push(commands, batch);
        const VkStridedDeviceAddressRegionKHR none{};
        call.vkCmdTraceRaysKHR(commands, &raygen_, &miss_, &hit_, &none, width,
                               std::max(1U, batch.end_row - batch.first_row), 1);
    }

private:
    VkPipeline make(const vulkan::TraceConstants& tracing) {
        const VkSpecializationInfo constants = vulkan::specialization(tracing);
        const ShaderModule rgen(gpu_, render_rgen);
        const ShaderModule rmiss(gpu_, render_rmiss);
        const ShaderModule rchit_of_triangle(gpu_, triangle_rchit);
        const ShaderModule rahit_of_triangle(gpu_, triangle_rahit);
        const ShaderModule rchit_of_map(gpu_, map_rchit);
        const ShaderModule rint_of_map(gpu_, vulkan::hit_stage_spirv(HitStage::intersection));
        const ShaderModule rahit_of_map(gpu_, vulkan::hit_stage_spirv(HitStage::any_hit));
        const std::array shaders{
            rgen.stage(VK_SHADER_STAGE_RAYGEN_BIT_KHR, constants),
            rmiss.stage(VK_SHADER_STAGE_MISS_BIT_KHR, constants),
            rchit_of_triangle.stage(VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR, constants),
            rahit_of_triangle.stage(VK_SHADER_STAGE_ANY_HIT_BIT_KHR, constants),
            rchit_of_map.stage(VK_SHADER_STAGE_CLOSEST_HIT_BIT_KHR, constants),
            rint_of_map.stage(VK_SHADER_STAGE_INTERSECTION_BIT_KHR, constants),
            rahit_of_map.stage(VK_SHADER_STAGE_ANY_HIT_BIT_KHR, constants),
        };
        constexpr std::uint32_t unused = VK_SHADER_UNUSED_KHR;
        const std::array<VkRayTracingShaderGroupCreateInfoKHR, group_count> groups{
            group(VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR, 0),
            group(VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR, 1),
            group(VK_RAY_TRACING_SHADER_GROUP_TYPE_TRIANGLES_HIT_GROUP_KHR, unused, 2, 3),
            group(VK_RAY_TRACING_SHADER_GROUP_TYPE_PROCEDURAL_HIT_GROUP_KHR, unused, 4, 6, 5),
        };
        VkRayTracingPipelineCreateInfoKHR info{};
        info.sType = VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR;
        info.stageCount = std::uint32_t(shaders.size());
        info.pStages = shaders.data();
        info.groupCount = group_count;
        info.pGroups = groups.data();
        info.maxPipelineRayRecursionDepth = 1;
        info.layout = layout_.handle();
        VkPipeline pipeline = VK_NULL_HANDLE;
        vulkan::check(gpu_.state().call.vkCreateRayTracingPipelinesKHR(gpu_.device().handle(), VK_NULL_HANDLE,
                                                                       VK_NULL_HANDLE, 1, &info,
                                                                       gpu_.device().callbacks(), &pipeline),
                      "vkCreateRayTracingPipelinesKHR");
        return pipeline;
    }

    const Gpu& gpu_;
    PipelineLayout layout_;
    Pipeline pipeline_;
    vulkan::Buffer table_;
    VkStridedDeviceAddressRegionKHR raygen_{}, miss_{}, hit_{};
};

} // namespace

std::unique_ptr<Kernel> make_pipeline_kernel(const Gpu& gpu, const vulkan::TraceConstants& tracing) {
    if (!gpu.state().tracing.pipelines)
        throw Error(ExitCode::unsupported,
                    "this device was opened without VK_KHR_ray_tracing_pipeline; use ray queries");
    return std::make_unique<PipelineKernel>(gpu, tracing);
}

} // namespace spa::render
