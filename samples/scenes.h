// SPDX-License-Identifier: Apache-2.0
// Scenes made by code: the sample boot where its shadow, or the colours that it throws on its surroundings,
// can be seen. Metres, +Y up, white walls and floors of albedo 0.8, one point light each that gives these a
// radiance of about 0.2 to 0.9. In the corner it is high up near the edge: it grazes the walls and falls full
// on the boot and the floor, so that what the boot throws on the walls shows.
//
// In each of them a node named "boot" has the mesh of make_sample("boot", level) in its local space, so that
// a map baked from that sample can take its place. Floors, walls and columns are nodes of their own.
//
//   spa::Scene scene = spa::samples::make_scene("corner", 4);
//   spa::samples::write_glb(scene, "corner.glb");
#pragma once

#include "samples.h"

#include "../libspa/mesh/scene.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace spa::samples {

// All scenes, in the order to show them in; the level is that of the boot.
//   corner       the boot close to the edge between two white walls, tip at a right angle to the left one
//   corner-b     the same, tip towards the edge
//   corner-c     the same, leaning back into the edge, so that both of its sides light the walls
//   corner-d     the same as the first, fallen over, so that most of one side is lit
//   wall         the boot before a white wall in light from the front; casts a shadow on it
//   colonnade    the boot before columns with arches, lit from above; cameras "side" and "tip"
//   colonnade-b  the same, tip tilted down by 20 degrees
std::span<const Sample> list_scenes();

// nullptr if there is no such scene.
const Sample* find_scene(std::string_view name);

// Throws Error(usage) for an unknown name or a level outside 0..max_level. Deterministic; time and memory
// linear in the number of triangles.
Scene make_scene(std::string_view name, int level);

// The scene as a binary glTF 2.0 file: a mesh for each node that has triangles, in its local space; nodes
// with names, parents and transforms; cameras; lights by KHR_lights_punctual; materials as to_glb(Model)
// keeps them. A camera or light hangs on the node of its name and place, or, where there is none, on a new
// one. Same scene, same bytes. Positions come back from import::read_scene with the rounding of single
// precision. Throws Error(internal) if the scene breaks the rules of scene.h or a node with triangles has a
// transform without inverse, and what to_glb(Model) throws.
std::vector<std::byte> to_glb(const Scene& scene);

// As write_glb(Model).
void write_glb(const Scene& scene, const std::filesystem::path& path);

} // namespace spa::samples
