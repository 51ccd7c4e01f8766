// SPDX-License-Identifier: Apache-2.0
#include "map_tracers.h"

#include "spirv_file.h"

#include "../../libspa/core/error.h"
#include "../../libspa/vulkan/submit.h"
#include "../../libspa/vulkan/top_level.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace spa::test {
namespace {

using vulkan::Buffer;
using vulkan::MemoryUse;

// The push constants of shaders/map_ray.glsl.
struct Parameters {
    VkDeviceAddress scene, rays, hits, records;
    std::uint32_t count;
};

template <class Function>
Function device_function(const VulkanDevice& device, const char* name) {
    const auto function = reinterpret_cast<Function>(vkGetDeviceProcAddr(device.handle(), name));
    if (function == nullptr) throw Error(ExitCode::unsupported, std::string("no ") + name);
    return function;
}

using Layout = DeviceHandle<VkPipelineLayout, vkDestroyPipelineLayout>;
using Pipeline = DeviceHandle<VkPipeline, vkDestroyPipeline>;
using Module = DeviceHandle<VkShaderModule, vkDestroyShaderModule>;

void create_layout(const VulkanDevice& device, VkShaderStageFlags stages, Layout& layout) {
    const VkPushConstantRange range{stages, 0, sizeof(Parameters)};
    VkPipelineLayoutCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    info.pushConstantRangeCount = 1;
    info.pPushConstantRanges = &range;
    check(vkCreatePipelineLayout(device.handle(), &info, nullptr, layout.out()), "vkCreatePipelineLayout");
}

void create_module(const VulkanDevice& device, std::span<const std::uint32_t> words, Module& module) {
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = words.size_bytes();
    info.pCode = words.data();
    check(vkCreateShaderModule(device.handle(), &info, nullptr, module.out()), "vkCreateShaderModule");
}

void create_hit_module(const Rig& rig, vulkan::HitStage stage, Module& module) {
    if (!rig.own_hit_group) {
        create_module(rig.device, vulkan::hit_stage_spirv(stage), module);
        return;
    }
    const char* name = "spa.rint.spv";
    if (stage == vulkan::HitStage::closest_hit) name = "spa.rchit.spv";
    if (stage == vulkan::HitStage::any_hit) name = "spa.rahit.spv";
    create_module(rig.device, read_spirv(rig.shaders / name), module);
}

VkPipelineShaderStageCreateInfo stage_info(VkShaderStageFlagBits stage, VkShaderModule module,
                                           const VkSpecializationInfo* specialization) {
    VkPipelineShaderStageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage = stage;
    info.module = module;
    info.pName = "main";
    info.pSpecializationInfo = specialization;
    return info;
}

class Tracer {
public:
    virtual ~Tracer() = default;
    virtual void record(VkCommandBuffer commands, const Parameters& parameters) = 0;
};

class QueryTracer : public Tracer {
public:
    QueryTracer(const Rig& rig, const VkSpecializationInfo& constants)
        : layout_(rig.device), pipeline_(rig.device) {
        create_layout(rig.device, VK_SHADER_STAGE_COMPUTE_BIT, layout_);
        Module module(rig.device);
        create_module(rig.device, read_spirv(rig.shaders / "map_query.comp.spv"), module);
        VkComputePipelineCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
        info.stage = stage_info(VK_SHADER_STAGE_COMPUTE_BIT, module.get(), &constants);
        info.layout = layout_.get();
        check(vkCreateComputePipelines(rig.device.handle(), nullptr, 1, &info, nullptr, pipeline_.out()),
              "vkCreateComputePipelines");
    }
    void record(VkCommandBuffer commands, const Parameters& parameters) override {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
        vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof parameters,
                           &parameters);
        vkCmdDispatch(commands, (parameters.count + 63) / 64, 1, 1);
    }

private:
    Layout layout_;
    Pipeline pipeline_;
};

