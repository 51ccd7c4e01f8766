// SPDX-License-Identifier: Apache-2.0
#include "light_paths.h"

#include "sampling.h"

#include "../measure/image_errors.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace spa::plan {
namespace {

Vec3f times(Vec3f a, Vec3f b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

// Of one pixel: mean over its channels of what relMSE adds up.
double relative_square(Vec3f changed, Vec3f truth) {
    const double epsilon = measure::ImageErrorOptions{}.epsilon;
    const auto one = [&](double x, double reference) {
        return (x - reference) * (x - reference) / (reference * reference + epsilon);
    };
    return (one(changed.x, truth.x) + one(changed.y, truth.y) + one(changed.z, truth.z)) / 3;
}

double sphere_solid_angle(double radius, double distance) {
    if (distance <= radius) return 4 * std::numbers::pi;
    const double sine = radius / distance;
    return 2 * std::numbers::pi * (1 - std::sqrt(1 - sine * sine));
}

struct PixelGrid {
    std::uint32_t columns = 1, rows = 1;
};

// About `count` cells of the shape of the picture's.
PixelGrid pixel_grid(double count, std::uint32_t width, std::uint32_t height) {
    const double cell = std::sqrt(double(width) * height / std::max(count, 1.0));
    const auto cells = [&](std::uint32_t size) {
        return std::clamp(std::uint32_t(std::lround(size / cell)), 1U, size);
    };
    return {cells(width), cells(height)};
}

} // namespace

struct LightPaths::Traced {
    double error = 0;
    Vec3f radiance; // changed minus true
    std::vector<double> distances;
    std::uint64_t rays = 0, missed = 0, extra = 0;
};

LightPaths::LightPaths(const UnitScene& scene, const std::vector<SceneObject>& objects,
                       std::span<const Camera> cameras, const PathOptions& options)
    : scene_(scene), objects_(objects), options_(options) {
    const double pixels = double(options.most_rays) / options.samples / double(cameras.size());
    const PixelGrid grid = pixel_grid(pixels, options.width, options.height);
    const std::size_t of_camera = std::size_t(grid.columns) * grid.rows;
    pixels_.resize(of_camera * cameras.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels_.size(), 16), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            const std::size_t cell = i % of_camera;
            // Somewhere in its cell, so that no pattern of the scene repeats in the grid.
            const std::uint32_t noise = hashed(std::uint32_t(cell));
            const auto place = [](std::size_t at, std::uint32_t cells, std::uint32_t size,
                                  std::uint32_t random) {
                return std::uint32_t((double(at) + random / 65536.0) * size / cells);
            };
            trace_pixel(cameras[i / of_camera],
                        place(cell % grid.columns, grid.columns, options_.width, noise & 0xFFFFU),
                        place(cell / grid.columns, grid.rows, options_.height, noise >> 16U), pixels_[i]);
        }
    });
}

void LightPaths::trace_pixel(const Camera& camera, std::uint32_t x, std::uint32_t y, Pixel& pixel) const {
    UnitScene::Scratch scratch;
    std::vector<ObjectHit> hits;
    const Affine to_unit = scene_.to_unit() * camera.to_world;
    const double tan_y = std::tan(camera.vertical_fov / 2);
    const double tan_x = tan_y * options_.width / options_.height;
    const Vec3d of_camera{((x + 0.5) / options_.width * 2 - 1) * tan_x,
                          (1 - (y + 0.5) / options_.height * 2) * tan_y, -1};
    const Vec3f direction = to_float(normalize(transform_vector(to_unit, of_camera)));
    pixel.eye = to_float(to_unit.translation);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    scene_.first_hits(pixel.eye, direction, infinity, scratch, hits);
    if (hits.empty()) return;
    pixel.seen = true;
    pixel.surface = scene_.surface(hits.front(), pixel.eye, direction);
    pixel.start = pixel.surface.position + pixel.surface.plane * scene_.start_height();
    const SampleShift shift = sample_shift(y * options_.width + x, options_.seed);
    Vec3f sum;
    for (std::uint32_t i = 0; i < options_.samples; ++i) {
        Secondary ray;
        ray.direction = diffuse_direction(pixel.surface.normal, r2_point(i, shift));
        if (dot(pixel.surface.plane, ray.direction) <= 0) continue;
        scene_.first_hits(pixel.start, ray.direction, infinity, scratch, hits);
        ray.first_hit = std::uint32_t(pixel.hits.size());
        ray.hits = std::uint32_t(hits.size());
        pixel.hits.insert(pixel.hits.end(), hits.begin(), hits.end());
        ray.first_shadow = std::uint32_t(pixel.shadows.size());
        if (ray.hits > 0) {
            const SurfacePoint point = scene_.surface(pixel.hits[ray.first_hit], pixel.start, ray.direction);
            for (std::size_t light = 0; light < scene_.lights(); ++light) {
                Shadow shadow;
                shadow.start = point.position + point.plane * scene_.start_height();
                if (!scene_.lit(light, point, shadow.start, shadow.by)) continue;
                scene_.first_hits(shadow.start, shadow.by.way, shadow.by.range, scratch, hits);
                shadow.first_blocker = std::uint32_t(pixel.blockers.size());
                shadow.blockers = std::uint32_t(hits.size());
                for (const ObjectHit& hit : hits) pixel.blockers.push_back(hit.object);
                if (hits.empty()) sum = sum + shadow.by.radiance;
                pixel.shadows.push_back(shadow);
            }
        }
        ray.shadows = std::uint32_t(pixel.shadows.size()) - ray.first_shadow;
        pixel.rays.push_back(ray);
    }
    pixel.indirect = times(pixel.surface.albedo, sum) * (1 / float(options_.samples));
}

