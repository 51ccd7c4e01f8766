// SPDX-License-Identifier: Apache-2.0
#include "functions.h"

#include "../core/error.h"

#include <string>

namespace spa::vulkan {
namespace {

template <class Function>
void load(PFN_vkVoidFunction found, const char* name, Function& function) {
    if (found == nullptr)
        throw Error(ExitCode::unsupported, std::string("this Vulkan device has no ") + name +
                                               "; were its extension and Vulkan 1.2 enabled?");
    function = reinterpret_cast<Function>(found);
}

} // namespace

InstanceFunctions load_functions(PFN_vkGetInstanceProcAddr get_proc_addr, VkInstance instance) {
    InstanceFunctions functions;
#define SPA_VULKAN_LOAD(name) load(get_proc_addr(instance, #name), #name, functions.name);
    SPA_VULKAN_INSTANCE_FUNCTIONS(SPA_VULKAN_LOAD)
#undef SPA_VULKAN_LOAD
    return functions;
}

DeviceFunctions load_functions(PFN_vkGetDeviceProcAddr get_proc_addr, VkDevice device) {
    DeviceFunctions functions;
#define SPA_VULKAN_LOAD(name) load(get_proc_addr(device, #name), #name, functions.name);
    SPA_VULKAN_DEVICE_FUNCTIONS(SPA_VULKAN_LOAD)
#undef SPA_VULKAN_LOAD
    return functions;
}

void check(VkResult result, const char* what) {
    if (result == VK_SUCCESS) return;
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY)
        throw Error(ExitCode::unsupported, std::string(what) + ": the device has not enough memory left");
    throw Error(ExitCode::internal,
                std::string(what) + " failed with VkResult " + std::to_string(int(result)));
}

} // namespace spa::vulkan
