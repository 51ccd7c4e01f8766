// SPDX-License-Identifier: Apache-2.0
#include "map_surface.h"

#include "fold_cells.h"

#include "../../shaders/spa_cell.h"

#include "../core/element_format.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

namespace spa::trace {
namespace {

using Plane = shader::SpaPlane;

constexpr float far_w = SPA_FAR;
// A triangle of the grid; x and y count cells of its quadrant from the middle.
struct MapTriangle {
    std::uint32_t quadrant = 0;
    std::uint32_t x = 0, y = 0;
    std::uint32_t beyond = 0; // 0: at the cell's corner nearest to the middle, 1: the other one
};

struct Corner {
    double u = 0, v = 0; // in the cell, (0, 0) nearest to the middle
    TexelIndex texel;
};

std::array<Corner, 3> corners_of(const Grid& grid, const MapTriangle& t) {
    constexpr std::array<std::array<std::uint32_t, 2>, 6> places{
        {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0, 1}, {1, 0}}};
    const std::uint32_t middle = (grid.width - 1) / 2;
    std::array<Corner, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto [u, v] = places[3 * std::size_t(t.beyond) + i];
        corners[i] = {double(u),
                      double(v),
                      {(t.quadrant & 1U) == 0 ? middle + t.x + u : middle - t.x - u,
                       (t.quadrant & 2U) == 0 ? middle - t.y - v : middle + t.y + v}};
    }
    return corners;
}

// Region i of a mixed triangle is where corner i's barycentric coordinate is the largest: these two functions
// are not negative there (barycentric coordinates of the near half: 1-u-v, u, v; of the half beyond: u+v-1,
// 1-u, 1-v).
constexpr std::array<std::array<Plane, 2>, 6> region_half_planes{{
    {{{1, -2, -1}, {1, -1, -2}}},
    {{{-1, 2, 1}, {0, 1, -1}}},
    {{{-1, 1, 2}, {0, -1, 1}}},
    {{{-2, 2, 1}, {-2, 1, 2}}},
    {{{2, -2, -1}, {0, -1, 1}}},
    {{{2, -1, -2}, {0, 1, -1}}},
}};

// What lies on the other side of a region's two half-planes: the regions of these corners.
constexpr std::array<std::array<std::size_t, 2>, 3> neighbors{{{1, 2}, {0, 2}, {0, 1}}};

struct Slope {
    double u = 0, v = 0;
};

class CellFinder {
public:
    CellFinder(const Part& part, const MapSamples& samples) : part_(part), samples_(samples) {
        cells_count_ = (samples.grid.width - 1) / 2;
        // At least 1: turned places are known by flip_x, flip_y != 0 (spa_stretch.h).
        result_.levels = std::max(1U, std::uint32_t(std::bit_width(cells_count_ - 1)));
        result_.ranges.resize(std::size_t(4) << (2 * result_.levels));
        result_.cores.resize(result_.ranges.size()); // padding keeps nobody from skipping
        find_extent();
        // Records speak of all the stored layers.
        if (!part.folds.empty() && samples.layers() == part.layers.size()) folds_.emplace(part);
    }

    MapCells find() {
        for (std::uint32_t quadrant = 0; quadrant < 4; ++quadrant)
            for (std::uint32_t y = 0; y < cells_count_; ++y)
                for (std::uint32_t x = 0; x < cells_count_; ++x) add_cell(quadrant, x, y);
        if (any_empty_ && any_solid_) result_.uniform_core = false;
        return std::move(result_);
    }

private:
    [[nodiscard]] float w_of(std::uint32_t surface, TexelIndex texel) const {
        if (surface >= samples_.surfaces) return far_w;
        return samples_.w[surface * samples_.count() + std::size_t(texel.y) * samples_.grid.width + texel.x];
    }

    [[nodiscard]] std::uint32_t intervals_at(TexelIndex texel) const {
        std::uint32_t n = 0;
        while (n < samples_.layers() && w_of(2 * n, texel) < far_w) ++n;
        return n;
    }

