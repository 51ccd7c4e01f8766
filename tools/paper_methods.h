// SPDX-License-Identifier: Apache-2.0
// The ways in which the paper's experiments meet an object: its triangles, a simplified mesh, and maps.
#pragma once

#include "../libspa/bake/bake.h"
#include "../libspa/mesh/scene.h"
#include "../libspa/render/render.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace spa::tools {

// Which map, if any, stands for the object. `paper` is the paper's layout (640x480 latlong, 8-bit depth, one
// surface), the others are octahedral with `map_cells` cells a side, centred where most of the surface is
// seen.
enum class MapKind : std::uint8_t { none, paper, one_layer, two_layers };
constexpr std::uint32_t map_cells = 128;

struct PaperMethod {
    std::string name;
    MapKind map = MapKind::none;
    vulkan::TraceConstants tracing;
};

// fan 0, 1, 3, 5, 10 and N(d2); projective with one and two layers; triangles last.
const std::vector<PaperMethod>& paper_methods();
const PaperMethod& paper_method(const std::string& name);
inline constexpr const char* triangles_name = "triangles";

bake::OwnedMap bake_for(const Model& model, MapKind kind);

// A scene whose node `name` is the object of the experiment.
struct PaperScene {
    std::string title;
    Scene scene;
    Camera camera;
    std::uint32_t object = 0; // index into Scene::nodes
};

// The scene without the triangles of the object.
Scene without_object(const PaperScene& from);
// The object's triangles in its node's local space, as a model.
Model object_model(const PaperScene& from);
// The scene with other triangles as the object: in the node's local space, of one white material.
Scene with_object(const PaperScene& from, std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                  std::span<const Triangle> triangles);

// The scene on the device, with the map in the place of the object. map: null: none. keep_replaced: with the
// object's triangles too.
std::unique_ptr<render::DeviceScene> on_device(const render::Gpu& gpu, const Scene& scene,
                                               std::uint32_t object, const SphericalMap* map,
                                               bool keep_replaced);

// Primary rays on triangles; secondary and shadow rays as the method says.
render::Settings settings_of(const PaperMethod& method, const Camera& camera, std::uint32_t width,
                             std::uint32_t height);

} // namespace spa::tools
