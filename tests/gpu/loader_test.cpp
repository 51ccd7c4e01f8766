// SPDX-License-Identifier: Apache-2.0
// Maps loaded by libspa/vulkan and traced by hardware interfaces, with both ways to trace, give what the C++
// text gives with transforms in double precision.
#include "gpu_test.h"
#include "loaded_scene.h"

#include "../../libspa/vulkan/top_level.h"
#include "../../samples/samples.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

namespace spa::test {
namespace {

class Loader : public GpuTest {
protected:
    Loader() : GpuTest({true, true}) {}

    void SetUp() override {
        GpuTest::SetUp();
        if (device) loader = std::make_unique<vulkan::Device>(info());
    }
    void TearDown() override {
        loader.reset();
        GpuTest::TearDown();
    }

    [[nodiscard]] vulkan::DeviceInfo info() const {
        return {vkGetInstanceProcAddr,
                device->instance(),
                device->physical_device(),
                device->handle(),
                nullptr,
                nullptr};
    }
    [[nodiscard]] Rig rig() const {
        if (const char* other = other_map_shaders()) return {*device, *loader, other, true};
        return {*device, *loader, SPA_GPU_SHADERS};
    }

    // What the device traces by.
    [[nodiscard]] std::vector<Backend> backends() const {
        if (!tracing().queries) return {Backend::pipeline};
        return {Backend::query, Backend::pipeline};
    }

    std::unique_ptr<vulkan::Device> loader;
};

// How many rays the device and the CPU answer differently, and of those how many no ray nearby explains.
struct Disagreement {
    std::size_t rays = 0, hits = 0, differ = 0, unexplained = 0;
    double worst_t = 0, worst_normal = 0, worst_color = 0; // of those that agree; t relative to the world's 1
    std::string first;
};

double distance(const WorldRay& ray, float a, float b) {
    return std::abs(double(a) - double(b)) * double(length(ray.direction));
}

constexpr double near_enough = 1e-5; // of places, in the world, whose objects have sizes of about 1

bool same(const WorldRay& ray, const WorldHit& got, const Expected& want) {
    if (got.t < 0 || !want.hit) return (got.t < 0) == !want.hit;
    return got.instance == want.record && got.kind == want.kind && distance(ray, got.t, want.t) < near_enough;
}

// The answer of a ray that is moved by 1e-5 may be another one: at a silhouette, at an edge between sides.
bool explained(const LoadedScene& scene, const WorldRay& ray, const WorldHit& got,
               const vulkan::TraceConstants& constants) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> shift(-1e-5F, 1e-5F);
    for (int i = 0; i < 200; ++i) {
        WorldRay moved = ray;
        moved.origin = moved.origin + Vec3f{shift(random), shift(random), shift(random)};
        const float longest = length(ray.direction);
        moved.direction = moved.direction + Vec3f{shift(random), shift(random), shift(random)} * longest;
        moved.t_min *= 1 + shift(random);
        moved.t_max *= 1 + shift(random);
        const Expected want = scene.expected(moved, constants);
        if (got.t < 0 && !want.hit) return true;
        if (got.t >= 0 && want.hit && got.instance == want.record && distance(ray, got.t, want.t) < 1e-3)
            return true;
    }
    return false;
}

std::string describe(const WorldRay& ray, const WorldHit& got, const Expected& want) {
    std::ostringstream out;
    out.precision(9);
    out << "origin " << ray.origin.x << ' ' << ray.origin.y << ' ' << ray.origin.z << " direction "
        << ray.direction.x << ' ' << ray.direction.y << ' ' << ray.direction.z << " t " << ray.t_min << " to "
        << ray.t_max << ": t " << got.t << " of " << got.instance << ", kind " << got.kind << "; expected "
        << (want.hit ? "t " : "nothing, t ") << want.t << " of " << want.record << ", kind " << want.kind;
    return out.str();
}

Disagreement compare(const LoadedScene& scene, std::span<const WorldRay> rays, std::span<const WorldHit> hits,
                     const vulkan::TraceConstants& constants) {
    Disagreement result;
    result.rays = rays.size();
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const WorldRay& ray = rays[i];
        const WorldHit& got = hits[i];
        const Expected want = scene.expected(ray, constants);
        result.hits += want.hit ? 1 : 0;
        if (!same(ray, got, want)) {
            ++result.differ;
            if (explained(scene, ray, got, constants)) continue;
            ++result.unexplained;
            if (result.first.empty()) result.first = describe(ray, got, want);
            continue;
        }
        EXPECT_EQ(got.occluded, want.hit ? 1U : 0U) << describe(ray, got, want);
        if (!want.hit) continue;
        result.worst_t = std::max(result.worst_t, distance(ray, got.t, want.t));
        result.worst_normal = std::max(result.worst_normal, double(length(got.normal - want.normal)));
        result.worst_color = std::max(result.worst_color, double(length(got.color - want.color)));
        EXPECT_NEAR(got.diffuse, want.diffuse, 1e-2F);
    }
    return result;
}

