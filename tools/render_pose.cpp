// SPDX-License-Identifier: Apache-2.0
#include "render_pose.h"

#include "near_names.h"
#include "text.h"

#include "../libspa/mesh/pose.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace spa::tools {

namespace {

std::vector<Affine> node_places(const Scene& scene) {
    std::vector<Affine> places;
    places.reserve(scene.nodes.size());
    for (const SceneNode& node : scene.nodes) places.push_back(node.to_world);
    return places;
}

} // namespace

std::size_t choose_animation(const Scene& scene, const RenderArguments& arguments) {
    const std::vector<Animation>& animations = scene.rig.animations;
    if (animations.empty())
        throw Error(ExitCode::usage, arguments.scene.string() + ": has no animation; leave --animation, " +
                                         "--time and --frames out");
    if (!arguments.animation) return 0;
    const auto named = std::find_if(animations.begin(), animations.end(), [&](const Animation& animation) {
        return animation.name == *arguments.animation;
    });
    if (named != animations.end()) return std::size_t(named - animations.begin());
    if (const std::optional<std::size_t> index = whole_number(*arguments.animation);
        index && *index < animations.size())
        return *index;
    throw Error(ExitCode::usage, "--animation: there is no animation '" + *arguments.animation + "' in " +
                                     arguments.scene.string() +
                                     suggestion(*arguments.animation, names_of(animations)));
}

std::vector<double> frame_times(const Animation& animation, std::uint32_t count) {
    std::vector<double> times;
    for (std::uint32_t i = 0; i < count; ++i) times.push_back(animation.seconds * i / count);
    return times;
}

void pose_scene(Scene& scene, std::size_t animation, double time) {
    const std::vector<Affine> to_world = pose_nodes(scene, scene.rig.animations[animation], time);
    pose_vertices(scene, to_world, scene.model);
    for (std::size_t i = 0; i < to_world.size(); ++i) scene.nodes[i].to_world = to_world[i];
}

std::vector<render::MapPlacement> placements(const Scene& scene, const std::vector<PlacedMap>& maps,
                                             const std::vector<std::uint32_t>& dropped,
                                             const RenderArguments& arguments) {
    const std::vector<Affine> to_world = node_places(scene);
    std::vector<render::MapPlacement> all;
    for (const PlacedMap& map : maps) {
        for (const std::uint32_t node : map.nodes) {
            render::MapPlacement& one = all.emplace_back(placement(node, &map.file.map(), arguments));
            if (!arguments.is_posed()) continue;
            try {
                one.parts =
                    pose_parts(scene, to_world, *one.map, node, node == no_index ? Affine{} : to_world[node]);
            } catch (const Error& error) {
                throw Error(error.code(), map.file.name + ": " + error.what());
            }
        }
    }
    for (const std::uint32_t node : dropped) all.push_back(placement(node, nullptr, arguments));
    return all;
}

Camera framing_camera(const Scene& scene, std::size_t animation, const std::vector<double>& times,
                      double aspect) {
    Model all; // of which a camera looks at the positions
    Model posed = scene.model;
    for (const double time : times) {
        pose_vertices(scene, pose_nodes(scene, scene.rig.animations[animation], time), posed);
        Vec3f low = posed.positions.front(), high = low;
        for (const Vec3f& p : posed.positions) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
        all.positions.insert(all.positions.end(), {low, high});
    }
    return framing_camera(all, aspect);
}

} // namespace spa::tools
