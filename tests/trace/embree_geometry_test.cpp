// SPDX-License-Identifier: Apache-2.0
// Maps in a scene of Embree's: alone as in our own Scene, and beside triangles.
#include "function_map.h"
#include "random.h"

#include "../../libspa/trace/embree_geometry.h"
#include "../../libspa/trace/triangle_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace spa::test {
namespace {

using namespace spa::trace; // NOLINT(google-build-using-namespace)

constexpr Grid grid{Mapping::octahedral, 65, 65};
constexpr float infinity = std::numeric_limits<float>::infinity();

double bumps(Vec3d u) { return 0.7 + 0.2 * std::sin(4 * u.x + u.y) * std::cos(3 * u.z); }

struct Device {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    Device() = default;
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    ~Device() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }

    unsigned add_triangles(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles) {
        RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        void* const vertices = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                       sizeof(Vec3f), positions.size());
        void* const indices = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                      sizeof(Triangle), triangles.size());
        std::copy(positions.begin(), positions.end(), static_cast<Vec3f*>(vertices));
        std::copy(triangles.begin(), triangles.end(), static_cast<Triangle*>(indices));
        rtcCommitGeometry(mesh);
        const unsigned id = rtcAttachGeometry(scene, mesh);
        rtcReleaseGeometry(mesh);
        return id;
    }

    [[nodiscard]] RTCRayHit closest(const Ray& ray) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit result = embree_ray(ray);
        rtcIntersect1(scene, &context, &result);
        return result;
    }
    [[nodiscard]] bool blocked(const Ray& ray) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRay result = embree_ray(ray).ray;
        rtcOccluded1(scene, &context, &result);
        return result.tfar < 0;
    }

    static RTCRayHit embree_ray(const Ray& ray) {
        RTCRayHit result{};
        result.ray.org_x = ray.origin.x;
        result.ray.org_y = ray.origin.y;
        result.ray.org_z = ray.origin.z;
        result.ray.dir_x = ray.direction.x;
        result.ray.dir_y = ray.direction.y;
        result.ray.dir_z = ray.direction.z;
        result.ray.tnear = ray.t_min;
        result.ray.tfar = ray.t_max;
        result.ray.mask = ~0U;
        result.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        result.hit.primID = RTC_INVALID_GEOMETRY_ID;
        return result;
    }
};

// Turned, stretched, half of them mirrored.
Affine random_transform(Random& random) {
    const Vec3d z = random.direction();
    const Vec3d x = normalize(cross(z, random.direction()));
    Affine result;
    result.linear = {{x * std::exp2(random()), cross(z, x) * std::exp2(random()),
                      z * (random.bits() % 2 == 0 ? 1.0 : -0.7)}};
    result.translation = random.vector() * 4.0;
    return result;
}

struct Maps {
    FunctionMap ball{grid, bumps};
    std::unique_ptr<TraceMap> map;
    Scene scene;

    explicit Maps(unsigned instances) {
        ball.part().radius = 1.3;
        ball.part().center = {0.1, 0.2, -0.3};
        ball.set_normals([](Vec3d u) { return u; });
        map = std::make_unique<TraceMap>(ball.part());
        Random random(30);
        for (unsigned i = 0; i < instances; ++i) scene.add(*map, ball.part(), random_transform(random));
    }
};

std::vector<Ray> random_rays(std::size_t count, std::uint32_t seed) {
    Random random(seed);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        const Vec3d origin = random.vector() * 7.0;
        const Vec3d direction = (random.vector() * 4.0 - origin) * std::exp2(2 * random());
        ray = {to_float(origin), 0, to_float(direction)};
        if (random.bits() % 4 == 0) ray.t_min = float(random.uniform() * 0.5 / length(direction));
        if (random.bits() % 4 == 0) ray.t_max = float(random.uniform() * 10 / length(direction));
    }
    return rays;
}