Affine affine(const Mat3& linear, Vec3d to = {}) { return {linear, to}; }

// Every way to place a map: as it is, smaller and turned, stretched, mirrored, sheared.
void place_everywhere(LoadedScene& scene, std::uint32_t maps) {
    const Affine places[] = {
        affine({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, -0.2, 0.3}),
        affine({{{0, 0.5, 0}, {-0.5, 0, 0}, {0, 0, 0.5}}}, {0.7, 0.1, 0}),
        affine({{{1.5, 0, 0}, {0, 0.4, 0}, {0, 0, 0.8}}}, {-0.7, 0.2, -0.2}),
        affine({{{-0.8, 0, 0}, {0, 0.8, 0}, {0, 0, 0.9}}}, {0, 0.5, -0.6}),
        affine({{{0.6, 0.3, 0}, {0, -0.6, 0.2}, {0.2, 0, 0.7}}}, {0.3, -0.5, 0.5}),
    };
    std::uint32_t map = 0;
    for (const Affine& place : places) {
        scene.place({map, place, 0});
        map = (map + 1) % maps;
    }
}

void report(const char* what, const Disagreement& found) {
    std::cout << "  " << what << ": " << found.rays << " rays, " << found.hits << " hits, " << found.differ
              << " differ, " << found.unexplained << " of them without reason; where they agree t by "
              << found.worst_t << ", normals by " << found.worst_normal << ", colours by "
              << found.worst_color << " at most\n";
}

struct Case {
    const char* name;
    vulkan::TraceConstants constants;
    Grid grid;
    std::size_t rays;
};
void PrintTo(const Case& given, std::ostream* out) { *out << given.name; }

class LoadedMaps : public Loader, public testing::WithParamInterface<Case> {};

TEST_P(LoadedMaps, AreHitAsOnTheCpu) {
    const Case& given = GetParam();
    LoadedScene scene;
    scene.add_map({"boot"}, given.grid, 2);
    scene.add_map({"torus", "spiky"}, given.grid, 2);
    place_everywhere(scene, 2);
    vulkan::LoadOptions options;
    options.whole_sphere = given.constants.tracer != SPA_PROJECTIVE;
    scene.load(rig(), options);
    ASSERT_EQ(scene.records().size(), 7U);
    const std::vector<WorldRay> rays = world_rays(given.rays, 1);
    for (const Backend backend : backends()) {
        const std::vector<WorldHit> hits =
            trace_maps(rig(), backend, scene.instances(), scene.records(), given.constants, false, rays);
        const Disagreement found = compare(scene, rays, hits, given.constants);
        report(backend == Backend::query ? "ray queries" : "pipeline", found);
        EXPECT_GT(found.hits, rays.size() / 10);
        EXPECT_LT(found.hits, rays.size() * 9 / 10);
        EXPECT_LT(found.differ, rays.size() / 1000);
        EXPECT_EQ(found.unexplained, 0U) << found.first;
    }
}

constexpr Grid octahedral{Mapping::octahedral, 129, 129};
constexpr Grid latlong{Mapping::latlong, 256, 128};
INSTANTIATE_TEST_SUITE_P(Methods, LoadedMaps,
                         testing::Values(Case{"projective", {0, 10, 0, 0.5F}, octahedral, 1U << 19},
                                         Case{"fan", {1, 10, 0, 0.5F}, octahedral, 1U << 16},
                                         Case{"fan_that_leaves", {1, 10, 0, 0.5F, 1}, octahedral, 1U << 16},
                                         Case{"fan_by_distance", {1, 50, 1, 0.5F}, latlong, 1U << 16},
                                         Case{"sphere", {1, 0, 0, 0.5F}, latlong, 1U << 16},
                                         Case{"march", {2, 32, 0, 0.5F}, latlong, 1U << 16}),
                         [](const auto& given) { return given.param.name; });

// Rays pass through holes, and what lies behind them in the same map is hit.
TEST_F(Loader, CoverageLetsRaysThrough) {
    const vulkan::TraceConstants constants;
    LoadedScene scene;
    scene.add_map({"sphere"}, octahedral, 2);
    scene.add_map({"concave"}, octahedral, 2);
    scene.punch_holes(0, 8);
    scene.punch_holes(1, 16);
    place_everywhere(scene, 2);
    vulkan::LoadOptions options;
    options.coverage = true;
    scene.load(rig(), options);
    for (const vulkan::ShaderRecord& record : scene.records()) EXPECT_EQ(record.flags, SPA_RECORD_COVERAGE);
    const std::vector<WorldRay> rays = world_rays(1U << 16, 2);
    for (const Backend backend : backends()) {
        const std::vector<WorldHit> hits =
            trace_maps(rig(), backend, scene.instances(), scene.records(), constants, true, rays);
        const Disagreement found = compare(scene, rays, hits, constants);
        report("coverage", found);
        EXPECT_GT(found.hits, rays.size() / 10);
        EXPECT_LT(found.differ, rays.size() / 1000);
        EXPECT_EQ(found.unexplained, 0U) << found.first;
        const auto from_inside = std::count_if(hits.begin(), hits.end(), [](const WorldHit& hit) {
            return hit.t >= 0 && !shader::spa_kind_front(hit.kind);
        });
        EXPECT_GT(from_inside, 1000) << "far sides seen through holes";
    }
}