// Traces what a change of one object may change.
class LightPaths::Worker {
public:
    Worker(const LightPaths& paths, std::uint32_t object, const StandIn* stand_in)
        : paths_(paths), scene_(paths.scene_), object_(object), stand_in_(stand_in),
          radius_(std::max(paths.objects_[object].radius * paths.scene_.scale(), 1e-30)) {}

    Traced trace(const Pixel& pixel) {
        Traced traced;
        if (!pixel.seen) return traced;
        const bool starts_on_it = pixel.surface.object == object_ && stand_in_ != nullptr;
        const Vec3f start = starts_on_it
                                ? pixel.surface.position + pixel.surface.plane * stand_in_->start_height()
                                : pixel.start;
        Vec3f sum;
        for (const Secondary& ray : pixel.rays) {
            const std::span<const ObjectHit> known(pixel.hits.data() + ray.first_hit, ray.hits);
            const bool met = !known.empty() && known.front().object == object_;
            std::span<const ObjectHit> hits = known;
            if (starts_on_it) {
                scene_.first_hits(start, ray.direction, infinity, scratch_, hits_);
                hits = hits_;
            }
            const auto other = std::find_if(hits.begin(), hits.end(),
                                            [&](const ObjectHit& hit) { return hit.object != object_; });
            const float other_t = other == hits.end() ? infinity : other->t;
            trace::Hit hit;
            const bool meets =
                stand_in_ != nullptr && stand_in_->closest_hit(start, ray.direction, other_t, hit);
            count(met, meets, met ? double(known.front().t) : 0, double(hit.t), traced);
            if (meets)
                sum = sum + direct_light(stand_in_->surface(hit, start, ray.direction, object_),
                                         stand_in_->start_height());
            else if (other != hits.end() && !met && !starts_on_it)
                sum = sum + relight(pixel, ray);
            else if (other != hits.end())
                sum = sum + direct_light(scene_.surface(*other, start, ray.direction), scene_.start_height());
        }
        const Vec3f indirect = times(pixel.surface.albedo, sum) * (1 / float(paths_.options_.samples));
        traced.error = relative_square(indirect, pixel.indirect);
        traced.radiance = indirect - pixel.indirect;
        return traced;
    }

private:
    static constexpr float infinity = std::numeric_limits<float>::infinity();

    void count(bool met, bool meets, double before, double after, Traced& traced) const {
        traced.rays += met ? 1 : 0;
        if (met && meets)
            traced.distances.push_back(std::abs(after - before) / radius_);
        else if (met)
            ++traced.missed;
        else if (meets)
            ++traced.extra;
    }

    Vec3f direct_light(const SurfacePoint& point, float height) {
        Vec3f sum;
        const Vec3f start = point.position + point.plane * height;
        for (std::size_t light = 0; light < scene_.lights(); ++light) {
            LitBy by;
            if (!scene_.lit(light, point, start, by)) continue;
            if (stand_in_ != nullptr && stand_in_->blocked(start, by.way, by.range)) continue;
            if (!scene_.blocked(start, by.way, by.range, object_, scratch_)) sum = sum + by.radiance;
        }
        return sum;
    }

    // The surface is what it was; the object may stand in its light or not.
    Vec3f relight(const Pixel& pixel, const Secondary& ray) const {
        Vec3f sum;
        for (std::uint32_t i = 0; i < ray.shadows; ++i) {
            const Shadow& shadow = pixel.shadows[ray.first_shadow + i];
            const auto* const first = pixel.blockers.data() + shadow.first_blocker;
            if (std::any_of(first, first + shadow.blockers,
                            [&](std::uint32_t blocker) { return blocker != object_; }))
                continue;
            if (stand_in_ != nullptr && stand_in_->blocked(shadow.start, shadow.by.way, shadow.by.range))
                continue;
            sum = sum + shadow.by.radiance;
        }
        return sum;
    }

