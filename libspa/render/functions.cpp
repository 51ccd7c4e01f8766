// SPDX-License-Identifier: Apache-2.0
#include "functions.h"

#include "../core/error.h"

#include <string>

namespace spa::render {
namespace {

template <class Function>
void load(PFN_vkVoidFunction found, const char* name, Function& function) {
    if (found == nullptr)
        throw Error(ExitCode::unsupported, std::string("this Vulkan device has no ") + name);
    function = reinterpret_cast<Function>(found);
}

} // namespace

Functions load_functions(PFN_vkGetDeviceProcAddr get_proc_addr, VkDevice device, bool pipelines) {
    Functions functions;
#define SPA_RENDER_LOAD(name) load(get_proc_addr(device, #name), #name, functions.name);
    SPA_RENDER_FUNCTIONS(SPA_RENDER_LOAD)
    if (pipelines) {
        SPA_RENDER_PIPELINE_FUNCTIONS(SPA_RENDER_LOAD)
    }
#undef SPA_RENDER_LOAD
    return functions;
}

} // namespace spa::render
