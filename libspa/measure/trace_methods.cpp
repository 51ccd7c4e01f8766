// SPDX-License-Identifier: Apache-2.0
#include "trace_methods.h"

#include "stopwatch.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace spa::measure {

const char* name(Family family) {
    switch (family) {
    case Family::fan: return "fan";
    case Family::march: return "march";
    case Family::projective: return "projective";
    case Family::mesh: return "mesh";
    case Family::lod: return "lod";
    case Family::surface: break;
    }
    return "surface";
}

RayBatch::RayBatch(RaySet set, std::vector<trace::Ray> rays)
    : hits(rays.size()), blocked(rays.size()), set_(set), rays_(std::move(rays)) {}

trace::EmbreeRays& RayBatch::embree(trace::EmbreeCall call) {
    const auto found = embree_.find(call);
    if (found != embree_.end()) return found->second;
    return embree_.emplace(call, trace::EmbreeRays(call, rays_)).first->second;
}

void trace_all(const TraceMethod& method, RayBatch& batch, CallKind kind) {
    constexpr std::size_t chunk = 4096; // rays that a thread takes at a time
    const std::size_t count = batch.rays().size();
    tbb::parallel_for(std::size_t(0), (count + chunk - 1) / chunk, [&](std::size_t i) {
        method.trace(batch, kind, i * chunk, std::min(count, (i + 1) * chunk));
    });
}

CallKind usual_kind(const TraceMethod& method) {
    return method.has_stream() ? CallKind::stream : CallKind::single;
}

std::vector<RayAnswer> answers_of(const TraceMethod& method, RayBatch& batch) {
    const CallKind kind = usual_kind(method);
    method.reset(batch, kind);
    trace_all(method, batch, kind);
    return method.answers(batch, kind);
}

std::span<const std::uint8_t> blocked_of(const TraceMethod& method, RayBatch& batch) {
    const CallKind kind = usual_kind(method);
    method.reset(batch, kind);
    trace_all(method, batch, kind);
    method.store_blocked(batch, kind);
    return batch.blocked;
}

double one_thread_ns(const TraceMethod& method, RayBatch& batch, CallKind kind) {
    method.reset(batch, kind);
    const std::size_t count = batch.rays().size();
    return thread_seconds_of([&] { method.trace(batch, kind, 0, count); }) * 1e9 / double(count);
}

} // namespace spa::measure
