// SPDX-License-Identifier: Apache-2.0
// The ways to find what rays meet that are compared: tracers of a map, and Embree on triangles of the model,
// of its simplifications and of the map's surface. All do the same work: from rays in normalised space to the
// distance, the geometric normal and the primitive.
#pragma once

#include "ray_errors.h"
#include "ray_sets.h"

#include "../core/spherical_map.h"
#include "../trace/embree_peer.h"
#include "../trace/ray.h"
#include "../trace/trace_map.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace spa::measure {

enum class Family : std::uint8_t {
    fan,        // the paper's test rays on a map
    march,      // steps along the ray over a map
    projective, // ours
    mesh,       // Embree, the model's triangles
    lod,        // Embree, simplified
    surface,    // Embree, the surface that a map stores
};
const char* name(Family family);
constexpr bool is_map(Family family) {
    return family == Family::fan || family == Family::march || family == Family::projective;
}

enum class CallKind : std::uint8_t {
    single, // a call a ray
    stream, // a call for many rays
};

// Rays of one set, and room for what tracers write; shared by all methods, one at a time.
class RayBatch {
public:
    RayBatch(RaySet set, std::vector<trace::Ray> rays);

    [[nodiscard]] RaySet set() const { return set_; }
    [[nodiscard]] bool occlusion() const { return asks_occlusion(set_); }
    [[nodiscard]] std::span<const trace::Ray> rays() const { return rays_; }
    std::vector<trace::Hit> hits;      // as long as rays()
    std::vector<std::uint8_t> blocked; // likewise
    // Made at the first use.
    trace::EmbreeRays& embree(trace::EmbreeCall call);

private:
    RaySet set_;
    std::vector<trace::Ray> rays_;
    std::map<trace::EmbreeCall, trace::EmbreeRays> embree_;
};

class TraceMethod {
public:
    virtual ~TraceMethod() = default;

    std::string name; // unique within a model, such as "projective 128x2"
    Family family = Family::mesh;
    std::uint32_t cells = 0;  // of the map, a side; 0: there is none
    std::uint32_t layers = 0; // of the map
    std::uint64_t triangles = 0;
    double target_error = 0; // lod, in R
    std::uint64_t bytes = 0; // that tracing may touch, all of it, hits and colours apart

    [[nodiscard]] virtual bool has_stream() const = 0;
    // What is called: "rtcIntersect1M", ...
    [[nodiscard]] virtual std::string call_name(RaySet set, CallKind kind) const = 0;
    // Before rays of a batch are traced for the first time: chooses among several calls by trying them.
    virtual void prepare(RayBatch&) {}
    // Before each trace.
    virtual void reset(RayBatch&, CallKind) const {}
    // What is timed. begin: a multiple of 16; end: likewise, or the number of rays. Thread-safe for ranges
    // that do not overlap.
    virtual void trace(RayBatch& batch, CallKind kind, std::size_t begin, std::size_t end) const = 0;
    // After a trace of all rays: one entry a ray; of occlusion `blocked` of the batch instead.
    [[nodiscard]] virtual std::vector<RayAnswer> answers(RayBatch& batch, CallKind kind) const = 0;
    virtual void store_blocked(RayBatch&, CallKind) const {}
};

// All rays, in the caller's arena.
void trace_all(const TraceMethod& method, RayBatch& batch, CallKind kind);
// Streams where there are any.
CallKind usual_kind(const TraceMethod& method);
// What all rays meet, by the usual kind of call; or whether they are blocked, of a batch that asks for
// occlusion.
std::vector<RayAnswer> answers_of(const TraceMethod& method, RayBatch& batch);
std::span<const std::uint8_t> blocked_of(const TraceMethod& method, RayBatch& batch);

// Nanoseconds a ray of all rays, one after the other on this thread, by its own time (stopwatch.h).
double one_thread_ns(const TraceMethod& method, RayBatch& batch, CallKind kind);

// Of a map; owns its trace image. part: need not outlive it. tests: of the fan, 0 = N(d2). colours: whether
// answers have them.
std::unique_ptr<TraceMethod> map_method(Family family, const Part& part, std::uint32_t layers,
                                        std::uint32_t tests);

// Of triangles. normals: one a position, to interpolate in answers; empty, or a corner's is zero: the
// geometric one. build_seconds: of Embree's hierarchy; one_thread: on this thread alone, its own time
// (stopwatch.h), else in the caller's arena by the wall.
std::unique_ptr<TraceMethod> triangle_method(Family family, std::span<const Vec3f> positions,
                                             std::span<const Vec3f> normals,
                                             std::span<const Triangle> triangles, bool one_thread,
                                             double& build_seconds);

} // namespace spa::measure
