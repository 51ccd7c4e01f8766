// SPDX-License-Identifier: Apache-2.0
// Renders a scene on a Vulkan device: primary rays, direct light with shadow rays, and one bounce of diffuse
// light, for which objects may be spherical maps instead of triangles. Diffuse materials with base colour.
#pragma once

#include "gpu.h"

#include "../core/spherical_map.h"
#include "../mesh/scene.h"
#include "../vulkan/hit_group.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace spa::render {

// Takes the place of all that a node and the nodes below it draw. Placements of one map share what it takes
// on the device, if their options are the same.
struct MapPlacement {
    std::uint32_t node = 0; // index into Scene::nodes; no_index: all of the scene
    const SphericalMap* map = nullptr;
    std::uint32_t layers = 0; // as many at most; 0: all
    bool holes = false;       // rays pass where less than half of a texel is covered (SPA_RECORD_COVERAGE)
    // For tracing by fan or march: their box is that of the whole sphere (vulkan::LoadOptions), and rays
    // leave the solid that they begin in, because the points that hit lie in the solid and are to be lit all
    // the same.
    bool test_points = false;
    // Where each part stands, from the map's object space to the world (pose_parts, ../mesh/pose.h); empty:
    // all stand at the node's to_world, or in the world itself where the map takes the place of the scene.
    std::vector<Affine> parts{};
    // Nothing takes the place: rays that meet maps pass. `map` is null then.
    bool dropped = false;
};

struct SceneMemory {                       // bytes on the device
    std::uint64_t triangles = 0;           // vertices, indices, attributes of what maps do not replace
    std::uint64_t triangle_structures = 0; // and its bottom levels
    std::uint64_t replaced_triangles = 0;  // the same of what maps replace, if any kind of ray uses it
    std::uint64_t replaced_structures = 0;
    std::uint64_t maps = 0; // trace images
    std::uint64_t map_structures = 0;
    std::uint64_t top_level = 0;
};
struct SceneTimes {            // seconds, by the wall
    double upload = 0;         // of everything
    double triangle_build = 0; // bottom levels of what maps do not replace
    double replaced_build = 0; // of what they do
    double map_load = 0;       // maps: compile, upload, bottom levels
    double top_level = 0;      // after pose() with moving the maps' instances
};

// A scene on a device. What maps replace is kept as triangles too if keep_replaced.
class DeviceScene {
public:
    // scene, maps: need not outlive the call. Throws Error.
    DeviceScene(const Gpu& gpu, const Scene& scene, std::span<const MapPlacement> maps, bool keep_replaced);
    ~DeviceScene();
    DeviceScene(const DeviceScene&) = delete;
    DeviceScene& operator=(const DeviceScene&) = delete;

    // Another moment of an animation: `scene` and `maps` are those of the constructor but for the vertices'
    // positions and normals and for where nodes and parts stand. Maps move with their instances alone;
    // triangles, if there are any, are uploaded and their bottom levels built again; the top level is built
    // again. Cameras, lights and materials stay. Not while frames of it are rendered. Throws Error as the
    // constructor.
    void pose(const Gpu& gpu, const Scene& scene, std::span<const MapPlacement> maps);

    [[nodiscard]] const SceneMemory& memory() const;
    [[nodiscard]] const SceneTimes& times() const; // of what pose() does again: of the last pose()

    struct State;
    [[nodiscard]] State& state() const { return *state_; }

private:
    std::unique_ptr<State> state_;
};

enum class Geometry { triangles, maps }; // of the objects that have a map
enum class Backend { pipeline, query };  // VK_KHR_ray_tracing_pipeline, VK_KHR_ray_query in a compute shader

struct Settings {
    std::uint32_t width = 960, height = 540;
    Camera camera;
    std::uint32_t samples = 32;  // diffuse secondary rays a primary hit
    std::uint32_t antialias = 1; // primary rays a pixel: 1 through its centre, more spread over it
    std::uint32_t seed = 1;
    Geometry primary = Geometry::triangles, shadow = Geometry::maps, secondary = Geometry::maps;
    vulkan::TraceConstants tracing; // of maps
    Backend backend = Backend::pipeline;
    double batch_seconds =
        0.2; // about so long the device is kept busy at a time; does not change the picture
};

// Pictures, row by row from the top. What no primary ray hits: 0, depth infinity.
struct Frame {
    std::uint32_t width = 0, height = 0;
    std::vector<Vec3f> direct;   // radiance by light that comes straight from a light
    std::vector<Vec3f> indirect; // and by that of one bounce
    std::vector<Vec3f> normal;   // world, unit, towards the camera; of several primary rays the mean
    std::vector<Vec3f> albedo;
    std::vector<float> depth;       // distance from the camera, of the first primary ray of a pixel
    std::vector<std::uint8_t> kind; // of that: 0 nothing, 1 triangle, 2 + hit side (SPA_OUTER, ...) of a map
};

struct FrameTimes {
    double compile = 0;   // pipelines
    double primary = 0;   // seconds on the device: primary rays and their direct light
    double secondary = 0; // secondary rays and their direct light
    std::uint64_t primary_rays = 0, secondary_rays = 0, shadow_rays = 0; // traced
};

// progress: share done, in [0,1]; may be empty. When it returns false, rendering ends and the frame is empty.
// Same scene, settings and device: same pixels, whatever the number of batches.
Frame render(const Gpu& gpu, const DeviceScene& scene, const Settings& settings, FrameTimes* times = nullptr,
             const std::function<bool(double)>& progress = {});

// Several frames of one camera, each as render() gives it for that number of secondary rays: samples ascends,
// and settings.samples is not looked at; settings.antialias is 1. Costs what the last of them costs. times:
// one entry a frame, of all that it alone would take.
std::vector<Frame> render_series(const Gpu& gpu, const DeviceScene& scene, const Settings& settings,
                                 std::span<const std::uint32_t> samples,
                                 std::vector<FrameTimes>* times = nullptr);

} // namespace spa::render
