// SPDX-License-Identifier: Apache-2.0
#include "piece_model.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace spa {
namespace {

// The numbers that occur, ascending, and for each its place among them.
class Used {
public:
    // numbers: below `count`; no_index does not count.
    Used(std::size_t count, std::vector<std::uint32_t> numbers) {
        // Of few among many a table would cost more than the rest.
        constexpr std::size_t dense = 16;
        if (numbers.size() * dense < count) {
            std::sort(numbers.begin(), numbers.end());
            numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
            if (!numbers.empty() && numbers.back() == no_index) numbers.pop_back();
            numbers_ = std::move(numbers);
            return;
        }
        place_.resize(count, no_index);
        for (const std::uint32_t n : numbers)
            if (n != no_index) place_[n] = 0;
        for (std::uint32_t n = 0; n < count; ++n) {
            if (place_[n] == no_index) continue;
            place_[n] = std::uint32_t(numbers_.size());
            numbers_.push_back(n);
        }
    }

    [[nodiscard]] std::uint32_t operator()(std::uint32_t number) const {
        if (!place_.empty()) return place_[number];
        return std::uint32_t(std::lower_bound(numbers_.begin(), numbers_.end(), number) - numbers_.begin());
    }

    template <class T>
    [[nodiscard]] std::vector<T> of(const std::vector<T>& all) const {
        return picked(all, numbers_);
    }

    template <class T>
    static std::vector<T> picked(const std::vector<T>& all, std::span<const std::uint32_t> from) {
        std::vector<T> out;
        if (all.empty()) return out;
        out.reserve(from.size());
        for (const std::uint32_t i : from) out.push_back(all[i]);
        return out;
    }

private:
    std::vector<std::uint32_t> numbers_, place_; // place_: empty if numbers_ is to be searched
};

} // namespace

Model piece_model(const Model& whole, std::span<const std::uint32_t> triangles) {
    Model piece;
    piece.triangles = Used::picked(whole.triangles, triangles);
    piece.triangle_materials = Used::picked(whole.triangle_materials, triangles);
    const Used materials(whole.materials.size(), piece.triangle_materials);
    for (std::uint32_t& m : piece.triangle_materials) m = materials(m);
    piece.materials = materials.of(whole.materials);
    std::vector<std::uint32_t> used;
    used.reserve(piece.materials.size());
    for (const Material& material : piece.materials) used.push_back(material.texture);
    const Used textures(whole.textures.size(), std::move(used));
    for (Material& material : piece.materials)
        if (material.texture != no_index) material.texture = textures(material.texture);
    piece.textures = textures.of(whole.textures);

    std::vector<std::uint32_t> corners;
    corners.reserve(3 * triangles.size());
    for (const Triangle& triangle : piece.triangles)
        corners.insert(corners.end(), triangle.vertex.begin(), triangle.vertex.end());
    const Used vertices(whole.positions.size(), std::move(corners));
    for (Triangle& triangle : piece.triangles)
        for (std::uint32_t& v : triangle.vertex) v = vertices(v);
    piece.positions = vertices.of(whole.positions);
    piece.normals = vertices.of(whole.normals);
    piece.colors = vertices.of(whole.colors);
    if (!piece.textures.empty()) piece.uvs = vertices.of(whole.uvs);
    return piece;
}

void move_to_local(Model& model, const Affine& to_world) {
    const Affine to_local = inverse(to_world);
    const Mat3 of_normals = normal_matrix(to_local.linear);
    for (Vec3f& position : model.positions)
        position = to_float(transform_point(to_local, to_double(position)));
    for (Vec3f& normal : model.normals) normal = to_float(normalize(of_normals * to_double(normal)));
    if (determinant(to_world.linear) < 0)
        for (Triangle& triangle : model.triangles) std::swap(triangle.vertex[1], triangle.vertex[2]);
}

} // namespace spa
