// SPDX-License-Identifier: Apache-2.0
#include "compare.h"

#include "angle.h"

#include <algorithm>
#include <cmath>

namespace spa::measure {
namespace {

bool same_size(const ImageView& a, const ImageView& b) {
    return a.empty() || b.empty() || (a.width == b.width && a.height == b.height);
}

void compare_shape(const Surface& a, const Surface& b, Mapping mapping, double tolerance,
                   SurfaceDifference& out) {
    const ImageView& size = a.depth.empty() ? b.depth : a.depth;
    const Grid grid{mapping, size.width, size.height};
    const bool has_normals = !a.normal.empty() && !b.normal.empty();
    const auto depth = [](const Surface& s, std::uint32_t x, std::uint32_t y) {
        return s.depth.empty() ? 0.0 : double(decode_depth(s.depth.format, s.depth.at(x, y)));
    };
    const auto normal = [&](const Surface& s, std::uint32_t x, std::uint32_t y) {
        return to_double(decode_normal(s.normal.format, nearest_element(s.normal, grid, {x, y})));
    };
    std::vector<double> angles;
    for (std::uint32_t y = 0; y < size.height; ++y) {
        for (std::uint32_t x = 0; x < size.width; ++x) {
            ++out.samples;
            const double da = depth(a, x, y);
            const double db = depth(b, x, y);
            if ((da > 0) != (db > 0)) ++out.coverage_differs;
            if (!(da > 0) || !(db > 0)) continue;
            ++out.both;
            const double difference = std::abs(da - db);
            if (difference > tolerance * (1 + 1e-6)) ++out.depth_differs;
            out.depth_mean += difference;
            out.depth_max = std::max(out.depth_max, difference);
            if (!has_normals) continue;
            angles.push_back(angle_degrees(normal(a, x, y), normal(b, x, y)));
            out.normal_mean += angles.back();
            out.normal_max = std::max(out.normal_max, angles.back());
        }
    }
    if (out.both > 0) out.depth_mean /= double(out.both);
    if (!angles.empty()) {
        const auto middle = angles.begin() + std::ptrdiff_t(angles.size() / 2);
        std::nth_element(angles.begin(), middle, angles.end());
        out.normal_median = *middle;
        out.normal_mean /= double(angles.size());
    }
}

void compare_color(const Surface& a, const Surface& b, SurfaceDifference& out) {
    const ImageView& size = a.color.empty() ? b.color : a.color;
    const auto channel = [](const Surface& s, std::uint32_t x, std::uint32_t y, unsigned c) {
        return s.color.empty() ? 0 : std::to_integer<int>(s.color.at(x, y)[c]);
    };
    std::uint64_t covered = 0;
    for (std::uint32_t y = 0; y < size.height; ++y) {
        for (std::uint32_t x = 0; x < size.width; ++x) {
            const int alpha_a = channel(a, x, y, 3);
            const int alpha_b = channel(b, x, y, 3);
            out.alpha_mean += std::abs(alpha_a - alpha_b);
            if (alpha_a == 0 || alpha_b == 0) continue;
            ++covered;
            for (unsigned c = 0; c < 3; ++c) {
                const int difference = std::abs(channel(a, x, y, c) - channel(b, x, y, c));
                out.color_mean += difference;
                out.color_max = std::max(out.color_max, std::uint32_t(difference));
            }
        }
    }
    if (covered > 0) out.color_mean /= 3 * double(covered);
    const double texels = double(size.width) * size.height;
    if (texels > 0) out.alpha_mean /= texels;
}

PartDifference compare_placement(std::uint32_t index, const Part& a, const Part& b) {
    PartDifference difference;
    difference.part = index;
    difference.center = length(b.center - a.center) / a.radius;
    difference.radius = std::abs(b.radius - a.radius) / a.radius;
    for (unsigned k = 0; k < 3; ++k) {
        const Vec3d row = b.frame.row[k] - a.frame.row[k];
        difference.frame = std::max({difference.frame, std::abs(row.x), std::abs(row.y), std::abs(row.z)});
    }
    return difference;
}

} // namespace

const char* name(Side side) { return side == Side::outer ? "outer" : "inner"; }

Surface surface_of(const Part& part, std::size_t layer, Side side) {
    if (layer >= part.layers.size()) return {};
    return side == Side::outer ? part.layers[layer].outer : part.layers[layer].inner;
}

const std::byte* nearest_element(const ImageView& image, const Grid& grid, TexelIndex sample) {
    const Grid own{grid.mapping, image.width, image.height};
    if (own == grid) return image.at(sample.x, sample.y);
    const Vec2d position = position_of(own, sample_direction(grid, sample));
    const TexelIndex at = wrap(own, std::llround(position.x), std::llround(position.y));
    return image.at(at.x, at.y);
}

MapDifference compare(const SphericalMap& a, const SphericalMap& b, const CompareOptions& options) {
    MapDifference result;
    if (a.parts.size() != b.parts.size()) {
        result.structure = "one map has " + std::to_string(a.parts.size()) + " parts, the other " +
                           std::to_string(b.parts.size());
        return result;
    }
    for (std::uint32_t p = 0; p < a.parts.size(); ++p) {
        const Part& pa = a.parts[p];
        const Part& pb = b.parts[p];
        if (pa.mapping != pb.mapping) {
            return {"part " + std::to_string(p) + " has mapping " + name(pa.mapping) + " in one map and " +
                        name(pb.mapping) + " in the other",
                    {},
                    {}};
        }
        result.parts.push_back(compare_placement(p, pa, pb));
        for (std::uint32_t l = 0; l < std::max(pa.layers.size(), pb.layers.size()); ++l) {
            for (const Side side : {Side::outer, Side::inner}) {
                const Surface sa = surface_of(pa, l, side);
                const Surface sb = surface_of(pb, l, side);
                if (sa.empty() && sb.empty()) continue;
                if (!same_size(sa.depth, sb.depth) || !same_size(sa.color, sb.color) ||
                    !same_size(sa.normal, sb.normal)) {
                    return {"the images of part " + std::to_string(p) + ", layer " + std::to_string(l) +
                                " differ in size",
                            {},
                            {}};
                }
                SurfaceDifference difference;
                difference.part = p;
                difference.layer = l;
                difference.side = side;
                compare_shape(sa, sb, pa.mapping, options.depth_tolerance, difference);
                compare_color(sa, sb, difference);
                result.surfaces.push_back(difference);
            }
        }
    }
    return result;
}

} // namespace spa::measure