    void find_extent() {
        result_.w_min = far_w;
        result_.w_max = 0;
        for (const float w : samples_.w) {
            if (w >= far_w) continue;
            result_.w_min = std::min(result_.w_min, w);
            result_.w_max = std::max(result_.w_max, w);
        }
        if (result_.w_max == 0) result_.w_min = result_.w_max = 1;
        // Of triangles the corners are farthest; regions with tangent planes add to it as they are made.
        for (std::uint32_t y = 0; y < samples_.grid.height; ++y)
            for (std::uint32_t x = 0; x < samples_.grid.width; ++x) {
                const float w = w_of(0, {x, y});
                if (w < far_w) extend(sample_direction(samples_.grid, {x, y}) * (1 / double(w)));
            }
        result_.uniform_core = true;
    }

    [[nodiscard]] bool is_mixed(const MapTriangle& t, const std::array<Corner, 3>& corners) const {
        const std::uint32_t n = intervals_at(corners[0].texel);
        for (std::size_t i = 1; i < 3; ++i)
            if (intervals_at(corners[i].texel) != n) return true;
        for (std::uint32_t k = 0; k < n; ++k)
            for (std::size_t i = 1; i < 3; ++i)
                if ((w_of(2 * k + 1, corners[0].texel) < far_w) !=
                    (w_of(2 * k + 1, corners[i].texel) < far_w))
                    return true;
        if (n == 0 || part_.mixed.empty()) return false;
        const TexelIndex cell = cell_of(t);
        return spa::is_mixed(part_.mixed, triangle_bit(2 * cells_count_, cell.x, cell.y, t.beyond));
    }

    // On the map, from the top left.
    [[nodiscard]] TexelIndex cell_of(const MapTriangle& t) const {
        return {(t.quadrant & 1U) == 0 ? cells_count_ + t.x : cells_count_ - 1 - t.x,
                (t.quadrant & 2U) == 0 ? cells_count_ - 1 - t.y : cells_count_ + t.y};
    }

    // Where the interval that reaches the centre begins.
    [[nodiscard]] float core_at(TexelIndex texel) const {
        const std::uint32_t n = intervals_at(texel);
        return n > 0 && w_of(2 * n - 1, texel) >= far_w ? w_of(2 * n - 2, texel) : far_w;
    }

    // What lies around the centre in the directions of a corner, or of a triangle that has the same there.
    void see_core(TexelIndex texel) {
        const std::uint32_t n = intervals_at(texel);
        const bool solid = n > 0 && w_of(2 * n - 1, texel) >= far_w;
        (solid ? any_solid_ : any_empty_) = true;
    }

    void add_cell(std::uint32_t quadrant, std::uint32_t x, std::uint32_t y) {
        const std::uint32_t side = 1U << result_.levels;
        const std::size_t column = (quadrant & 1U) == 0 ? x : side + x;
        const std::size_t row = (quadrant & 2U) == 0 ? y : side + y;
        const std::size_t cell = row * 2 * side + column;
        std::array<MapTriangle, 2> triangles;
        std::array<bool, 2> mixed{};
        float core = 0;
        for (std::uint32_t beyond = 0; beyond < 2; ++beyond) {
            triangles[beyond] = {quadrant, x, y, beyond};
            const std::array<Corner, 3> corners = corners_of(samples_.grid, triangles[beyond]);
            for (const Corner& corner : corners) see_core(corner.texel);
            mixed[beyond] = is_mixed(triangles[beyond], corners);
            if (!mixed[beyond]) {
                add_pure(corners, result_.ranges[cell]);
                for (const Corner& corner : corners) core = std::max(core, core_at(corner.texel));
            }
        }
        if (!mixed[0] && !mixed[1]) {
            result_.cores[cell] = core;
            if (has_layers(triangles)) {
                begin_cells();
                result_.cells[cell] = SPA_CELL_LAYERS;
            }
            return;
        }
        begin_cells();
        if (result_.lists.empty()) begin_lists();
        const std::size_t entry = result_.lists.size();
        result_.cells[cell] = std::uint32_t(entry);
        result_.lists.resize(entry + 2 * std::size_t(SPA_LIST_WORDS));
        for (std::uint32_t beyond = 0; beyond < 2; ++beyond) {
            const std::size_t list = entry + beyond * std::size_t(SPA_LIST_WORDS);
            const std::size_t first = result_.lists.size();
            std::uint32_t count = SPA_PURE;
            Range range{0, far_w};
            if (mixed[beyond]) {
                Ranges ranges;
                count = add_mixed(triangles[beyond], ranges, core);
                result_.ranges[cell].add(ranges);
                range = outward(ranges);
            }
            result_.lists[list] = std::uint32_t(first);
            result_.lists[list + 1] = count;
            result_.lists[list + 2] = std::bit_cast<std::uint32_t>(range.low);
            result_.lists[list + 3] = std::bit_cast<std::uint32_t>(range.high);
            result_.places.push_back(std::uint32_t(list));
        }
        result_.cores[cell] = core;
    }