TEST(EmbreeGeometry, AloneHasTheAnswersOfTheScene) {
    const Maps maps(40);
    const Device device;
    const EmbreeGeometry geometry(device.device, maps.scene);
    const unsigned id = geometry.attach(device.scene);
    rtcCommitScene(device.scene);
    int hits = 0;
    for (const Ray& ray : random_rays(20000, 31)) {
        Hit expected;
        const bool any = maps.scene.closest_hit(ray, no_flags, expected);
        const RTCRayHit found = device.closest(ray);
        ASSERT_EQ(found.hit.geomID == id, any);
        ASSERT_EQ(device.blocked(ray), any);
        if (!any) continue;
        ++hits;
        EXPECT_EQ(found.hit.primID, expected.instance);
        EXPECT_NEAR(found.ray.tfar, expected.t, 1e-5 * double(expected.t));
        EXPECT_EQ(geometry.hit(found).t, found.ray.tfar);
        if (ray.t_max < infinity) continue;
        EXPECT_EQ(found.ray.tfar, expected.t);
        EXPECT_EQ(found.hit.Ng_x, expected.normal.x);
        EXPECT_EQ(found.hit.Ng_y, expected.normal.y);
        EXPECT_EQ(found.hit.Ng_z, expected.normal.z);
        EXPECT_EQ(found.hit.u, expected.map.x);
        EXPECT_EQ(found.hit.v, expected.map.y);
        const Hit all = geometry.hit(found);
        EXPECT_EQ(all.t, expected.t);
        EXPECT_EQ(all.side, expected.side);
        EXPECT_EQ(all.layer, expected.layer);
        EXPECT_EQ(all.front, expected.front);
        EXPECT_EQ(all.instance, expected.instance);
        // The ray's end counts.
        Ray part = ray;
        part.t_max = expected.t;
        EXPECT_EQ(device.closest(part).hit.geomID, id);
        part.t_max = std::nextafter(expected.t, 0.0F);
        EXPECT_EQ(device.closest(part).hit.geomID, RTC_INVALID_GEOMETRY_ID);
    }
    EXPECT_GT(hits, 5000);
}

TEST(EmbreeGeometry, PacketsAndStreamsHaveTheAnswersOfSingleRays) {
    const Maps maps(10);
    const Device device;
    const EmbreeGeometry geometry(device.device, maps.scene);
    const unsigned id = geometry.attach(device.scene);
    rtcCommitScene(device.scene);
    const std::vector<Ray> rays = random_rays(4096, 32);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);

    std::vector<RTCRayHit> stream;
    for (const Ray& ray : rays) stream.push_back(Device::embree_ray(ray));
    rtcIntersect1M(device.scene, &context, stream.data(), unsigned(stream.size()), sizeof(RTCRayHit));
    int hits = 0;
    for (std::size_t first = 0; first < rays.size(); first += 8) {
        RTCRayHit8 packet{};
        alignas(32) std::array<int, 8> valid{};
        for (unsigned i = 0; i < 8; ++i) {
            const RTCRayHit one = Device::embree_ray(rays[first + i]);
            rtcCopyHitToHitN(RTCRayHitN_HitN(reinterpret_cast<RTCRayHitN*>(&packet), 8), &one.hit, 8, i);
            packet.ray.org_x[i] = one.ray.org_x;
            packet.ray.org_y[i] = one.ray.org_y;
            packet.ray.org_z[i] = one.ray.org_z;
            packet.ray.dir_x[i] = one.ray.dir_x;
            packet.ray.dir_y[i] = one.ray.dir_y;
            packet.ray.dir_z[i] = one.ray.dir_z;
            packet.ray.tnear[i] = one.ray.tnear;
            packet.ray.tfar[i] = one.ray.tfar;
            packet.ray.mask[i] = one.ray.mask;
            valid[i] = i % 4 == 3 ? 0 : -1; // one of four takes no part
        }
        RTCRay8 shadow = packet.ray;
        rtcIntersect8(valid.data(), device.scene, &context, &packet);
        rtcOccluded8(valid.data(), device.scene, &context, &shadow);
        for (unsigned i = 0; i < 8; ++i) {
            const RTCRayHit one = device.closest(rays[first + i]);
            const RTCRayHit& streamed = stream[first + i];
            EXPECT_EQ(streamed.hit.geomID, one.hit.geomID);
            EXPECT_EQ(streamed.ray.tfar, one.ray.tfar);
            if (valid[i] == 0) {
                EXPECT_EQ(packet.hit.geomID[i], RTC_INVALID_GEOMETRY_ID);
                continue;
            }
            ASSERT_EQ(packet.hit.geomID[i], one.hit.geomID);
            EXPECT_EQ(packet.ray.tfar[i], one.ray.tfar);
            EXPECT_EQ(shadow.tfar[i] < 0, one.hit.geomID == id);
            if (one.hit.geomID != id) continue;
            ++hits;
            EXPECT_EQ(packet.hit.primID[i], one.hit.primID);
            EXPECT_EQ(streamed.hit.primID, one.hit.primID);
            EXPECT_EQ(packet.hit.Ng_y[i], one.hit.Ng_y);
            EXPECT_EQ(packet.hit.v[i], one.hit.v);
        }
    }
    EXPECT_GT(hits, 500);
}

