// SPDX-License-Identifier: Apache-2.0
// A Vulkan device for rendering without a window.
#pragma once

#include "../vulkan/device.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace spa::render {

struct DeviceEntry {
    std::string name;    // of the device
    std::string driver;  // its name and version
    std::string missing; // what it lacks to trace rays, in words; empty: nothing
    bool software = false;
};

// Every Vulkan device here, in the order of the Vulkan loader; the index is what chooses one. `missing` is
// for these ways to trace. Throws Error{unsupported} if there is no Vulkan at all.
std::vector<DeviceEntry> list_devices(vulkan::Tracing tracing);

struct GpuOptions {
    // An index of list_devices(), or a part of a device's name (any case). Empty: the first that is not
    // software, can trace rays, and else the first that can.
    std::string device;
    vulkan::Tracing tracing{true, true};
    bool validation = false; // with the Khronos validation layer, if it is installed
    // Where messages() are kept, if not in the Gpu itself: they then include what the layer says when the
    // device goes. Outlives the Gpu.
    std::vector<std::string>* messages = nullptr;
};

// A device with one queue, for one thread at a time. It outlives what is made with it.
//
// Throws Error: unsupported if no device suits, with what each lacks; usage if `device` names none.
class Gpu {
public:
    explicit Gpu(const GpuOptions& options = {});
    ~Gpu();
    Gpu(const Gpu&) = delete;
    Gpu& operator=(const Gpu&) = delete;

    [[nodiscard]] const vulkan::Device& device() const;
    [[nodiscard]] VkQueue queue() const;
    [[nodiscard]] std::uint32_t queue_family() const;
    [[nodiscard]] const DeviceEntry& entry() const;
    [[nodiscard]] bool validated() const; // the layer was asked for and is installed
    // What the validation layer said so far, one message a string.
    [[nodiscard]] const std::vector<std::string>& messages() const;

    struct State;
    [[nodiscard]] State& state() const { return *state_; }

private:
    std::unique_ptr<State> state_;
};

} // namespace spa::render
