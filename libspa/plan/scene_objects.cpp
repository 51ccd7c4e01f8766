// SPDX-License-Identifier: Apache-2.0
#include "scene_objects.h"

#include "../mesh/piece_model.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <unordered_map>

namespace spa::plan {
namespace {

constexpr std::size_t most_compared = 16; // representatives of equal topology

// For each node the topmost one above it (itself included) that draws; no_index: none.
std::vector<std::uint32_t> drawing_roots(const Scene& scene) {
    std::vector<std::uint8_t> draws(scene.nodes.size());
    for (const std::uint32_t node : scene.triangle_nodes) draws[node] = 1;
    std::vector<std::uint32_t> root(scene.nodes.size(), no_index);
    for (std::uint32_t i = 0; i < scene.nodes.size(); ++i) { // a node comes behind its parent
        const std::uint32_t parent = scene.nodes[i].parent;
        if (parent != no_index && root[parent] != no_index)
            root[i] = root[parent];
        else if (draws[i] != 0)
            root[i] = i;
    }
    return root;
}

// Numbers an object's vertices in the order of their first use.
class VertexNumbers {
public:
    explicit VertexNumbers(std::size_t vertices) : number_(vertices, no_index) {}

    std::uint32_t of(std::uint32_t vertex) {
        if (number_[vertex] == no_index) {
            number_[vertex] = std::uint32_t(used_.size());
            used_.push_back(vertex);
        }
        return number_[vertex];
    }
    [[nodiscard]] const std::vector<std::uint32_t>& used() const { return used_; }
    // For the next object. O(used).
    void clear() {
        for (const std::uint32_t vertex : used_) number_[vertex] = no_index;
        used_.clear();
    }

private:
    std::vector<std::uint32_t> number_, used_;
};

void measure_bounds(const Model& model, const std::vector<std::uint32_t>& used, SceneObject& object) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Vec3d low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
    for (const std::uint32_t vertex : used) {
        const Vec3d p = to_double(model.positions[vertex]);
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    object.center = (low + high) * 0.5;
    for (const std::uint32_t vertex : used)
        object.radius = std::max(object.radius, length(to_double(model.positions[vertex]) - object.center));
}

// FNV-1a over words.
class Hash {
public:
    void add(std::uint32_t word) { value_ = (value_ ^ word) * 0x100000001B3ULL; }
    void add(float number) { add(std::bit_cast<std::uint32_t>(number)); }
    [[nodiscard]] std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xCBF29CE484222325ULL;
};

// Of all that instances of one mesh have in common to the bit.
std::uint64_t content_hash(const Scene& scene, const SceneObject& object, VertexNumbers& numbers) {
    const Model& model = scene.model;
    Hash hash;
    for (const std::uint32_t t : object.triangles) {
        for (const std::uint32_t vertex : model.triangles[t].vertex) hash.add(numbers.of(vertex));
        hash.add(model.triangle_materials[t]);
    }
    for (const std::uint32_t vertex : numbers.used()) {
        if (!model.uvs.empty()) {
            hash.add(model.uvs[vertex].x);
            hash.add(model.uvs[vertex].y);
        }
        if (!model.colors.empty()) {
            const Vec4f& color = model.colors[vertex];
            for (const float channel : {color.x, color.y, color.z, color.w}) hash.add(channel);
        }
    }
    return hash.value();
}

// Whether both place their vertices alike in their nodes' local spaces, to within what positions in the world
// have lost in single precision.
class LocalVertices {
public:
    LocalVertices(const Scene& scene, const SceneObject& object, std::vector<std::uint32_t> used)
        : model_(scene.model), to_local_(inverse(scene.nodes[object.node].to_world)), used_(std::move(used)) {
        double farthest = 0, scale = 0;
        for (const std::uint32_t vertex : used_)
            farthest = std::max(farthest, length(to_double(model_.positions[vertex])));
        for (const Vec3d& row : to_local_.linear.row) scale = std::max(scale, length(row));
        lost_ = (farthest + object.radius) * scale * 4e-7;
        radius_ = object.radius * scale;
    }