    const LightPaths& paths_;
    const UnitScene& scene_;
    std::uint32_t object_;
    const StandIn* stand_in_;
    double radius_;
    UnitScene::Scratch scratch_;
    std::vector<ObjectHit> hits_;
};

Change LightPaths::change(std::uint32_t object, const StandIn* stand_in) const {
    std::vector<Traced> traced(pixels_.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels_.size(), 32), [&](const auto& range) {
        Worker worker(*this, object, stand_in);
        for (std::size_t i = range.begin(); i < range.end(); ++i) traced[i] = worker.trace(pixels_[i]);
    });
    Change change;
    double squares = 0;
    std::vector<double> distances;
    for (std::uint32_t i = 0; i < traced.size(); ++i) {
        const Traced& pixel = traced[i];
        if (pixel.error > 0) change.pixels.push_back({i, pixel.radiance});
        change.image_error += pixel.error;
        squares += pixel.error * pixel.error;
        change.rays += pixel.rays;
        change.missed += pixel.missed;
        change.extra += pixel.extra;
        distances.insert(distances.end(), pixel.distances.begin(), pixel.distances.end());
    }
    const auto count = double(pixels_.size());
    change.image_error /= count;
    change.deviation =
        std::sqrt(std::max(0.0, squares / count - change.image_error * change.image_error) / count);
    change.distance = measure::distribution(std::move(distances));
    return change;
}

double LightPaths::image_error(std::span<const Vec3f> radiance_changes) const {
    double sum = 0;
    for (std::size_t i = 0; i < pixels_.size(); ++i)
        sum += relative_square(pixels_[i].indirect + radiance_changes[i], pixels_[i].indirect);
    return sum / double(pixels_.size());
}

std::uint64_t LightPaths::secondary_rays() const {
    std::uint64_t rays = 0;
    for (const Pixel& pixel : pixels_) rays += pixel.rays.size();
    return rays;
}

std::vector<Vec3f> LightPaths::indirect() const {
    std::vector<Vec3f> all;
    for (const Pixel& pixel : pixels_) all.push_back(pixel.indirect);
    return all;
}

std::vector<ObjectViews> LightPaths::views() const {
    std::vector<ObjectViews> views(objects_.size());
    std::vector<std::vector<double>> distances(objects_.size());
    const std::uint64_t all_rays = std::max<std::uint64_t>(secondary_rays(), 1);
    std::uint64_t surfaces = 0;
    for (const Pixel& pixel : pixels_) {
        if (!pixel.seen) continue;
        ++surfaces;
        views[pixel.surface.object].pixel_share += 1 / double(pixels_.size());
        for (const Secondary& ray : pixel.rays) {
            if (ray.hits == 0) continue;
            const ObjectHit& hit = pixel.hits[ray.first_hit];
            if (hit.object == pixel.surface.object) continue;
            ++views[hit.object].rays;
            distances[hit.object].push_back(double(hit.t) / scene_.scale());
            // Rays have the density cos / pi.
            const double cosine = std::max(1e-3, double(dot(ray.direction, pixel.surface.normal)));
            views[hit.object].solid_angle_mean += std::numbers::pi / (options_.samples * cosine);
        }
    }
    for (std::size_t i = 0; i < objects_.size(); ++i) {
        ObjectViews& view = views[i];
        view.ray_share = double(view.rays) / double(all_rays);
        view.solid_angle_mean /= double(std::max<std::uint64_t>(surfaces, 1));
        const Vec3d center = transform_point(scene_.to_unit(), objects_[i].center);
        double nearest = std::numeric_limits<double>::infinity();
        for (const Pixel& pixel : pixels_) {
            nearest = std::min(nearest, length(to_double(pixel.eye) - center));
            if (pixel.seen && pixel.surface.object != i)
                nearest = std::min(nearest, length(to_double(pixel.surface.position) - center));
        }
        view.solid_angle_max = sphere_solid_angle(objects_[i].radius * scene_.scale(), nearest);
        std::vector<double>& sorted = distances[i];
        if (sorted.empty()) continue;
        std::sort(sorted.begin(), sorted.end());
        view.distance_median = sorted[sorted.size() / 2];
        view.distance_min = sorted[sorted.size() / 20];
    }
    return views;
}

} // namespace spa::plan
