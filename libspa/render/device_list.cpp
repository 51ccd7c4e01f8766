// SPDX-License-Identifier: Apache-2.0
#include "device_list.h"

#include "../core/error.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstring>

namespace spa::render {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

using vulkan::check;

VKAPI_ATTR VkBool32 VKAPI_CALL write_down(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    static_cast<std::vector<std::string>*>(user)->emplace_back(data->pMessage);
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(std::vector<std::string>* messages) {
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    info.pfnUserCallback = write_down;
    info.pUserData = messages;
    return info;
}

bool layer_is_installed() {
    std::uint32_t count = 0;
    check(vkEnumerateInstanceLayerProperties(&count, nullptr), "vkEnumerateInstanceLayerProperties");
    std::vector<VkLayerProperties> layers(count);
    check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "vkEnumerateInstanceLayerProperties");
    return std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
        return std::strcmp(layer.layerName, validation_layer) == 0;
    });
}

// Null if the instance lacks it.
template <class Function>
Function instance_function(VkInstance instance, const char* name) {
    return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

std::optional<std::uint32_t> compute_family(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    for (std::uint32_t family = 0; family < count; ++family)
        if ((families[family].queueFlags & VK_QUEUE_COMPUTE_BIT) != 0) return family;
    return std::nullopt;
}

FoundDevice describe(VkInstance instance, VkPhysicalDevice device, vulkan::Tracing tracing) {
    FoundDevice found;
    found.handle = device;
    VkPhysicalDeviceDriverProperties driver{};
    driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    VkPhysicalDeviceProperties old{};
    vkGetPhysicalDeviceProperties(device, &old);
    if (old.apiVersion >= VK_API_VERSION_1_2) properties.pNext = &driver;
    vkGetPhysicalDeviceProperties2(device, &properties);
    found.entry.name = old.deviceName;
    found.entry.driver = driver.driverName;
    if (*driver.driverInfo != '\0') found.entry.driver += std::string(" ") + driver.driverInfo;
    found.entry.software = old.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
    found.entry.missing = vulkan::missing(vkGetInstanceProcAddr, instance, device, tracing);
    const auto family = compute_family(device);
    if (!family) {
        if (!found.entry.missing.empty()) found.entry.missing += ", ";
        found.entry.missing += "a queue that computes";
    }
    found.queue_family = family.value_or(0);
    return found;
}

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = char(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

std::string list_of(const std::vector<DeviceEntry>& entries) {
    std::string list;
    for (std::size_t i = 0; i < entries.size(); ++i)
        list += "\n  " + std::to_string(i) + ": " + entries[i].name +
                (entries[i].missing.empty() ? "" : ", which lacks " + entries[i].missing);
    return list;
}

std::optional<std::size_t> first_that_suits(const std::vector<DeviceEntry>& entries, bool software) {
    for (std::size_t i = 0; i < entries.size(); ++i)
        if (entries[i].missing.empty() && (software || !entries[i].software)) return i;
    return std::nullopt;
}

} // namespace

Instance::Instance(std::vector<std::string>* messages) {
    std::uint32_t version = VK_API_VERSION_1_0;
    vkEnumerateInstanceVersion(&version);
    if (version < VK_API_VERSION_1_2)
        throw Error(ExitCode::unsupported,
                    "the Vulkan loader here is older than Vulkan 1.2; update it (Debian: libvulkan1)");
    validated_ = messages != nullptr && layer_is_installed();
    const VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(messages);
    // Missing barriers show only when asked for.
    const VkValidationFeatureEnableEXT synchronization =
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.pNext = &messenger; // for vkCreateInstance and vkDestroyInstance themselves
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &synchronization;
    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.apiVersion = VK_API_VERSION_1_2;
    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    const char* const extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    if (validated_) {
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &validation_layer;
        info.enabledExtensionCount = 1;
        info.ppEnabledExtensionNames = &extension;
    }
    const VkResult result = vkCreateInstance(&info, nullptr, &instance_);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
        throw Error(ExitCode::unsupported,
                    "there is no Vulkan driver here; install one for the graphics card, "
                    "or Mesa's software device (Debian: mesa-vulkan-drivers)");
    check(result, "vkCreateInstance");

    const auto create = validated_ ? instance_function<PFN_vkCreateDebugUtilsMessengerEXT>(
                                         instance_, "vkCreateDebugUtilsMessengerEXT")
                                   : nullptr;
    if (create != nullptr) create(instance_, &messenger, nullptr, &messenger_);
}

Instance::~Instance() {
    const auto destroy = messenger_ == VK_NULL_HANDLE
                             ? nullptr
                             : instance_function<PFN_vkDestroyDebugUtilsMessengerEXT>(
                                   instance_, "vkDestroyDebugUtilsMessengerEXT");
    if (destroy != nullptr) destroy(instance_, messenger_, nullptr);
    vkDestroyInstance(instance_, nullptr);
}

std::vector<FoundDevice> find_devices(const Instance& instance, vulkan::Tracing tracing) {
    std::uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance.handle(), &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> handles(count);
    check(vkEnumeratePhysicalDevices(instance.handle(), &count, handles.data()),
          "vkEnumeratePhysicalDevices");
    std::vector<FoundDevice> devices;
    devices.reserve(count);
    for (VkPhysicalDevice handle : handles) devices.push_back(describe(instance.handle(), handle, tracing));
    return devices;
}

std::size_t choose_device(const std::vector<DeviceEntry>& entries, std::string_view device) {
    if (entries.empty())
        throw Error(ExitCode::unsupported,
                    "Vulkan finds no device here; is the driver of the graphics card installed?");
    if (device.empty()) {
        auto found = first_that_suits(entries, false);
        if (!found) found = first_that_suits(entries, true);
        if (!found)
            throw Error(ExitCode::unsupported, "no Vulkan device here can trace rays:" + list_of(entries));
        return *found;
    }

    std::size_t index = 0;
    const auto [end, error] = std::from_chars(device.data(), device.data() + device.size(), index);
    const bool is_number = error == std::errc() && end == device.data() + device.size();
    std::optional<std::size_t> named; // the first; better, the first that suits
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (is_number ? i != index : lower(entries[i].name).find(lower(device)) == std::string::npos)
            continue;
        if (!named || (!entries[*named].missing.empty() && entries[i].missing.empty())) named = i;
    }
    if (!named)
        throw Error(ExitCode::usage, "no Vulkan device is called '" + std::string(device) +
                                         "'; there are:" + list_of(entries));
    if (!entries[*named].missing.empty())
        throw Error(ExitCode::unsupported, "the Vulkan device '" + entries[*named].name +
                                               "' cannot trace rays: it lacks " + entries[*named].missing);
    return *named;
}

std::vector<DeviceEntry> list_devices(vulkan::Tracing tracing) {
    const Instance instance(nullptr);
    std::vector<DeviceEntry> entries;
    for (FoundDevice& device : find_devices(instance, tracing)) entries.push_back(std::move(device.entry));
    return entries;
}

} // namespace spa::render
