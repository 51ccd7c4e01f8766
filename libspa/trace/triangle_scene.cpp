// SPDX-License-Identifier: Apache-2.0
#include "triangle_scene.h"

#include "embree_handles.h"

#include "../mesh/closest_point.h"

#include <cmath>

namespace spa::trace {
namespace {

RTCRayHit make_ray(Vec3f origin, Vec3f direction, float max_t) {
    RTCRayHit ray{};
    ray.ray.org_x = origin.x;
    ray.ray.org_y = origin.y;
    ray.ray.org_z = origin.z;
    ray.ray.dir_x = direction.x;
    ray.ray.dir_y = direction.y;
    ray.ray.dir_z = direction.z;
    ray.ray.tfar = max_t;
    ray.ray.mask = ~0U;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    return ray;
}

TriangleHit make_hit(float t, unsigned triangle, Vec3f normal, Vec3f direction) {
    // Embree's geometric normal is (B - A) x (C - A).
    return {t, triangle, dot(normal, direction) < 0};
}

struct HitList {
    RTCIntersectContext context; // first: the filter gets a pointer to it
    std::vector<TriangleHit>* hits;
};

// Rejects every hit after writing it down, so that the ray goes on.
void collect(const RTCFilterFunctionNArguments* arguments) {
    auto* const list = reinterpret_cast<HitList*>(arguments->context);
    const auto* const ray = reinterpret_cast<const RTCRay*>(arguments->ray);
    const auto* const hit = reinterpret_cast<const RTCHit*>(arguments->hit);
    list->hits->push_back(make_hit(ray->tfar, hit->primID, {hit->Ng_x, hit->Ng_y, hit->Ng_z},
                                   {ray->dir_x, ray->dir_y, ray->dir_z}));
    arguments->valid[0] = 0;
}

struct Search {
    std::span<const Vec3f> positions;
    std::span<const Triangle> triangles;
    Vec3d query;
    ClosestPoint best;
};

bool visit(RTCPointQueryFunctionArguments* arguments) {
    Search& search = *static_cast<Search*>(arguments->userPtr);
    const auto& v = search.triangles[arguments->primID].vertex;
    const Vec3d point =
        closest_point_on_triangle(search.query, to_double(search.positions[v[0]]),
                                  to_double(search.positions[v[1]]), to_double(search.positions[v[2]]));
    const double distance = length(point - search.query);
    if (!(distance < search.best.distance)) return false;
    search.best = {point, distance, arguments->primID};
    // Rounded up, and by what the query point lost when it became float.
    const float radius = std::nextafter(float(distance), std::numeric_limits<float>::infinity()) + 2e-7F;
    if (!(radius < arguments->query->radius)) return false;
    arguments->query->radius = radius;
    return true;
}

} // namespace

struct TriangleScene::State {
    std::span<const Vec3f> positions;
    std::span<const Triangle> triangles;
    DeviceOwner device;
    SceneOwner scene;
};

TriangleScene::TriangleScene(std::span<const Vec3f> positions, std::span<const Triangle> triangles)
    : state_(std::make_unique<State>()) {
    State& s = *state_;
    s.positions = positions;
    s.triangles = triangles;
    s.device.reset(rtcNewDevice(nullptr));
    if (!s.device) check(nullptr);
    s.scene.reset(rtcNewScene(s.device.get()));
    // Without the robust flag rays leak through edges and vertices.
    rtcSetSceneFlags(s.scene.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    attach_triangles(s.device.get(), s.scene.get(), positions, triangles);
    rtcJoinCommitScene(s.scene.get());
    check(s.device.get());
}

TriangleScene::~TriangleScene() = default;
TriangleScene::TriangleScene(TriangleScene&&) noexcept = default;
TriangleScene& TriangleScene::operator=(TriangleScene&&) noexcept = default;

bool TriangleScene::closest_hit(Vec3f origin, Vec3f direction, float max_t, TriangleHit& hit) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray = make_ray(origin, direction, max_t);
    rtcIntersect1(state_->scene.get(), &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    hit = make_hit(ray.ray.tfar, ray.hit.primID, {ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z}, direction);
    return true;
}

void TriangleScene::all_hits(Vec3f origin, Vec3f direction, float max_t,
                             std::vector<TriangleHit>& hits) const {
    hits.clear();
    HitList list{};
    rtcInitIntersectContext(&list.context);
    list.context.filter = collect;
    list.hits = &hits;
    RTCRayHit ray = make_ray(origin, direction, max_t);
    rtcIntersect1(state_->scene.get(), &list.context, &ray);
}

ClosestPoint TriangleScene::closest_point(Vec3d query, double max_distance) const {
    Search search{state_->positions, state_->triangles, query, {}};
    search.best.distance = max_distance;
    RTCPointQuery point{};
    point.x = float(query.x);
    point.y = float(query.y);
    point.z = float(query.z);
    point.radius = std::nextafter(float(max_distance), std::numeric_limits<float>::infinity());
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(state_->scene.get(), &point, &context, visit, &search);
    return search.best.triangle == no_index ? ClosestPoint{} : search.best;
}

} // namespace spa::trace