TEST_F(Loader, RecordFlagsCull) {
    const vulkan::TraceConstants constants;
    LoadedScene scene;
    scene.add_map({"torus"}, octahedral, 2);
    scene.place({0, {}, SPA_CULL_FRONT});
    scene.load(rig(), {});
    const std::vector<WorldRay> rays = world_rays(1U << 14, 3);
    for (const Backend backend : backends()) {
        const std::vector<WorldHit> hits =
            trace_maps(rig(), backend, scene.instances(), scene.records(), constants, false, rays);
        const Disagreement found = compare(scene, rays, hits, constants);
        EXPECT_GT(found.hits, 100U);
        EXPECT_EQ(found.unexplained, 0U) << found.first;
        for (const WorldHit& hit : hits) EXPECT_FALSE(hit.t >= 0 && shader::spa_kind_front(hit.kind));
    }
}

TEST_F(Loader, SaysWhatAMapNeeds) {
    LoadedScene scene;
    scene.add_map({"boot", "cube"}, octahedral, 1);
    scene.load(rig(), {});
    const vulkan::MapObject& object = scene.objects().front();
    const trace::TraceMap boot(scene.map(0).parts[0]);
    const trace::TraceMap cube(scene.map(0).parts[1]);
    const std::size_t words = boot.words().size() + cube.words().size();
    EXPECT_GE(object.memory().images, words * 4);
    EXPECT_LT(object.memory().images, words * 4 + 512);
    EXPECT_GT(object.memory().structures, 0U);
    EXPECT_EQ(object.memory().temporary, 0U) << "after finish()";
    EXPECT_EQ(object.shader_record(1).part, 1U);
    EXPECT_EQ((object.shader_record(1).image - object.shader_record(0).image) % 256, 0U);
}

TEST_F(Loader, RefusesAMapWithoutParts) { EXPECT_THROW(vulkan::MapObject(*loader, SphericalMap{}), Error); }

// Counts what is given out, and refuses one allocation.
class RefusingAllocator : public vulkan::Allocator {
public:
    explicit RefusingAllocator(vulkan::Allocator& below, int refused) : below_(below), refused_(refused) {}
    vulkan::Allocation allocate(const VkMemoryRequirements& requirements, vulkan::MemoryUse use) override {
        if (asked_++ == refused_) throw Error(ExitCode::unsupported, "no memory left");
        ++alive;
        return below_.allocate(requirements, use);
    }
    void release(const vulkan::Allocation& allocation) noexcept override {
        --alive;
        below_.release(allocation);
    }
    int alive = 0;

private:
    vulkan::Allocator& below_;
    int refused_;
    int asked_ = 0;
};

// The validation layer reports what is left when the device goes.
TEST_F(Loader, LeavesNothingBehindWhenMemoryRunsOut) {
    bake::Options options;
    options.grid = options.color_grid = octahedral;
    const bake::OwnedMap baked = bake::bake_model(samples::make_sample("cube", 1), options).map;
    int failures = 0;
    for (int refused = 0;; ++refused) {
        RefusingAllocator allocator(loader->allocator(), refused);
        vulkan::DeviceInfo with_allocator = info();
        with_allocator.allocator = &allocator;
        const vulkan::Device refusing(with_allocator);
        bool failed = false;
        try {
            vulkan::MapObject object(refusing, baked.map);
            vulkan::MapObject* const objects[] = {&object};
            vulkan::load(refusing, device->queue(), device->queue_family(), objects);
            const VkAccelerationStructureInstanceKHR instance = object.instance(0, {});
            const vulkan::TopLevel top(refusing, {&instance, 1});
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::unsupported);
            failed = true;
        }
        EXPECT_EQ(allocator.alive, 0);
        if (!failed) break;
        ++failures;
    }
    EXPECT_EQ(failures, 7) << "four buffers of a map, three of a top level";
}

TEST_F(Loader, NamesWhatADeviceLacks) {
    const auto missing = [&](vulkan::Tracing tracing) {
        return vulkan::missing(vkGetInstanceProcAddr, device->instance(), device->physical_device(), tracing);
    };
    EXPECT_EQ(missing(tracing()), "");
    // A device created without the extensions has no such functions.
    ValidationLog log;
    const VulkanDevice plain(log, {});
    try {
        const vulkan::Device refused({vkGetInstanceProcAddr, plain.instance(), plain.physical_device(),
                                      plain.handle(), nullptr, nullptr});
        FAIL() << "there are no acceleration structures";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unsupported);
        EXPECT_NE(std::string(error.what()).find("AccelerationStructure"), std::string::npos) << error.what();
    }
}

} // namespace
} // namespace spa::test
