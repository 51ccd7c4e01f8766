// SPDX-License-Identifier: Apache-2.0
#include "embree_geometry.h"

#include "embree_handles.h"
#include "trace.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>

namespace spa::trace {
namespace {

// As many of a packet's or a stream's rays as are traced at once.
constexpr unsigned batch = 64;

Ray ray_of(const RTCRay& ray) {
    return {{ray.org_x, ray.org_y, ray.org_z}, ray.tnear, {ray.dir_x, ray.dir_y, ray.dir_z}, ray.tfar};
}

// The low and the high end along one axis of the world: `row` of to_world over the box around the map's
// surface.
struct Range {
    double low, high;
};
Range range(double origin, Vec3d row, const shader::SpaMap& map) {
    Range range{origin, origin};
    const std::array<double, 3> factors{row.x, row.y, row.z};
    const std::array<double, 3> low{double(map.box_low.x), double(map.box_low.y), double(map.box_low.z)};
    const std::array<double, 3> high{double(map.box_high.x), double(map.box_high.y), double(map.box_high.z)};
    for (std::size_t i = 0; i < 3; ++i) {
        range.low += std::min(factors[i] * low[i], factors[i] * high[i]);
        range.high += std::max(factors[i] * low[i], factors[i] * high[i]);
    }
    // What a ray loses on its way into map space, and float of a double.
    const double slack = 1e-5 * (range.high - range.low) + 2e-7 * std::abs(origin);
    return {range.low - slack, range.high + slack};
}

} // namespace

// Embree's side: functions that get the object as their user pointer.
struct EmbreeGeometry::Callbacks {
    static void bounds(const RTCBoundsFunctionArguments* arguments) {
        const Scene& maps = *static_cast<const EmbreeGeometry*>(arguments->geometryUserPtr)->maps_;
        const MapSpace& space = maps.space(arguments->primID);
        const shader::SpaMap& map = maps.map(arguments->primID).map();
        const Range x = range(space.origin.x, space.to_world.row[0], map);
        const Range y = range(space.origin.y, space.to_world.row[1], map);
        const Range z = range(space.origin.z, space.to_world.row[2], map);
        RTCBounds& bounds = *arguments->bounds_o;
        bounds.lower_x = float(x.low);
        bounds.lower_y = float(y.low);
        bounds.lower_z = float(z.low);
        bounds.upper_x = float(x.high);
        bounds.upper_y = float(y.high);
        bounds.upper_z = float(z.high);
    }

    static RTCHit hit_of(const Hit& found, unsigned instance, unsigned geometry,
                         const RTCIntersectContext& context) {
        RTCHit hit{};
        hit.Ng_x = found.normal.x;
        hit.Ng_y = found.normal.y;
        hit.Ng_z = found.normal.z;
        hit.u = found.map.x;
        hit.v = found.map.y;
        hit.primID = instance;
        hit.geomID = geometry;
        std::copy(std::begin(context.instID), std::end(context.instID), std::begin(hit.instID));
        return hit;
    }

    // Whether the filter functions let a hit of one ray pass.
    template <class Arguments, class Filter>
    static bool passes(const Arguments* arguments, Filter filter, RTCRay ray, float t, RTCHit& hit) {
        int valid = -1;
        ray.tfar = t;
        RTCFilterFunctionNArguments one{};
        one.valid = &valid;
        one.geometryUserPtr = arguments->geometryUserPtr;
        one.context = arguments->context;
        one.ray = reinterpret_cast<RTCRayN*>(&ray);
        one.hit = reinterpret_cast<RTCHitN*>(&hit);
        one.N = 1;
        filter(arguments, &one);
        return valid != 0;
    }