    // From the first to the last of them, by more than rays are off.
    static Range outward(const Ranges& ranges) {
        constexpr float margin = 4e-6F;
        if (ranges.count() == 0) return {far_w, 0};
        return {ranges[0].low * (1 - margin), ranges[ranges.count() - 1].high * (1 + margin)};
    }

    // Whether a pure cell has more than the interval of layer 0.
    [[nodiscard]] bool has_layers(const std::array<MapTriangle, 2>& triangles) const {
        if (samples_.layers() < 2) return false;
        for (const MapTriangle& t : triangles)
            for (const Corner& corner : corners_of(samples_.grid, t))
                if (w_of(2, corner.texel) < far_w) return true;
        return false;
    }

    void begin_cells() { result_.cells.resize(result_.ranges.size(), SPA_CELL_PURE); }

    void begin_lists() {
        for (const auto& region : region_half_planes)
            for (const Plane& plane : region) append(plane);
    }

    void append(const Plane& plane) {
        for (const float value : {plane.c, plane.u, plane.v})
            result_.lists.push_back(std::bit_cast<std::uint32_t>(value));
    }

    void add_pure(const std::array<Corner, 3>& corners, Ranges& ranges) const {
        for (std::uint32_t k = 0; k < samples_.layers(); ++k) {
            Range range{far_w, 0};
            for (const Corner& corner : corners) {
                range.low = std::min(range.low, w_of(2 * k, corner.texel));
                range.high = std::max(range.high, w_of(2 * k + 1, corner.texel));
            }
            if (range.low < far_w) ranges.add(range);
        }
    }

    // Of w over (u, v) along the plane through a stored point with its stored normal.
    [[nodiscard]] Slope tangent(const MapTriangle& t, const Corner& corner, std::uint32_t surface) const {
        const Surface* const stored = stored_surface(part_, surface);
        if (stored == nullptr || stored->normal.empty()) return {};
        const ImageView& normals = stored->normal;
        const Vec3d g = sample_direction(samples_.grid, corner.texel);
        Vec3f n;
        if (normals.width == samples_.grid.width && normals.height == samples_.grid.height) {
            n = decode_normal(normals.format, normals.at(corner.texel.x, corner.texel.y));
        } else {
            const Vec2d p = position_of({Mapping::octahedral, normals.width, normals.height}, g);
            n = decode_normal(normals.format,
                              normals.at(std::uint32_t(std::lround(p.x)), std::uint32_t(std::lround(p.y))));
        }
        // The octant's signs: of the triangle's, as the corner may lie on its border.
        const bool upper = t.x + t.y + t.beyond < cells_count_;
        const Vec3d m{(t.quadrant & 1U) == 0 ? double(n.x) : -double(n.x),
                      (t.quadrant & 2U) == 0 ? double(n.y) : -double(n.y),
                      upper ? double(n.z) : -double(n.z)};
        // w = n.g / n.q over directions of |g|_1 = 1, with q = g / W.
        const double distance = dot(to_double(n), g) / double(w_of(surface, corner.texel));
        if (distance == 0 || !std::isfinite(1 / distance)) return {};
        const double scale = 1 / (distance * double(cells_count_));
        if (upper) return {(m.x - m.z) * scale, (m.y - m.z) * scale};
        return {(m.z - m.y) * scale, (m.z - m.x) * scale};
    }

    // The four corners of region `index`, seen from corner `index`.
    static std::array<Slope, 4> region_offsets(const std::array<Corner, 3>& corners, std::size_t index) {
        std::array<Slope, 4> offsets;
        const Corner& own = corners[index];
        Slope sum;
        for (std::size_t i = 1; i < 3; ++i) {
            const Corner& other = corners[(index + i) % 3];
            offsets[i] = {(other.u - own.u) / 2, (other.v - own.v) / 2};
            sum = {sum.u + other.u - own.u, sum.v + other.v - own.v};
        }
        offsets[3] = {sum.u / 3, sum.v / 3};
        return offsets;
    }

