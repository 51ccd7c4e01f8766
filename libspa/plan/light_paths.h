// SPDX-License-Identifier: Apache-2.0
// The light of one diffuse bounce on a modest number of a picture's pixels, as `spa render` computes it
// (../../docs/rendering.md), and how it changes when one object is replaced by a map or left out. From the
// same rays: from where objects are seen, and how far away they are.
//
// What other rays meet is remembered with all objects along each ray, so a change of one object costs little:
// only rays that pass its sphere, and those that start on it, are traced again.
#pragma once

#include "stand_in.h"
#include "unit_scene.h"

#include "../measure/statistics.h"

#include <cstdint>
#include <span>
#include <vector>

namespace spa::plan {

struct PathOptions {
    std::uint32_t width = 960, height = 540; // of the picture
    std::uint32_t samples = 32;              // secondary rays of a pixel
    std::uint32_t seed = 1;
    std::uint32_t most_rays = 131072; // secondary, of all cameras; decides the number of pixels
};

// From where rays meet an object. Its own surfaces do not count.
struct ObjectViews {
    std::uint64_t rays = 0;      // secondary ones that meet it first
    double ray_share = 0;        // of all secondary rays
    double pixel_share = 0;      // of the pixels, which show it
    double solid_angle_max = 0;  // sr, of its bounding sphere, from the surface or camera nearest to it
    double solid_angle_mean = 0; // sr, of what is visible of it, mean over all surfaces that cameras see
    double distance_median = 0;  // of those rays, in world units
    double distance_min = 0;     // the closest twentieth (5th percentile)
};

// A pixel whose light a change changes.
struct PixelChange {
    std::uint32_t pixel = 0;
    Vec3f radiance; // changed minus true
};

// What a change does.
struct Change {
    std::vector<PixelChange> pixels; // ascending
    // relMSE of the indirect light (measure/image_errors.h) over all pixels, those without a surface
    // included.
    double image_error = 0;
    double deviation = 0;           // standard deviation of image_error as an estimate from so few pixels
    measure::Distribution distance; // |dt| of secondary rays that meet the object both ways, in its radius
    std::uint64_t rays = 0;         // that met the object
    std::uint64_t missed = 0, extra = 0; // that meet it no more, or newly
};

class LightPaths {
public:
    // All outlive this object. Parallel in the caller's arena; the same arguments give the same figures.
    LightPaths(const UnitScene& scene, const std::vector<SceneObject>& objects,
               std::span<const Camera> cameras, const PathOptions& options);

    [[nodiscard]] std::vector<ObjectViews> views() const;
    // stand_in: nullptr leaves the object out. Parallel in the caller's arena. O(rays).
    [[nodiscard]] Change change(std::uint32_t object, const StandIn* stand_in) const;

    // relMSE of changes together; one entry a pixel.
    [[nodiscard]] double image_error(std::span<const Vec3f> radiance_changes) const;

    [[nodiscard]] std::size_t pixels() const { return pixels_.size(); }
    [[nodiscard]] std::uint64_t secondary_rays() const;
    [[nodiscard]] std::vector<Vec3f> indirect() const; // light of each pixel

private:
    struct Shadow { // of a light that would reach a surface
        LitBy by;
        Vec3f start;
        std::uint32_t first_blocker = 0, blockers = 0;
    };
    struct Secondary {
        Vec3f direction;
        std::uint32_t first_hit = 0, hits = 0;
        std::uint32_t first_shadow = 0, shadows = 0;
    };
    struct Pixel {
        Vec3f eye;
        bool seen = false; // there is a surface
        SurfacePoint surface;
        Vec3f start;
        std::vector<Secondary> rays;
        std::vector<ObjectHit> hits;
        std::vector<Shadow> shadows;
        std::vector<std::uint32_t> blockers; // objects
        Vec3f indirect;
    };
    struct Traced; // how a change went on one pixel
    class Worker;

    void trace_pixel(const Camera& camera, std::uint32_t x, std::uint32_t y, Pixel& pixel) const;

    const UnitScene& scene_;
    const std::vector<SceneObject>& objects_;
    PathOptions options_;
    std::vector<Pixel> pixels_;
};

} // namespace spa::plan