    // The active rays of a call, a batch at a time, and their hits. Every ray is traced to infinity: another
    // t_max may change the last bits of a hit, and answers would depend on the order of Embree's walk.
    struct Batch {
        unsigned count = 0;
        std::array<unsigned, batch> lane{};
        std::array<Ray, batch> rays;
        std::array<Hit, batch> hits;
    };
    template <class Arguments, class Take>
    static void for_each_batch(const Arguments* arguments, RTCRayN* rays, Take take) {
        const auto& geometry = *static_cast<const EmbreeGeometry*>(arguments->geometryUserPtr);
        const MapSpace& space = geometry.maps_->space(arguments->primID);
        const TraceMap& map = geometry.maps_->map(arguments->primID);
        Batch lanes;
        for (unsigned i = 0; i < arguments->N; ++i) {
            if (arguments->valid[i] != 0) {
                Ray ray = ray_of(rtcGetRayFromRayN(rays, arguments->N, i));
                ray.t_max = std::numeric_limits<float>::infinity();
                lanes.lane[lanes.count] = i;
                lanes.rays[lanes.count++] = to_map(space, ray);
            }
            if (lanes.count < batch && i + 1 < arguments->N) continue;
            if (lanes.count == 1)
                closest_hit(map, lanes.rays[0], geometry.flags_, lanes.hits[0]);
            else
                closest_hits(map, std::span(lanes.rays).first(lanes.count), geometry.flags_,
                             std::span(lanes.hits).first(lanes.count));
            for (unsigned j = 0; j < lanes.count; ++j)
                if (lanes.hits[j].valid()) take(lanes.lane[j], to_world(space, lanes.hits[j]));
            lanes.count = 0;
        }
    }

    static void intersect(const RTCIntersectFunctionNArguments* arguments) {
        const unsigned n = arguments->N;
        RTCRayN* const rays = RTCRayHitN_RayN(arguments->rayhit, n);
        RTCHitN* const hits = RTCRayHitN_HitN(arguments->rayhit, n);
        for_each_batch(arguments, rays, [&](unsigned lane, const Hit& found) {
            const float tfar = RTCRayN_tfar(rays, n, lane);
            if (!(found.t <= tfar)) return;
            // The end of a ray counts. A hit at the same place stays, unless it is one of a higher instance.
            const unsigned before = RTCHitN_geomID(hits, n, lane);
            const bool higher =
                before == arguments->geomID && RTCHitN_primID(hits, n, lane) > arguments->primID;
            if (found.t == tfar && before != RTC_INVALID_GEOMETRY_ID && !higher) return;
            RTCHit hit = hit_of(found, arguments->primID, arguments->geomID, *arguments->context);
            if (!passes(arguments, rtcFilterIntersection, rtcGetRayFromRayN(rays, n, lane), found.t, hit))
                return;
            RTCRayN_tfar(rays, n, lane) = found.t;
            rtcCopyHitToHitN(hits, &hit, n, lane);
        });
    }

    static void occluded(const RTCOccludedFunctionNArguments* arguments) {
        const unsigned n = arguments->N;
        for_each_batch(arguments, arguments->ray, [&](unsigned lane, const Hit& found) {
            const RTCRay ray = rtcGetRayFromRayN(arguments->ray, n, lane);
            if (!(found.t <= ray.tfar)) return;
            RTCHit hit = hit_of(found, arguments->primID, arguments->geomID, *arguments->context);
            if (!passes(arguments, rtcFilterOcclusion, ray, found.t, hit)) return;
            RTCRayN_tfar(arguments->ray, n, lane) = -std::numeric_limits<float>::infinity();
        });
    }
};

EmbreeGeometry::EmbreeGeometry(RTCDevice device, const Scene& maps, std::uint32_t flags)
    : maps_(&maps), flags_(flags), geometry_(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER)) {
    GeometryOwner owner(geometry_);
    check(device);
    rtcSetGeometryUserPrimitiveCount(geometry_, maps.size());
    rtcSetGeometryUserData(geometry_, this);
    rtcSetGeometryBoundsFunction(geometry_, Callbacks::bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry_, Callbacks::intersect);
    rtcSetGeometryOccludedFunction(geometry_, Callbacks::occluded);
    rtcCommitGeometry(geometry_);
    check(device);
    static_cast<void>(owner.release());
}

EmbreeGeometry::~EmbreeGeometry() { rtcReleaseGeometry(geometry_); }

unsigned EmbreeGeometry::attach(RTCScene scene) const { return rtcAttachGeometry(scene, geometry_); }

Hit EmbreeGeometry::hit(const RTCRayHit& ray) const {
    Ray whole = ray_of(ray.ray);
    whole.t_max = std::numeric_limits<float>::infinity();
    const MapSpace& space = maps_->space(ray.hit.primID);
    Hit hit;
    if (!closest_hit(maps_->map(ray.hit.primID), to_map(space, whole), flags_, hit)) return hit;
    hit = to_world(space, hit);
    hit.instance = ray.hit.primID;
    return hit;
}

} // namespace spa::trace