    static double change(const Slope& slope, const Slope& offset) {
        return slope.u * offset.u + slope.v * offset.v;
    }

    // Scaled so that W changes by 4 h W at most, h the size of a cell in (a, b), and by half of W on coarse
    // maps.
    [[nodiscard]] Slope limited(Slope slope, const std::array<Slope, 4>& offsets, double w) const {
        double most = 0;
        for (const Slope& offset : offsets) most = std::max(most, std::abs(change(slope, offset)));
        const double limit = std::min(4 / double(cells_count_), 0.5) * w;
        const double scale = most > limit ? limit / most : 1;
        return {slope.u * scale, slope.v * scale};
    }

    std::uint32_t add_mixed(const MapTriangle& t, Ranges& ranges, float& core) {
        const std::array<Corner, 3> corners = corners_of(samples_.grid, t);
        std::uint32_t count = 0;
        if (folds_ && add_folds(t, corners, ranges, core, count)) {
            ++result_.fold_triangles;
            return count;
        }
        ++result_.tangent_triangles;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t n = intervals_at(corners[i].texel);
            if (core_at(corners[i].texel) >= far_w) core = far_w;
            for (std::uint32_t k = 0; k < n; ++k, ++count) {
                const float highest = add_region(t, corners, i, k, ranges);
                if (k == n - 1) core = std::max(core, highest);
            }
        }
        return count;
    }

    // False: there are none that make sense.
    bool add_folds(const MapTriangle& t, const std::array<Corner, 3>& corners, Ranges& ranges, float& core,
                   std::uint32_t& count) {
        const TexelIndex cell = cell_of(t);
        const std::array<TexelIndex, 3> order =
            triangle_corners(samples_.grid.width - 1, cell.x, cell.y, t.beyond);
        std::array<SampleCrossings, 3> crossings;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::uint32_t s = 0; s < samples_.surfaces && w_of(s, order[i]) < far_w; ++s)
                crossings[i].push_back(double(w_of(s, order[i])));
        double begins = 0;
        if (!folds_->triangle(cell.x, cell.y, t.beyond, crossings, prisms_, begins)) return false;
        core = std::max(core, float(begins));
        for (const FoldPrism& prism : prisms_) {
            Range range{far_w, 0};
            for (const CellPoint& p : prism.corners) {
                const double outer = prism.outer.at(p.u, p.v);
                range.low = std::min(range.low, float(outer));
                result_.w_max = std::max(result_.w_max, float(outer));
                const double inner = prism.to_center ? double(far_w) : prism.inner.at(p.u, p.v);
                range.high = std::max(range.high, float(inner));
                const Corner& own = corners[0];
                extend(point_at(own, {p.u - own.u, p.v - own.v}, t, outer));
            }
            ranges.add(range);
            result_.w_min = std::min(result_.w_min, range.low);
            if (!prism.to_center) result_.w_max = std::max(result_.w_max, range.high);
            append(to_plane(prism.outer));
            append(prism.to_center ? Plane{far_w, 0, 0} : to_plane(prism.inner));
            result_.lists.push_back(SPA_PRISM_PROPERTIES(
                prism.outer_layer, prism.inner_layer, std::uint32_t(prism.half_planes.size()), prism.open));
            result_.places.push_back(std::uint32_t(result_.lists.size()));
            result_.lists.push_back(0);
        }
        // Prisms stand one behind the other; their half-planes come after all of them.
        const std::size_t first = result_.lists.size() - prisms_.size() * SPA_PRISM_WORDS;
        for (std::size_t n = 0; n < prisms_.size(); ++n) {
            result_.lists[first + n * SPA_PRISM_WORDS + 7] = std::uint32_t(result_.lists.size());
            for (const CellPlane& plane : prisms_[n].half_planes) append(to_plane(plane));
        }
        count = std::uint32_t(prisms_.size());
        return true;
    }

    static Plane to_plane(const CellPlane& plane) { return {float(plane.c), float(plane.u), float(plane.v)}; }

    // Gives back the highest w of the outer end.
    float add_region(const MapTriangle& t, const std::array<Corner, 3>& corners, std::size_t index,
                     std::uint32_t k, Ranges& ranges) {
        const Corner& corner = corners[index];
        const std::array<Slope, 4> offsets = region_offsets(corners, index);
        const double outer = double(w_of(2 * k, corner.texel));
        const double inner = double(w_of(2 * k + 1, corner.texel));
        const bool to_center = inner >= double(far_w);
        Slope outer_slope = limited(tangent(t, corner, 2 * k), offsets, outer);
        Slope inner_slope = to_center ? Slope{} : limited(tangent(t, corner, 2 * k + 1), offsets, inner);
        for (const Slope& offset : offsets)
            if (!to_center && outer + change(outer_slope, offset) > inner + change(inner_slope, offset)) {
                outer_slope = inner_slope = {};
                break;
            }
        Range range{far_w, 0};
        float highest = 0;
        for (const Slope& offset : offsets) {
            highest = std::max(highest, float(outer + change(outer_slope, offset)));
            range.low = std::min(range.low, float(outer + change(outer_slope, offset)));
            range.high = std::max(range.high, to_center ? far_w : float(inner + change(inner_slope, offset)));
            extend(point_at(corner, offset, t, outer + change(outer_slope, offset)));
        }
        ranges.add(range);
        result_.w_min = std::min(result_.w_min, range.low);
        result_.w_max = std::max(result_.w_max, highest);
        if (!to_center) result_.w_max = std::max(result_.w_max, range.high);
        append(plane_of(corner, outer, outer_slope));
        append(to_center ? Plane{far_w, 0, 0} : plane_of(corner, inner, inner_slope));
        std::uint32_t open = 0;
        if (to_center && part_.center_inside)
            for (std::uint32_t n = 0; n < 2; ++n)
                if (intervals_at(corners[neighbors[index][n]].texel) == 0) open |= 1U << n;
        result_.lists.push_back(SPA_PRISM_PROPERTIES(k, k, 2U, open));
        result_.places.push_back(std::uint32_t(result_.lists.size()));
        result_.lists.push_back((3 * t.beyond + std::uint32_t(index)) * 6);
        return highest;
    }

    static Plane plane_of(const Corner& corner, double w, const Slope& slope) {
        return {float(w - slope.u * corner.u - slope.v * corner.v), float(slope.u), float(slope.v)};
    }

    // A point of the surface in a triangle's cell.
    [[nodiscard]] Vec3d point_at(const Corner& corner, const Slope& offset, const MapTriangle& t,
                                 double w) const {
        const double a = (t.x + corner.u + offset.u) / cells_count_;
        const double b = (t.y + corner.v + offset.v) / cells_count_;
        const bool upper = t.x + t.y + t.beyond < cells_count_;
        const Vec3d g = upper ? Vec3d{a, b, 1 - a - b} : Vec3d{1 - b, 1 - a, 1 - a - b};
        return Vec3d{(t.quadrant & 1U) == 0 ? g.x : -g.x, (t.quadrant & 2U) == 0 ? g.y : -g.y, g.z} * (1 / w);
    }

    // Radius and box hold the point. By more than rays are off there.
    void extend(Vec3d point) {
        constexpr float margin = 2 * SPA_SLACK;
        result_.radius = std::max(result_.radius, float(length(point)) * (1 + margin));
        const Vec3f p = to_float(point);
        result_.box_low = {std::min(result_.box_low.x, p.x - margin),
                           std::min(result_.box_low.y, p.y - margin),
                           std::min(result_.box_low.z, p.z - margin)};
        result_.box_high = {std::max(result_.box_high.x, p.x + margin),
                            std::max(result_.box_high.y, p.y + margin),
                            std::max(result_.box_high.z, p.z + margin)};
    }

    const Part& part_;
    const MapSamples& samples_;
    std::uint32_t cells_count_ = 1;
    MapCells result_;
    bool any_solid_ = false, any_empty_ = false;
    std::optional<FoldCells> folds_;
    std::vector<FoldPrism> prisms_; // of the triangle at hand
};

} // namespace

MapCells find_cells(const Part& part, const MapSamples& samples) { return CellFinder(part, samples).find(); }

} // namespace spa::trace
