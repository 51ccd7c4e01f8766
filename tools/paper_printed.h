// SPDX-License-Identifier: Apache-2.0
// What the paper prints: frames per second in its Tables 1 to 7 ("Real-Time Ray Tracing with Spherically
// Projected Object Data", section 3), as they stand there, on an NVIDIA Titan V, which has no ray-tracing
// cores.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace spa::tools {

constexpr std::array<std::uint32_t, 4> paper_samples{8, 32, 128, 256};

// method: "fan 0", "fan 1", "fan 3", "fan 5", "fan 10" or "triangles"; level: 0 to 6; samples: of
// paper_samples. None if the paper has no such cell.
std::optional<double> printed_frames_per_second(int level, std::string_view method, std::uint32_t samples);

// Vertices of the boot as the paper prints them: two of the seven (326, 1131713) do not fit its own series of
// Loop subdivision.
constexpr std::array<std::uint32_t, 7> printed_vertices{326, 1317, 5233, 20865, 83329, 333057, 1331713};

} // namespace spa::tools
