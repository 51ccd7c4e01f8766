// SPDX-License-Identifier: Apache-2.0
#include "embree_handles.h"

#include "../core/error.h"

#include <string>

namespace spa::trace {
namespace {

const char* text(RTCError error) {
    switch (error) {
    case RTC_ERROR_OUT_OF_MEMORY: return "out of memory";
    case RTC_ERROR_UNSUPPORTED_CPU: return "this processor lacks SSE2";
    case RTC_ERROR_INVALID_ARGUMENT: return "invalid argument";
    case RTC_ERROR_INVALID_OPERATION: return "invalid operation";
    default: return "unknown error";
    }
}

} // namespace

void check(RTCDevice device) {
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE)
        throw Error(ExitCode::internal, std::string("Embree failed: ") + text(error));
}

} // namespace spa::trace