class PipelineTracer : public Tracer {
public:
    PipelineTracer(const Rig& rig, const VkSpecializationInfo& constants, bool coverage,
                   std::span<const vulkan::ShaderRecord> records)
        : layout_(rig.device), pipeline_(rig.device),
          trace_rays_(device_function<PFN_vkCmdTraceRaysKHR>(rig.device, "vkCmdTraceRaysKHR")) {
        create_layout(rig.device, VK_SHADER_STAGE_RAYGEN_BIT_KHR, layout_);
        create_pipeline(rig, constants, coverage);
        create_table(rig, records);
    }
    void record(VkCommandBuffer commands, const Parameters& parameters) override {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_RAY_TRACING_KHR, pipeline_.get());
        vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_RAYGEN_BIT_KHR, 0, sizeof parameters,
                           &parameters);
        const VkStridedDeviceAddressRegionKHR none{};
        trace_rays_(commands, &raygen_, &miss_, &hit_, &none, parameters.count, 1, 1);
    }

private:
    void create_pipeline(const Rig& rig, const VkSpecializationInfo& constants, bool coverage) {
        std::array<Module, 5> modules{Module(rig.device), Module(rig.device), Module(rig.device),
                                      Module(rig.device), Module(rig.device)};
        create_module(rig.device, read_spirv(rig.shaders / "map_pipeline.rgen.spv"), modules[0]);
        create_module(rig.device, read_spirv(rig.shaders / "map_pipeline.rmiss.spv"), modules[1]);
        std::vector<VkPipelineShaderStageCreateInfo> stages{
            stage_info(VK_SHADER_STAGE_RAYGEN_BIT_KHR, modules[0].get(), nullptr),
            stage_info(VK_SHADER_STAGE_MISS_BIT_KHR, modules[1].get(), nullptr)};
        std::vector<vulkan::HitStage> hit_stages{vulkan::HitStage::intersection,
                                                 vulkan::HitStage::closest_hit};
        if (coverage) hit_stages.push_back(vulkan::HitStage::any_hit);
        for (std::size_t i = 0; i < hit_stages.size(); ++i) {
            create_hit_module(rig, hit_stages[i], modules[2 + i]);
            stages.push_back(stage_info(vulkan::stage_bit(hit_stages[i]), modules[2 + i].get(), &constants));
        }
        std::array<VkRayTracingShaderGroupCreateInfoKHR, 3> groups{};
        for (VkRayTracingShaderGroupCreateInfoKHR& group : groups) {
            group.sType = VK_STRUCTURE_TYPE_RAY_TRACING_SHADER_GROUP_CREATE_INFO_KHR;
            group.type = VK_RAY_TRACING_SHADER_GROUP_TYPE_GENERAL_KHR;
            group.generalShader = group.closestHitShader = group.anyHitShader = group.intersectionShader =
                VK_SHADER_UNUSED_KHR;
        }
        groups[0].generalShader = 0;
        groups[1].generalShader = 1;
        groups[2].type = VK_RAY_TRACING_SHADER_GROUP_TYPE_PROCEDURAL_HIT_GROUP_KHR;
        groups[2].intersectionShader = 2;
        groups[2].closestHitShader = 3;
        if (coverage) groups[2].anyHitShader = 4;
        VkRayTracingPipelineCreateInfoKHR info{};
        info.sType = VK_STRUCTURE_TYPE_RAY_TRACING_PIPELINE_CREATE_INFO_KHR;
        info.stageCount = std::uint32_t(stages.size());
        info.pStages = stages.data();
        info.groupCount = std::uint32_t(groups.size());
        info.pGroups = groups.data();
        info.maxPipelineRayRecursionDepth = 1;
        info.layout = layout_.get();
        const auto create =
            device_function<PFN_vkCreateRayTracingPipelinesKHR>(rig.device, "vkCreateRayTracingPipelinesKHR");
        check(create(rig.device.handle(), nullptr, nullptr, 1, &info, nullptr, pipeline_.out()),
              "vkCreateRayTracingPipelinesKHR");
    }

    // Ray generation, miss, then a hit record for each of `records`.
    void create_table(const Rig& rig, std::span<const vulkan::ShaderRecord> records) {
        VkPhysicalDeviceRayTracingPipelinePropertiesKHR limits{};
        limits.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_PROPERTIES_KHR;
        VkPhysicalDeviceProperties2 properties{};
        properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
        properties.pNext = &limits;
        vkGetPhysicalDeviceProperties2(rig.device.physical_device(), &properties);
        const std::size_t handle = limits.shaderGroupHandleSize;
        std::vector<std::byte> handles(3 * handle);
        const auto get = device_function<PFN_vkGetRayTracingShaderGroupHandlesKHR>(
            rig.device, "vkGetRayTracingShaderGroupHandlesKHR");
        check(get(rig.device.handle(), pipeline_.get(), 0, 3, handles.size(), handles.data()),
              "vkGetRayTracingShaderGroupHandlesKHR");

        const VkDeviceSize base = std::max<VkDeviceSize>(64, limits.shaderGroupBaseAlignment);
        const VkDeviceSize stride =
            vulkan::align(handle + sizeof(vulkan::ShaderRecord),
                          std::max<VkDeviceSize>(64, limits.shaderGroupHandleAlignment));
        table_ = Buffer(rig.loader, 3 * base + stride * records.size(),
                        VK_BUFFER_USAGE_SHADER_BINDING_TABLE_BIT_KHR, MemoryUse::upload);
        const VkDeviceSize first = vulkan::align(table_.address(), base) - table_.address();
        std::byte* const bytes = table_.bytes().data() + first;
        std::memcpy(bytes, handles.data(), handle);
        std::memcpy(bytes + base, handles.data() + handle, handle);
        for (std::size_t i = 0; i < records.size(); ++i) {
            std::byte* const record = bytes + 2 * base + i * stride;
            std::memcpy(record, handles.data() + 2 * handle, handle);
            std::memcpy(record + handle, &records[i], sizeof records[i]);
        }
        const VkDeviceAddress address = table_.address() + first;
        raygen_ = {address, base, base};
        miss_ = {address + base, base, base};
        hit_ = {address + 2 * base, stride, stride * records.size()};
    }

    Layout layout_;
    Pipeline pipeline_;
    PFN_vkCmdTraceRaysKHR trace_rays_;
    Buffer table_;
    VkStridedDeviceAddressRegionKHR raygen_{}, miss_{}, hit_{};
};

