// SPDX-License-Identifier: Apache-2.0
// Embree as fast as it can be, to compare with: without the robust mode, in each of the ways that its
// interface offers for many rays. Not for judging: rays may leak through edges (triangle_scene.h does not).
#pragma once

#include "ray.h"

#include "../core/vector.h"
#include "../mesh/model.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace spa::trace {

enum class EmbreeCall : std::uint8_t {
    single,          // rtcIntersect1
    packet8,         // rtcIntersect8
    packet16,        // rtcIntersect16
    stream,          // rtcIntersect1M
    stream_coherent, // rtcIntersect1M with the flag for coherent rays
    stream_packets,  // rtcIntersectNM: 16 rays each
};
// All of them, in this order.
std::span<const EmbreeCall> embree_calls();
// The function's name, with "coherent" where that flag is set.
const char* name(EmbreeCall call);

// Whether Embree offers the call on this processor by code made for it.
bool is_native(EmbreeCall call);

// Rays as a call wants them, and what they hit. Made and filled without being timed, so that a measure holds
// Embree's own work alone.
class EmbreeRays {
public:
    EmbreeRays(EmbreeCall call, std::span<const Ray> rays);
    ~EmbreeRays();
    EmbreeRays(EmbreeRays&&) noexcept;
    EmbreeRays& operator=(EmbreeRays&&) noexcept;

    [[nodiscard]] EmbreeCall call() const { return call_; }
    // Undoes what a trace has written. O(rays).
    void reset(std::span<const Ray> rays);
    // After EmbreePeer::closest_hits: t, and the triangle's geometric unit normal; infinity where nothing is
    // hit.
    [[nodiscard]] Hit hit(std::size_t ray) const;
    // After EmbreePeer::occluded.
    [[nodiscard]] bool blocked(std::size_t ray) const;
    // After EmbreePeer::closest_hits, where hit(ray).valid().
    [[nodiscard]] std::uint32_t triangle(std::size_t ray) const;
    // Where in the triangle: weights of its second and third corner.
    [[nodiscard]] Vec2f barycentric(std::size_t ray) const;

    struct State;

private:
    friend class EmbreePeer;
    EmbreeCall call_;
    std::unique_ptr<State> state_;
};

// An immutable scene; tracing is thread-safe for ranges of rays that do not overlap.
class EmbreePeer {
public:
    // Copies both. Throws Error{internal} if Embree fails, as for lack of memory.
    EmbreePeer(std::span<const Vec3f> positions, std::span<const Triangle> triangles);
    ~EmbreePeer();
    EmbreePeer(EmbreePeer&&) noexcept;
    EmbreePeer& operator=(EmbreePeer&&) noexcept;

    // Before the first ray: makes the hierarchy, in the default quality, on the threads of the caller's TBB
    // arena. Throws as above.
    void build();

    // What Embree holds: vertices, indices and its hierarchy, by its own count.
    [[nodiscard]] std::uint64_t bytes() const;

    // Rays begin .. end; begin is a multiple of 16, end too or the number of rays.
    void closest_hits(EmbreeRays& rays, std::size_t begin, std::size_t end) const;
    void occluded(EmbreeRays& rays, std::size_t begin, std::size_t end) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace spa::trace
