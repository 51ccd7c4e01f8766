// SPDX-License-Identifier: Apache-2.0
// Owners of Embree's objects, its errors as ours, and triangles as its geometry. Internal to this folder.
#pragma once

#include "../mesh/model.h"

#include <embree3/rtcore.h>

#include <memory>
#include <span>
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

// Adds a copy of the triangles to a scene; nothing is built. Throws as check.
void attach_triangles(RTCDevice device, RTCScene scene, std::span<const Vec3f> positions,
                      std::span<const Triangle> triangles);

} // namespace spa::trace
