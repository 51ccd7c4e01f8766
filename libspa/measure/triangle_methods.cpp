// SPDX-License-Identifier: Apache-2.0
#include "stopwatch.h"
#include "trace_methods.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <limits>

namespace spa::measure {
namespace {

using trace::EmbreeCall;

class TriangleMethod final : public TraceMethod {
public:
    TriangleMethod(std::span<const Vec3f> positions, std::span<const Vec3f> vertex_normals,
                   std::span<const Triangle> mesh)
        : peer_(positions, mesh), normals_(vertex_normals.begin(), vertex_normals.end()) {
        if (!normals_.empty()) corners_.assign(mesh.begin(), mesh.end());
        triangles = mesh.size();
    }

    // Gives back the seconds.
    double build(bool one_thread) {
        double seconds = 0;
        if (one_thread) {
            // An arena of one thread would not do: Embree has one of its own.
            const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
            seconds = thread_seconds_of([&] { peer_.build(); });
        } else {
            seconds = seconds_of([&] { peer_.build(); });
        }
        bytes = peer_.bytes();
        return seconds;
    }

    [[nodiscard]] bool has_stream() const override { return true; }
    [[nodiscard]] std::string call_name(RaySet set, CallKind kind) const override {
        return trace::name(call(set, kind));
    }

    void prepare(RayBatch& batch) override {
        const std::size_t few = std::min<std::size_t>(batch.rays().size(), 16384) / 16 * 16;
        if (few == 0) return;
        double least = std::numeric_limits<double>::infinity();
        for (int round = 0; round < 2; ++round) {
            for (const EmbreeCall call : trace::embree_calls()) {
                if (call == EmbreeCall::single || !trace::is_native(call)) continue;
                trace::EmbreeRays& rays = batch.embree(call);
                rays.reset(batch.rays());
                const double seconds = thread_seconds_of([&] { trace_by(batch, rays, 0, few); });
                if (!(seconds < least)) continue;
                least = seconds;
                best_[batch.set()] = call;
            }
        }
    }

    void reset(RayBatch& batch, CallKind kind) const override {
        batch.embree(call(batch.set(), kind)).reset(batch.rays());
    }

    void trace(RayBatch& batch, CallKind kind, std::size_t begin, std::size_t end) const override {
        trace_by(batch, batch.embree(call(batch.set(), kind)), begin, end);
    }

    [[nodiscard]] std::vector<RayAnswer> answers(RayBatch& batch, CallKind kind) const override {
        const trace::EmbreeRays& rays = batch.embree(call(batch.set(), kind));
        std::vector<RayAnswer> answers(batch.rays().size());
        for (std::size_t i = 0; i < answers.size(); ++i) {
            const trace::Hit hit = rays.hit(i);
            answers[i] = answer_of(hit);
            if (hit.valid() && !normals_.empty())
                interpolate(rays.triangle(i), rays.barycentric(i), answers[i].normal);
        }
        return answers;
    }

    void store_blocked(RayBatch& batch, CallKind kind) const override {
        const trace::EmbreeRays& rays = batch.embree(call(batch.set(), kind));
        for (std::size_t i = 0; i < batch.blocked.size(); ++i) batch.blocked[i] = rays.blocked(i) ? 1 : 0;
    }

private:
    [[nodiscard]] EmbreeCall call(RaySet set, CallKind kind) const {
        if (kind == CallKind::single) return EmbreeCall::single;
        const auto found = best_.find(set);
        return found == best_.end() ? EmbreeCall::stream : found->second;
    }

    void trace_by(const RayBatch& batch, trace::EmbreeRays& rays, std::size_t begin, std::size_t end) const {
        if (batch.occlusion())
            peer_.occluded(rays, begin, end);
        else
            peer_.closest_hits(rays, begin, end);
    }

    // Leaves the geometric normal at a corner that has none.
    void interpolate(std::uint32_t triangle, Vec2f at, Vec3f& normal) const {
        const auto& v = corners_[triangle].vertex;
        for (const std::uint32_t corner : v)
            if (normals_[corner] == Vec3f{}) return;
        normal = normals_[v[0]] * (1 - at.x - at.y) + normals_[v[1]] * at.x + normals_[v[2]] * at.y;
    }

    trace::EmbreePeer peer_;
    std::vector<Vec3f> normals_;
    std::vector<Triangle> corners_;
    std::map<RaySet, EmbreeCall> best_;
};

} // namespace

std::unique_ptr<TraceMethod> triangle_method(Family family, std::span<const Vec3f> positions,
                                             std::span<const Vec3f> normals,
                                             std::span<const Triangle> triangles, bool one_thread,
                                             double& build_seconds) {
    auto method = std::make_unique<TriangleMethod>(positions, normals, triangles);
    method->family = family;
    build_seconds = method->build(one_thread);
    return method;
}

} // namespace spa::measure
