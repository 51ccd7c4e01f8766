// SPDX-License-Identifier: Apache-2.0
// The device functions that the renderer calls beside the loader's.
#pragma once

#include "../vulkan/functions.h"

namespace spa::render {

#define SPA_RENDER_FUNCTIONS(X)                                                                              \
    X(vkCmdBindPipeline)                                                                                     \
    X(vkCmdDispatch)                                                                                         \
    X(vkCmdPushConstants)                                                                                    \
    X(vkCreateComputePipelines)                                                                              \
    X(vkCreatePipelineLayout)                                                                                \
    X(vkCreateShaderModule)                                                                                  \
    X(vkDestroyPipeline)                                                                                     \
    X(vkDestroyPipelineLayout)                                                                               \
    X(vkDestroyShaderModule)
#define SPA_RENDER_PIPELINE_FUNCTIONS(X)                                                                     \
    X(vkCmdTraceRaysKHR)                                                                                     \
    X(vkCreateRayTracingPipelinesKHR)                                                                        \
    X(vkGetRayTracingShaderGroupHandlesKHR)

#define SPA_RENDER_MEMBER(name) PFN_##name name = nullptr;
struct Functions {
    SPA_RENDER_FUNCTIONS(SPA_RENDER_MEMBER)
    SPA_RENDER_PIPELINE_FUNCTIONS(SPA_RENDER_MEMBER) // null without VK_KHR_ray_tracing_pipeline
};
#undef SPA_RENDER_MEMBER

// Throws Error{unsupported} that names a function which the device lacks.
Functions load_functions(PFN_vkGetDeviceProcAddr get_proc_addr, VkDevice device, bool pipelines);

} // namespace spa::render
