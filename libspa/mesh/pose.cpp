// SPDX-License-Identifier: Apache-2.0
#include "pose.h"

#include "../core/error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <unordered_map>

namespace spa {
namespace {

// Four numbers, of which curves of translations and scales use three.
using Value = Quaternion;

Value load(const Curve& curve, std::size_t element, std::size_t width) {
    const float* from = curve.values.data() + element * width;
    return {double(from[0]), double(from[1]), double(from[2]), width == 4 ? double(from[3]) : 0};
}

Value sum(const Value& a, double of_a, const Value& b, double of_b) {
    return {a.x * of_a + b.x * of_b, a.y * of_a + b.y * of_b, a.z * of_a + b.z * of_b,
            a.w * of_a + b.w * of_b};
}

// Not unit length yet where it is a rotation. The curve has keys.
Value value_at(const Curve& curve, double time, std::size_t width) {
    const bool cubic = curve.interpolation == Interpolation::cubic_spline;
    const auto value = [&](std::size_t key) { return load(curve, cubic ? 3 * key + 1 : key, width); };
    const auto after = std::upper_bound(curve.times.begin(), curve.times.end(), time,
                                        [](double t, float key) { return !(t >= double(key)); });
    if (after == curve.times.begin()) return value(0);
    const auto next = static_cast<std::size_t>(after - curve.times.begin()), key = next - 1;
    if (next == curve.times.size() || curve.interpolation == Interpolation::step) return value(key);

    const double span = double(curve.times[next]) - double(curve.times[key]);
    const double t = (time - double(curve.times[key])) / span;
    if (cubic) {
        const Value out_tangent = load(curve, 3 * key + 2, width), in_tangent = load(curve, 3 * next, width);
        const double t2 = t * t, t3 = t2 * t;
        const Value ends = sum(value(key), 2 * t3 - 3 * t2 + 1, value(next), -2 * t3 + 3 * t2);
        const Value slopes = sum(out_tangent, span * (t3 - 2 * t2 + t), in_tangent, span * (t3 - t2));
        return sum(ends, 1, slopes, 1);
    }
    if (width == 4) return slerp(normalize(value(key)), normalize(value(next)), t);
    return sum(value(key), 1 - t, value(next), t);
}

Vec3d vector_at(const Curve& curve, double time, Vec3d rest) {
    if (curve.times.empty()) return rest;
    const Value value = value_at(curve, time, 3);
    return {value.x, value.y, value.z};
}

Affine local_at(const Track& track, double time) {
    const Quaternion rotation =
        track.rotations.times.empty() ? track.rotation : value_at(track.rotations, time, 4);
    return from_trs(vector_at(track.translations, time, track.translation), rotation,
                    vector_at(track.scales, time, track.scale));
}

Affine blend(const Rig& rig, std::size_t vertex, const std::vector<Affine>& bones) {
    Affine out{{{{}, {}, {}}}, {}};
    for (std::uint32_t i = rig.first[vertex]; i < rig.first[vertex + 1]; ++i) {
        const Affine& bone = bones[rig.influences[i].bone];
        const double weight = double(rig.influences[i].weight);
        for (std::size_t r = 0; r < 3; ++r)
            out.linear.row[r] = out.linear.row[r] + bone.linear.row[r] * weight;
        out.translation = out.translation + bone.translation * weight;
    }
    return out;
}

} // namespace

std::vector<Affine> pose_nodes(const Scene& scene, const Animation& animation, double time) {
    std::vector<Affine> out;
    out.reserve(scene.nodes.size());
    for (const SceneNode& node : scene.nodes) out.push_back(node.to_parent);
    for (const Track& track : animation.tracks) out[track.node] = local_at(track, time);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const std::uint32_t parent = scene.nodes[i].parent;
        if (parent != no_index) out[i] = out[parent] * out[i];
    }
    return out;
}

void pose_vertices(const Scene& scene, const std::vector<Affine>& to_world, Model& model) {
    const Rig& rig = scene.rig;
    std::vector<Affine> bones;
    bones.reserve(rig.bones.size());
    for (const Bone& bone : rig.bones) bones.push_back(to_world[bone.node] * bone.inverse_bind);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rig.positions.size(), 4096), [&](const auto& range) {
        for (std::size_t v = range.begin(); v < range.end(); ++v) {
            const Affine map = blend(rig, v, bones);
            model.positions[v] = to_float(transform_point(map, to_double(rig.positions[v])));
            const Vec3d normal = normalize(normal_matrix(map.linear) * to_double(rig.normals[v]));
            if (is_finite(normal) && !(normal == Vec3d{})) model.normals[v] = to_float(normal);
        }
    });
}

std::vector<Affine> pose_parts(const Scene& scene, const std::vector<Affine>& to_world,
                               const SphericalMap& map, std::uint32_t node, const Affine& otherwise) {
    std::unordered_map<std::uint32_t, std::uint32_t> followed; // by number in the source
    std::vector<bool> below(scene.nodes.size());
    for (const bool inside : {true, false})
        for (std::uint32_t i = 0; i < scene.nodes.size(); ++i) {
            const std::uint32_t parent = scene.nodes[i].parent;
            below[i] = node == no_index || i == node || (parent != no_index && below[parent]);
            if (below[i] == inside) followed.try_emplace(scene.nodes[i].source, i);
        }
    std::vector<Affine> out;
    for (const Part& part : map.parts) {
        if (part.node < 0) {
            out.push_back(otherwise);
            continue;
        }
        const auto found = followed.find(static_cast<std::uint32_t>(part.node));
        if (found == followed.end())
            throw Error(ExitCode::usage, "part " + std::to_string(out.size()) + " follows node " +
                                             std::to_string(part.node) +
                                             " of what it was baked from, which the scene has not; render "
                                             "the asset that was baked");
        out.push_back(to_world[found->second] * part.to_node);
    }
    return out;
}

} // namespace spa
