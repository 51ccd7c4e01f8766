// SPDX-License-Identifier: Apache-2.0
// The maps of a scene as one user geometry of Embree 3, beside triangles and whatever else a scene of
// Embree's holds: its hierarchy takes the place of the loop over instances.
//
//   spa::trace::Scene maps;                                   // add instances; then leave it as it is
//   const spa::trace::EmbreeGeometry geometry(device, maps);
//   const unsigned id = geometry.attach(scene);
//   rtcCommitScene(scene);
//   ... rtcIntersect1(scene, &context, &ray) ...
//   if (ray.hit.geomID == id) { Hit hit = geometry.hit(ray); Shade shade = maps.shade(hit); ... }
//
// What a hit holds: primID is the instance's number in the scene of maps, u and v the place on its map, Ng a
// unit normal out of the solid (Embree's triangles have theirs of any length). Rays of any kind of call work,
// packets and streams too; filter functions are called as for triangles. Time and motion are not looked at.
//
// Answers are those of Scene, whatever order Embree takes: a ray is traced to its first hit with every
// instance whose box it meets before its best hit so far, even beyond its end. To the bit for rays without
// end; tfar may change the last bits of t in Scene, not here.
#pragma once

#include "scene.h"

#include <embree3/rtcore.h>

#include <cstdint>

namespace spa::trace {

class EmbreeGeometry {
public:
    // maps outlives this object and does not change; this object outlives the scenes it is attached to.
    // flags: TraceFlags, of all rays. Throws Error{internal} if Embree fails.
    EmbreeGeometry(RTCDevice device, const Scene& maps, std::uint32_t flags = no_flags);
    ~EmbreeGeometry();
    EmbreeGeometry(const EmbreeGeometry&) = delete;
    EmbreeGeometry& operator=(const EmbreeGeometry&) = delete;

    // Returns the geometry's id in `scene`, which is committed by whom it belongs to.
    [[nodiscard]] unsigned attach(RTCScene scene) const;
    // For everything else, such as masks and filter functions; it is committed already.
    [[nodiscard]] RTCGeometry handle() const { return geometry_; }

    // All of a hit that Embree has reported for this geometry, as Scene::closest_hit would have it: found by
    // one more trace of the same ray against that instance. ray: as rtcIntersect left it; if the geometry was
    // reached through an instance of Embree's, brought into that one's space.
    [[nodiscard]] Hit hit(const RTCRayHit& ray) const;

private:
    struct Callbacks;

    const Scene* maps_;
    std::uint32_t flags_;
    RTCGeometry geometry_;
};

} // namespace spa::trace