template <class T>
Buffer uploaded(const vulkan::Device& device, std::span<const T> values) {
    Buffer buffer(device, values.size_bytes(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, MemoryUse::upload);
    std::memcpy(buffer.bytes().data(), values.data(), values.size_bytes());
    return buffer;
}

} // namespace

std::vector<WorldHit> trace_maps(const Rig& rig, Backend backend,
                                 std::span<const VkAccelerationStructureInstanceKHR> instances,
                                 std::span<const vulkan::ShaderRecord> records,
                                 const vulkan::TraceConstants& constants, bool coverage,
                                 std::span<const WorldRay> rays) {
    const VkSpecializationInfo specialization = vulkan::specialization(constants);
    std::unique_ptr<Tracer> tracer;
    if (backend == Backend::query)
        tracer = std::make_unique<QueryTracer>(rig, specialization);
    else
        tracer = std::make_unique<PipelineTracer>(rig, specialization, coverage, records);

    vulkan::TopLevel scene(rig.loader, instances);
    const Buffer ray_buffer = uploaded(rig.loader, rays);
    const Buffer record_buffer = uploaded(rig.loader, records);
    const Buffer hit_buffer(rig.loader, rays.size() * sizeof(WorldHit), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                            MemoryUse::readback);
    const Parameters parameters{scene.structure().address(), ray_buffer.address(), hit_buffer.address(),
                                record_buffer.address(), std::uint32_t(rays.size())};
    vulkan::submit_and_wait(
        rig.loader, rig.device.queue(), rig.device.queue_family(), [&](VkCommandBuffer commands) {
            scene.record(commands);
            tracer->record(commands, parameters);
            VkMemoryBarrier barrier{};
            barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
            barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
            barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
            vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0,
                                 1, &barrier, 0, nullptr, 0, nullptr);
        });
    std::vector<WorldHit> hits(rays.size());
    std::memcpy(hits.data(), hit_buffer.bytes().data(), hits.size() * sizeof(WorldHit));
    return hits;
}

} // namespace spa::test
