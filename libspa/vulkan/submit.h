// SPDX-License-Identifier: Apache-2.0
// A command buffer for once.
#pragma once

#include "device.h"

#include <cstdint>
#include <functional>

namespace spa::vulkan {

// Records by `record`, submits and waits. queue: of this family; not used by others meanwhile. Throws Error,
// and what `record` throws.
void submit_and_wait(const Device& device, VkQueue queue, std::uint32_t queue_family,
                     const std::function<void(VkCommandBuffer)>& record);

} // namespace spa::vulkan
