// SPDX-License-Identifier: Apache-2.0
#include "thumbnail.h"

#include "coarse_part.h"

#include "../libspa/trace/shade.h"
#include "../libspa/trace/space.h"
#include "../libspa/trace/trace.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace spa::tools {

namespace {

constexpr std::uint32_t samples = 2; // a side of a pixel

struct Box {
    Vec3d low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
              std::numeric_limits<double>::infinity()};
    Vec3d high = -low;

    void add(Vec3d p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    [[nodiscard]] bool empty() const { return !(low.x <= high.x); }
};

// The outermost samples of all parts, in object space.
std::vector<Vec3d> surface_points(const std::vector<CoarsePart>& parts) {
    std::vector<Vec3d> points;
    for (const CoarsePart& coarse : parts) {
        const Part& part = coarse.part;
        const ImageView& depth = part.layers.front().outer.depth;
        const Grid grid{part.mapping, depth.width, depth.height};
        for (std::uint32_t y = 0; y < depth.height; ++y)
            for (std::uint32_t x = 0; x < depth.width; ++x) {
                const double d = double(decode_depth(depth.format, depth.at(x, y)));
                if (!(d > 0)) continue;
                const Vec3d q = normalize(sample_direction(grid, {x, y})) * (d * part.radius);
                points.push_back(part.center + part.frame * q);
            }
    }
    return points;
}

// Moves the points into the box [-1,1]^3, so that whatever the size and place of the object, floats hold it.
Affine to_unit(const std::vector<Vec3d>& points) {
    Box box;
    for (const Vec3d& p : points) box.add(p);
    const Vec3d half = (box.high - box.low) * 0.5;
    const double scale = 1 / std::max({half.x, half.y, half.z, std::numeric_limits<double>::min()});
    Affine map;
    for (Vec3d& row : map.linear.row) row = row * scale;
    map.translation = (box.low + box.high) * (-0.5 * scale);
    return map;
}

// Looks at the origin; its picture is a square window of the plane at distance 1.
class Camera {
public:
    explicit Camera(const std::vector<Vec3d>& points) {
        const Vec3d back = normalize(Vec3d{0.55, 0.45, 1});
        eye_ = back * 6.0;
        right_ = normalize(cross(Vec3d{0, 1, 0}, back));
        up_ = cross(back, right_);
        forward_ = -back;
        Box window;
        for (const Vec3d& p : points) {
            const Vec3d to = p - eye_;
            const double depth = dot(to, forward_);
            window.add({dot(to, right_) / depth, dot(to, up_) / depth, 0});
        }
        middle_ = (window.low + window.high) * 0.5;
        constexpr double margin = 1.06;
        half_ = std::max({window.high.x - middle_.x, window.high.y - middle_.y, 1e-6}) * margin;
    }

    // (x, y) from the upper left corner of the picture, in [0,1].
    [[nodiscard]] trace::Ray ray(double x, double y) const {
        const Vec3d direction =
            forward_ + right_ * (middle_.x + half_ * (2 * x - 1)) + up_ * (middle_.y + half_ * (1 - 2 * y));
        trace::Ray ray;
        ray.origin = to_float(eye_);
        ray.direction = to_float(direction);
        return ray;
    }

    // Where the light comes from: over the viewer's left shoulder.
    [[nodiscard]] Vec3f light() const { return to_float(normalize(up_ * 0.5 - right_ * 0.5 - forward_)); }

private:
    Vec3d eye_, right_, up_, forward_, middle_;
    double half_ = 1;
};

// Four rays a pixel, those of a pixel one after the other.
std::vector<trace::Ray> camera_rays(const Camera& camera, std::uint32_t size) {
    std::vector<trace::Ray> rays;
    rays.reserve(std::size_t(size) * size * samples * samples);
    const auto place = [size](std::uint32_t pixel, std::uint32_t sample) {
        return (pixel + (sample + 0.5) / samples) / size;
    };
    for (std::uint32_t y = 0; y < size; ++y)
        for (std::uint32_t x = 0; x < size; ++x)
            for (std::uint32_t s = 0; s < samples * samples; ++s)
                rays.push_back(camera.ray(place(x, s % samples), place(y, s / samples)));
    return rays;
}

struct Seen {
    float t = std::numeric_limits<float>::infinity();
    Vec3f color; // linear light
};

// Where the part is nearer than what is seen so far, it takes its place. One thread, unlike trace::Scene.
void look_at(const Part& part, const Affine& object_to_unit, const std::vector<trace::Ray>& rays, Vec3f light,
             std::vector<Seen>& seen) {
    const trace::TraceMap map(part);
    const trace::MapSpace space = trace::map_space(part, object_to_unit);
    std::vector<trace::Ray> map_rays;
    map_rays.reserve(rays.size());
    for (const trace::Ray& ray : rays) map_rays.push_back(trace::to_map(space, ray));
    std::vector<trace::Hit> hits(rays.size());
    trace::closest_hits(map, map_rays, trace::no_flags, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!(hits[i].t < seen[i].t)) continue;
        const trace::Shade shade = trace::shade(map, hits[i]);
        const Vec3f normal = trace::normal_to_world(space, shade.normal);
        const float lit = std::max(dot(normal, light), 0.0F);
        seen[i] = {hits[i].t, shade.color * (0.1F + 0.75F * lit)};
    }
}

} // namespace

Picture thumbnail(const SphericalMap& map, std::uint32_t size) {
    // At least two samples a pixel across the object. A power of two, since the sizes of most maps are: their
    // samples are then among the original ones.
    const std::uint32_t cells = std::bit_ceil(2 * std::clamp(size, 16U, 1U << 12U));
    std::vector<CoarsePart> parts;
    for (const Part& part : map.parts) parts.push_back(coarse_part(part, cells));
    const std::vector<Vec3d> points = surface_points(parts);
    Picture picture(size, size, thumbnail_background);
    if (points.empty()) return picture;

    const Affine object_to_unit = to_unit(points);
    std::vector<Vec3d> unit_points = points;
    for (Vec3d& p : unit_points) p = transform_point(object_to_unit, p);
    const Camera camera(unit_points);
    const std::vector<trace::Ray> rays = camera_rays(camera, size);
    std::vector<Seen> seen(rays.size());
    for (const CoarsePart& coarse : parts) look_at(coarse.part, object_to_unit, rays, camera.light(), seen);

    const Vec3f background{srgb_to_linear(thumbnail_background[0]), srgb_to_linear(thumbnail_background[1]),
                           srgb_to_linear(thumbnail_background[2])};
    const SrgbEncoder encode;
    constexpr std::size_t per_pixel = std::size_t(samples) * samples;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        Vec3f sum;
        bool any = false;
        for (std::size_t s = i * per_pixel; s < (i + 1) * per_pixel; ++s) {
            const bool hit = std::isfinite(seen[s].t);
            sum = sum + (hit ? seen[s].color : background);
            any = any || hit;
        }
        if (!any) continue;
        const Vec3f mean = sum * (1.0F / float(per_pixel));
        picture.pixels[i] = {encode(mean.x), encode(mean.y), encode(mean.z)};
    }
    return picture;
}

} // namespace spa::tools
