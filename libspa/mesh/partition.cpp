// SPDX-License-Identifier: Apache-2.0
#include "partition.h"

#include "components.h"
#include "weld.h"

#include "../core/error.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace spa {
namespace {

constexpr std::size_t most_compared = 4096;

// Triangles by a number in [0, count), each list ascending.
std::vector<std::vector<std::uint32_t>> gather(std::span<const std::uint32_t> of_triangle,
                                               std::size_t count) {
    std::vector<std::vector<std::uint32_t>> lists(count);
    for (std::uint32_t t = 0; t < of_triangle.size(); ++t) lists[of_triangle[t]].push_back(t);
    return lists;
}

struct Cluster {
    std::vector<std::uint32_t> components;
    double area = 0;
    Vec3d moment; // area times centroid

    [[nodiscard]] Vec3d centroid() const { return area > 0 ? moment * (1 / area) : moment; }
    void join(Cluster& other) {
        components.insert(components.end(), other.components.begin(), other.components.end());
        area += other.area;
        moment = moment + other.moment;
        other.components.clear();
    }
};

std::vector<Cluster> clusters_of(const Model& model, const Components& components) {
    std::vector<Cluster> clusters(components.count);
    for (std::uint32_t t = 0; t < model.triangles.size(); ++t) {
        const auto corner = [&](unsigned k) {
            return to_double(model.positions[model.triangles[t].vertex[k]]);
        };
        const double area = length(cross(corner(1) - corner(0), corner(2) - corner(0))) / 2;
        Cluster& cluster = clusters[components.of_triangle[t]];
        cluster.area += area;
        cluster.moment = cluster.moment + (corner(0) + corner(1) + corner(2)) * (area / 3);
    }
    for (std::uint32_t c = 0; c < clusters.size(); ++c) clusters[c].components = {c};
    return clusters;
}

std::size_t nearest(const std::vector<Cluster>& clusters, std::size_t end, const Cluster& to) {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < end; ++i) {
        const double distance = length(clusters[i].centroid() - to.centroid());
        if (&clusters[i] == &to || !(distance < least)) continue;
        least = distance;
        best = i;
    }
    return best;
}

void limit(std::vector<Cluster>& clusters, std::size_t most) {
    std::stable_sort(clusters.begin(), clusters.end(),
                     [](const Cluster& a, const Cluster& b) { return a.area > b.area; });
    for (std::size_t i = most_compared; i < clusters.size(); ++i)
        clusters[nearest(clusters, most_compared, clusters[i])].join(clusters[i]);
    clusters.resize(std::min(clusters.size(), most_compared));
    while (clusters.size() > most) {
        const auto least =
            std::min_element(clusters.begin(), clusters.end(),
                             [](const Cluster& a, const Cluster& b) { return a.area < b.area; });
        clusters[nearest(clusters, clusters.size(), *least)].join(*least);
        clusters.erase(least);
    }
}

void check_count(std::size_t count, std::uint32_t max_parts, const char* what) {
    if (count > max_parts)
        throw Error(ExitCode::unsupported, "divides into " + std::to_string(count) + " " + what +
                                               ", more than --max-parts " + std::to_string(max_parts) +
                                               " allows; raise it, or use another way to divide");
}

// Piece by piece, those of no triangles left out.
Partition follow_nodes(const Scene& scene, const std::vector<std::uint32_t>& nodes,
                       std::vector<std::vector<std::uint32_t>> triangles) {
    Partition partition;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (triangles[i].empty()) continue;
        const SceneNode& node = scene.nodes[nodes[i]];
        if (!has_inverse(node.to_world))
            throw Error(ExitCode::unsupported, "node '" + node.name +
                                                   "' has a transform without inverse, which no part can "
                                                   "follow; use --parts components");
        Piece& piece = partition.emplace_back();
        piece.triangles = std::move(triangles[i]);
        piece.name = node.name;
        piece.node = std::int32_t(node.source);
        piece.to_node = inverse(node.to_world);
    }
    return partition;
}

// Of a triangle: the sum of a bone's weights at its corners, and the largest of them.
struct BoneShare {
    std::uint32_t bone = 0;
    float sum = 0, largest = 0;
};

void share_out(const Rig& rig, const Triangle& triangle, std::vector<BoneShare>& shares) {
    shares.clear();
    for (const std::uint32_t v : triangle.vertex) {
        for (std::uint32_t i = rig.first[v]; i < rig.first[v + 1]; ++i) {
            const Influence& influence = rig.influences[i];
            auto share = std::find_if(shares.begin(), shares.end(),
                                      [&](const BoneShare& s) { return s.bone == influence.bone; });
            if (share == shares.end()) share = shares.insert(share, {influence.bone, 0, 0});
            share->sum += influence.weight;
            share->largest = std::max(share->largest, influence.weight);
        }
    }
}

} // namespace

