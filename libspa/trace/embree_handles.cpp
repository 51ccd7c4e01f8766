// SPDX-License-Identifier: Apache-2.0
#include "embree_handles.h"

#include "../core/error.h"

#include <algorithm>
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

void attach_triangles(RTCDevice device, RTCScene scene, std::span<const Vec3f> positions,
                      std::span<const Triangle> triangles) {
    const GeometryOwner geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
    // Embree's own buffers: it reads 16 bytes a vertex, four behind the end of a vector.
    void* const vertices = rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0,
                                                   RTC_FORMAT_FLOAT3, sizeof(Vec3f), positions.size());
    void* const indices = rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                  sizeof(Triangle), triangles.size());
    check(device);
    std::copy(positions.begin(), positions.end(), static_cast<Vec3f*>(vertices));
    std::copy(triangles.begin(), triangles.end(), static_cast<Triangle*>(indices));
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(scene, geometry.get());
    check(device);
}

} // namespace spa::trace
