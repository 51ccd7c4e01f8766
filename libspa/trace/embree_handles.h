// SPDX-License-Identifier: Apache-2.0
// Owners of Embree's objects, and its errors as ours. Internal to this folder.
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <type_traits>

namespace spa::trace {

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct ReleaseGeometry {
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using DeviceOwner = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using SceneOwner = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;
using GeometryOwner = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, ReleaseGeometry>;

// Throws Error{internal} if the device, or where it is null the making of one, has failed.
void check(RTCDevice device);

} // namespace spa::trace