Partition whole(const Model& model) {
    Partition partition(1);
    partition[0].triangles.resize(model.triangles.size());
    std::iota(partition[0].triangles.begin(), partition[0].triangles.end(), 0U);
    return partition;
}

Partition divide_by_components(const Model& model, std::uint32_t max_parts) {
    const Components components = find_components(model);
    std::vector<Cluster> clusters = clusters_of(model, components);
    if (clusters.size() > max_parts) limit(clusters, max_parts);
    // Numbered by their first component, and so by their first triangle.
    for (Cluster& cluster : clusters) std::sort(cluster.components.begin(), cluster.components.end());
    std::sort(clusters.begin(), clusters.end(),
              [](const Cluster& a, const Cluster& b) { return a.components[0] < b.components[0]; });
    std::vector<std::uint32_t> cluster_of(components.count);
    for (std::uint32_t i = 0; i < clusters.size(); ++i)
        for (const std::uint32_t c : clusters[i].components) cluster_of[c] = i;
    std::vector<std::uint32_t> of_triangle(components.of_triangle);
    for (std::uint32_t& number : of_triangle) number = cluster_of[number];
    Partition partition;
    for (auto& triangles : gather(of_triangle, clusters.size()))
        partition.emplace_back().triangles = std::move(triangles);
    return partition;
}

Partition divide_by_nodes(const Scene& scene, std::uint32_t max_parts) {
    // An instance has its node's source and hangs below it.
    std::vector<std::uint32_t> nodes(scene.nodes.size());
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
        const std::uint32_t parent = scene.nodes[n].parent;
        nodes[n] = n;
        if (parent != no_index && scene.nodes[n].source != no_index &&
            scene.nodes[parent].source == scene.nodes[n].source)
            nodes[n] = nodes[parent];
    }
    std::vector<std::uint32_t> of_triangle(scene.triangle_nodes);
    for (std::uint32_t& node : of_triangle) node = nodes[node];
    std::iota(nodes.begin(), nodes.end(), 0U);
    Partition partition = follow_nodes(scene, nodes, gather(of_triangle, nodes.size()));
    check_count(partition.size(), max_parts, "nodes");
    return partition;
}

Partition divide_by_bones(const Scene& scene, std::uint32_t max_parts) {
    const Rig& rig = scene.rig;
    std::vector<std::vector<std::uint32_t>> triangles(rig.bones.size());
    std::vector<BoneShare> shares;
    for (std::uint32_t t = 0; t < scene.model.triangles.size(); ++t) {
        share_out(rig, scene.model.triangles[t], shares);
        const auto dominant =
            std::max_element(shares.begin(), shares.end(), [](const BoneShare& a, const BoneShare& b) {
                return a.sum != b.sum ? a.sum < b.sum : a.bone > b.bone;
            });
        for (auto share = shares.begin(); share != shares.end(); ++share)
            if (share == dominant || share->largest >= shared_weight) triangles[share->bone].push_back(t);
    }
    std::vector<std::uint32_t> nodes;
    std::vector<std::int32_t> joints;
    for (std::size_t b = 0; b < rig.bones.size(); ++b) {
        nodes.push_back(rig.bones[b].node);
        if (!triangles[b].empty())
            joints.push_back(rig.bones[b].skin == no_index ? -1 : std::int32_t(rig.bones[b].joint));
    }
    Partition partition = follow_nodes(scene, nodes, std::move(triangles));
    for (std::size_t i = 0; i < partition.size(); ++i) partition[i].joint = joints[i];
    check_count(partition.size(), max_parts, "joints and nodes");
    return partition;
}

void overlap_by_one_ring(const Model& model, Partition& partition) {
    const std::vector<std::uint32_t> welded = weld_positions(model.positions);
    std::vector<std::uint32_t> seen(model.positions.size(), no_index);
    for (std::uint32_t p = 0; p < partition.size(); ++p) {
        std::vector<std::uint32_t>& triangles = partition[p].triangles;
        for (const std::uint32_t t : triangles)
            for (const std::uint32_t v : model.triangles[t].vertex) seen[welded[v]] = p;
        std::vector<std::uint32_t> grown;
        for (std::uint32_t t = 0; t < model.triangles.size(); ++t) {
            const auto& corners = model.triangles[t].vertex;
            if (std::any_of(corners.begin(), corners.end(),
                            [&](std::uint32_t v) { return seen[welded[v]] == p; }))
                grown.push_back(t);
        }
        triangles = std::move(grown);
    }
}

} // namespace spa
