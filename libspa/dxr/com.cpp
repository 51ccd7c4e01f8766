// SPDX-License-Identifier: Apache-2.0
#include "com.h"

#include "../core/error.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>

namespace spa::dxr {
namespace {

// Of DXGI, whose headers are not needed for anything else.
constexpr std::uint32_t device_removed = 0x887A0005U, device_hung = 0x887A0006U, device_reset = 0x887A0007U;

} // namespace

void check(HRESULT result, const char* what) {
    if (SUCCEEDED(result)) return;
    if (result == E_OUTOFMEMORY)
        throw Error(ExitCode::unsupported, std::string(what) + ": the device has not enough memory left");
    const auto code = std::uint32_t(result);
    if (code == device_removed || code == device_hung || code == device_reset)
        throw Error(ExitCode::unsupported,
                    std::string(what) + ": the device is gone; create it again and load again");
    std::array<char, 16> digits{};
    std::snprintf(digits.data(), digits.size(), "0x%08X", unsigned(code));
    throw Error(ExitCode::internal, std::string(what) + " failed with HRESULT " + digits.data());
}

} // namespace spa::dxr