TEST(EmbreeGeometry, StandsBesideTriangles) {
    const Maps maps(6);
    // Random triangles through the maps.
    Random random(33);
    std::vector<Vec3f> positions;
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < 60; ++i) {
        const Vec3d center = random.vector() * 4.0;
        for (int k = 0; k < 3; ++k) positions.push_back(to_float(center + random.vector() * 1.5));
        triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}});
    }
    const TriangleScene reference(positions, triangles);
    Device device;
    const EmbreeGeometry geometry(device.device, maps.scene);
    const unsigned maps_id = geometry.attach(device.scene);
    const unsigned mesh_id = device.add_triangles(positions, triangles);
    rtcSetSceneFlags(device.scene, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(device.scene);
    int on_maps = 0;
    int on_mesh = 0;
    for (Ray ray : random_rays(20000, 34)) {
        ray.t_min = 0;
        Hit map_hit;
        maps.scene.closest_hit(ray, no_flags, map_hit);
        TriangleHit triangle_hit;
        triangle_hit.t = infinity;
        if (!reference.closest_hit(ray.origin, ray.direction, ray.t_max, triangle_hit))
            triangle_hit.t = infinity;
        const RTCRayHit found = device.closest(ray);
        EXPECT_EQ(device.blocked(ray), map_hit.valid() || triangle_hit.t < infinity);
        if (map_hit.t < triangle_hit.t) {
            ++on_maps;
            ASSERT_EQ(found.hit.geomID, maps_id);
            EXPECT_NEAR(found.ray.tfar, map_hit.t, 1e-5 * double(map_hit.t));
            EXPECT_EQ(geometry.hit(found).t, found.ray.tfar);
        } else if (triangle_hit.t < infinity) {
            ++on_mesh;
            ASSERT_EQ(found.hit.geomID, mesh_id);
            EXPECT_EQ(found.ray.tfar, triangle_hit.t);
        } else {
            ASSERT_EQ(found.hit.geomID, RTC_INVALID_GEOMETRY_ID);
        }
    }
    EXPECT_GT(on_maps, 1000);
    EXPECT_GT(on_mesh, 1000);
}

// A filter that lets no hit of instance 1 pass.
template <class Arguments>
void refuse_one(const Arguments* arguments) {
    for (unsigned i = 0; i < arguments->N; ++i)
        if (RTCHitN_primID(arguments->hit, arguments->N, i) == 1) arguments->valid[i] = 0;
}

TEST(EmbreeGeometry, FilterFunctionsAndFlagsHold) {
    FunctionMap ball(grid, [](Vec3d) { return 0.9; });
    const TraceMap map(ball.part());
    Scene maps;
    for (int i = 0; i < 3; ++i) maps.add(map, ball.part(), {{}, {0, 0, -3.0 * i}});
    const Device device;
    const EmbreeGeometry geometry(device.device, maps);
    rtcSetGeometryIntersectFilterFunction(geometry.handle(), refuse_one<RTCFilterFunctionNArguments>);
    rtcSetGeometryOccludedFilterFunction(geometry.handle(), refuse_one<RTCFilterFunctionNArguments>);
    rtcCommitGeometry(geometry.handle());
    static_cast<void>(geometry.attach(device.scene));
    rtcCommitScene(device.scene);
    const Ray at_one{{-2, 0.1F, -3}, 0, {1, 0, 0}};
    EXPECT_EQ(device.closest(at_one).hit.geomID, RTC_INVALID_GEOMETRY_ID);
    EXPECT_FALSE(device.blocked(at_one));
    const Ray through_all{{0.1F, 0.1F, -1.5F}, 0, {0, 0, -1}};
    const RTCRayHit found = device.closest(through_all);
    EXPECT_EQ(found.hit.primID, 2U);
    EXPECT_TRUE(device.blocked(through_all));

    const Device other;
    const EmbreeGeometry insides(other.device, maps, cull_front);
    static_cast<void>(insides.attach(other.scene));
    rtcCommitScene(other.scene);
    const RTCRayHit back = other.closest(at_one);
    EXPECT_NEAR(back.ray.tfar, 2.9, 0.03);
    EXPECT_FALSE(insides.hit(back).front);
}

TEST(EmbreeGeometry, OfAnEmptySceneIsNothing) {
    const Scene maps;
    const Device device;
    const EmbreeGeometry geometry(device.device, maps);
    static_cast<void>(geometry.attach(device.scene));
    rtcCommitScene(device.scene);
    EXPECT_EQ(device.closest({{0, 0, 3}, 0, {0, 0, -1}}).hit.geomID, RTC_INVALID_GEOMETRY_ID);
}

} // namespace
} // namespace spa::test