    [[nodiscard]] bool same(const LocalVertices& other) const {
        if (used_.size() != other.used_.size()) return false;
        const double tolerance = std::max(lost_, other.lost_);
        if (tolerance > 1e-3 * std::max(radius_, other.radius_)) return false;
        for (std::size_t i = 0; i < used_.size(); ++i)
            if (!(length(at(i) - other.at(i)) <= tolerance)) return false;
        return true;
    }

private:
    [[nodiscard]] Vec3d at(std::size_t i) const {
        return transform_point(to_local_, to_double(model_.positions[used_[i]]));
    }

    const Model& model_;
    Affine to_local_;
    std::vector<std::uint32_t> used_;
    double lost_ = 0, radius_ = 0;
};

struct Representative {
    std::uint32_t object;
    LocalVertices vertices;
};

} // namespace

std::vector<SceneObject> find_objects(const Scene& scene) {
    const std::vector<std::uint32_t> root = drawing_roots(scene);
    std::vector<std::uint32_t> number(scene.nodes.size(), no_index);
    std::vector<SceneObject> objects;
    for (std::uint32_t node = 0; node < scene.nodes.size(); ++node) {
        if (root[node] != node) continue;
        number[node] = std::uint32_t(objects.size());
        objects.emplace_back().node = node;
        objects.back().invertible = has_inverse(scene.nodes[node].to_world);
    }
    for (std::uint32_t t = 0; t < scene.triangle_nodes.size(); ++t)
        objects[number[root[scene.triangle_nodes[t]]]].triangles.push_back(t);

    VertexNumbers numbers(scene.model.positions.size());
    std::unordered_map<std::uint64_t, std::vector<Representative>> known;
    for (std::uint32_t i = 0; i < objects.size(); ++i) {
        SceneObject& object = objects[i];
        const std::uint64_t hash = content_hash(scene, object, numbers);
        object.vertices = numbers.used().size();
        measure_bounds(scene.model, numbers.used(), object);
        if (object.invertible) {
            std::vector<Representative>& alike = known[hash];
            LocalVertices vertices(scene, object, numbers.used());
            const auto found = std::find_if(alike.begin(), alike.end(), [&](const Representative& earlier) {
                return earlier.vertices.same(vertices);
            });
            if (found != alike.end())
                object.same_as = found->object;
            else if (alike.size() < most_compared)
                alike.push_back({i, std::move(vertices)});
        }
        numbers.clear();
    }
    return objects;
}

std::vector<std::uint32_t> object_of_triangles(const Scene& scene, const std::vector<SceneObject>& objects) {
    std::vector<std::uint32_t> of_triangle(scene.model.triangles.size(), no_index);
    for (std::uint32_t i = 0; i < objects.size(); ++i)
        for (const std::uint32_t t : objects[i].triangles) of_triangle[t] = i;
    return of_triangle;
}

Model object_model(const Scene& scene, const SceneObject& object) {
    Model model = piece_model(scene.model, object.triangles);
    move_to_local(model, scene.nodes[object.node].to_world);
    return model;
}

std::uint64_t triangle_bytes(const Scene& scene, const SceneObject& object) {
    const Model& model = scene.model;
    const std::uint64_t vertex = sizeof(Vec3f) + (model.normals.empty() ? 0 : sizeof(Vec3f)) +
                                 (model.uvs.empty() ? 0 : sizeof(Vec2f)) +
                                 (model.colors.empty() ? 0 : sizeof(Vec4f));
    const std::uint64_t triangle = sizeof(Triangle) + sizeof(std::uint32_t) + hierarchy_bytes;
    return object.vertices * vertex + object.triangles.size() * triangle;
}

} // namespace spa::plan
