// SPDX-License-Identifier: Apache-2.0
#include "texel_errors.h"

#include "angle.h"

#include "../bake/arena.h"
#include "../bake/color_image.h"
#include "../bake/progress_meter.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

namespace spa::measure {
namespace {

using bake::SurfacePoint;

constexpr float not_measured = std::numeric_limits<float>::quiet_NaN();
// As many as triangles are likely to meet in a vertex, such as the pole of a sphere.
constexpr unsigned tie_directions = 32;

std::array<CenterRay, tie_directions> directions_around(const Grid& grid, TexelIndex at, double radius) {
    const Vec3d u = normalize(sample_direction(grid, at));
    const Vec3d other = std::abs(u.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    const Vec3d right = normalize(cross(other, u));
    const Vec3d up = cross(u, right);
    std::array<CenterRay, tie_directions> rays;
    for (unsigned k = 0; k < tie_directions; ++k) {
        const double angle = 2 * std::numbers::pi * (k + 0.5) / tie_directions;
        const Vec3d shift = right * std::cos(angle) + up * std::sin(angle);
        // tie_distance is a distance at the surface, so the angle grows towards the centre.
        rays[k] = {at, u + shift * (1.5 * tie_distance / std::max(radius, 1e-3))};
    }
    return rays;
}

struct Stored {
    double radius = 0; // in units of the reference
    Vec3d normal;      // frame space
};

class SurfaceCheck {
public:
    SurfaceCheck(const Part& part, const Reference& reference, std::uint32_t layer, Side side)
        : reference_(reference), surface_(surface_of(part, layer, side)),
          index_(2 * std::size_t(layer) + (side == Side::inner ? 1 : 0)),
          scale_(part.radius / reference.source_radius()), frame_(part.frame),
          normal_to_object_(transpose(inverse(part.frame))) {
        errors.layer = layer;
        errors.side = side;
        // Normals of other directions than the depths' have no exact counterpart here.
        if (surface_.normal.width != surface_.depth.width || surface_.normal.height != surface_.depth.height)
            surface_.normal = {};
        errors.grid = {part.mapping, surface_.depth.width, surface_.depth.height};
        errors.color_grid = {part.mapping, surface_.color.width, surface_.color.height}; // 0 x 0 if absent
        const std::size_t texels = std::size_t(errors.grid.width) * errors.grid.height;
        errors.state.resize(texels, TexelState::empty);
        for (auto* values : {&errors.distance, &errors.depth, &errors.normal})
            values->resize(texels, not_measured);
    }

    TexelErrors errors;
    [[nodiscard]] std::size_t index() const { return index_; } // into SurfaceGrid::surfaces

    // Against the reference along the texel's own direction.
    void check(std::size_t i) { check_point(i, point(reference_.shape(), i), false); }

    [[nodiscard]] bool disagrees(std::size_t i) const {
        return errors.state[i] != TexelState::exact && errors.state[i] != TexelState::empty;
    }

    // Against the surfaces along directions around it; the first that agrees settles it.
    void check_around(std::size_t i, const bake::SurfaceGrid& around, std::size_t first) {
        for (std::size_t k = first; k < first + tie_directions; ++k) {
            const SurfacePoint p = point(around, k);
            if (state(stored(i), p) == TexelState::exact || (stored(i).radius == 0 && p.radius == 0)) {
                check_point(i, p, true);
                return;
            }
        }
    }

    // After all else: where the stored point lies in space. A point on the mesh at a known distance bounds
    // the search.
    void measure_distance(std::size_t i) {
        const Stored s = stored(i);
        if (!(s.radius > 0) || point(reference_.shape(), i).placed) return;
        const Vec3d u = normalize(sample_direction(errors.grid, texel(i)));
        const float along = errors.depth[i];
        const double bound = std::isnan(along) ? std::numeric_limits<double>::infinity()
                                               : double(along) * (1 + 1e-6) * length(frame_ * u) + 1e-5;
        const Vec3d position = frame_ * u * s.radius;
        trace::ClosestPoint closest = reference_.scene().closest_point(position, bound);
        if (closest.triangle == no_index) closest = reference_.scene().closest_point(position);
        errors.distance[i] = float(closest.distance);
    }

private:
    [[nodiscard]] TexelIndex texel(std::size_t i) const {
        return {std::uint32_t(i % errors.grid.width), std::uint32_t(i / errors.grid.width)};
    }
    [[nodiscard]] SurfacePoint point(const bake::SurfaceGrid& grid, std::size_t i) const {
        return index_ < grid.surfaces.size() ? grid.surfaces[index_][i] : SurfacePoint{};
    }
    [[nodiscard]] Stored stored(std::size_t i) const {
        const TexelIndex at = texel(i);
        const double depth = double(decode_depth(surface_.depth.format, surface_.depth.at(at.x, at.y)));
        if (!(depth > 0)) return {};
        const ImageView& normal = surface_.normal;
        return {depth * scale_,
                normal.empty() ? Vec3d{} : to_double(decode_normal(normal.format, normal.at(at.x, at.y)))};
    }
    [[nodiscard]] double angle(const Stored& s, const SurfacePoint& p) const {
        if (surface_.normal.empty()) return 0;
        return angle_degrees(normal_to_object_ * s.normal, normal_to_object_ * to_double(p.normal));
    }
    [[nodiscard]] TexelState state(const Stored& s, const SurfacePoint& p) const {
        if (!(s.radius > 0)) return p.radius > 0 ? TexelState::missing : TexelState::empty;
        if (!(p.radius > 0)) return TexelState::extra;
        const double off = std::abs(s.radius - double(p.radius));
        if (off > depth_quantum_error(surface_.depth.format) * scale_ + float_rounding)
            return TexelState::off;
        return angle(s, p) > normal_tolerance(surface_.normal.format) ? TexelState::off : TexelState::exact;
    }
    void check_point(std::size_t i, const SurfacePoint& p, bool tie) {
        const Stored s = stored(i);
        errors.state[i] = tie ? TexelState::tie : state(s, p);
        if (!(s.radius > 0) || !(p.radius > 0)) return;
        errors.depth[i] = float(std::abs(s.radius - double(p.radius)));
        if (!surface_.normal.empty()) errors.normal[i] = float(angle(s, p));
    }

    const Reference& reference_;
    Surface surface_;
    std::size_t index_;
    double scale_;
    Mat3 frame_, normal_to_object_;
};

using Texels = std::vector<std::size_t>;

// The rays around the given texels, tie_directions each. surfaces: along the texels' own directions.
std::vector<CenterRay> rays_around(const Grid& grid, const Texels& texels,
                                   const bake::SurfaceGrid& surfaces) {
    std::vector<CenterRay> rays;
    rays.reserve(texels.size() * tie_directions);
    for (const std::size_t i : texels) {
        const TexelIndex at{std::uint32_t(i % grid.width), std::uint32_t(i / grid.width)};
        // Far enough for the innermost too.
        float radius = 1;
        for (const auto& surface : surfaces.surfaces)
            if (surface[i].radius > 0) radius = std::min(radius, surface[i].radius);
        for (const CenterRay& ray : directions_around(grid, at, double(radius))) rays.push_back(ray);
    }
    return rays;
}

bool worth_a_second_look(const Texels& texels, const Grid& grid) {
    return !texels.empty() && texels.size() <= std::size_t(grid.width) * grid.height / 8;
}

template <class Visit>
void each_texel(std::size_t texels, bake::ProgressMeter& meter, Visit&& visit) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, texels, 256), [&](const auto& range) {
        if (meter.cancelled()) return;
        for (std::size_t i = range.begin(); i < range.end(); ++i) visit(i);
        meter.add(range.size());
    });
    meter.throw_if_cancelled();
}

void check_shape(std::vector<SurfaceCheck>& checks, const Reference& reference,
                 const bake::Progress& progress) {
    const Grid& grid = reference.shape().grid;
    const std::size_t count = std::size_t(grid.width) * grid.height;
    Texels disagreeing;
    for (std::size_t i = 0; i < count; ++i) {
        for (SurfaceCheck& check : checks) check.check(i);
        if (std::any_of(checks.begin(), checks.end(), [&](const SurfaceCheck& c) { return c.disagrees(i); }))
            disagreeing.push_back(i);
    }
    if (worth_a_second_look(disagreeing, grid)) {
        const bake::SurfaceGrid around =
            reference.cast(grid, rays_around(grid, disagreeing, reference.shape()), {});
        for (std::size_t k = 0; k < disagreeing.size(); ++k) {
            for (SurfaceCheck& check : checks)
                if (check.disagrees(disagreeing[k]))
                    check.check_around(disagreeing[k], around, k * tie_directions);
        }
    }
    bake::ProgressMeter meter(progress, count);
    each_texel(count, meter, [&](std::size_t i) {
        for (SurfaceCheck& check : checks) check.measure_distance(i);
    });
}

using ColorError = TexelErrors::ColorError;

float largest(const ColorError& e) { return std::isnan(e[0]) ? e[3] : std::max({e[0], e[1], e[2], e[3]}); }

// exact, stored: sRGB and coverage, as in the file.
ColorError color_error(const bake::Rgba8& exact, const std::byte* stored) {
    ColorError error;
    for (unsigned c = 0; c < 4; ++c)
        error[c] = float(std::abs(int(exact[c]) - std::to_integer<int>(stored[c])));
    if (exact[3] == 0 || stored[3] == std::byte{0}) error[0] = error[1] = error[2] = not_measured;
    if (exact[3] == 0 && stored[3] == std::byte{0}) error[3] = not_measured;
    return error;
}

// What two texture units that filter alike may differ by.
constexpr float color_rounding = 2;

void check_colors(const Part& part, std::vector<SurfaceCheck>& checks, const Reference& reference,
                  std::uint32_t samples, const bake::Progress& progress) {
    const bake::SurfaceGrid* cast = &reference.shape();
    bake::SurfaceGrid own;
    for (SurfaceCheck& check : checks) {
        TexelErrors& errors = check.errors;
        const ImageView image = surface_of(part, errors.layer, errors.side).color;
        if (image.empty()) continue;
        const Grid fine = bake::fine_grid(errors.color_grid, samples);
        if (fine != cast->grid) {
            own = reference.cast(fine, progress);
            cast = &own;
        }
        const std::vector<bake::Rgba8> exact =
            bake::filter_color(cast->surfaces[check.index()], errors.color_grid, samples);
        const auto pixel = [&](std::size_t i) {
            return image.bytes.data() + i * element_size(ElementFormat::rgba8);
        };
        Texels disagreeing;
        errors.color.reserve(exact.size());
        for (std::size_t i = 0; i < exact.size(); ++i) {
            errors.color.push_back(color_error(exact[i], pixel(i)));
            if (largest(errors.color[i]) > 0) disagreeing.push_back(i);
        }
        // Another texture unit rounds elsewhere; what is left then is what rounding does not explain.
        if (!worth_a_second_look(disagreeing, errors.color_grid))
            std::erase_if(disagreeing,
                          [&](std::size_t i) { return largest(errors.color[i]) <= color_rounding; });
        // A texel filtered from several samples is no single direction.
        if (samples > 1 || !worth_a_second_look(disagreeing, errors.color_grid)) continue;
        const bake::SurfaceGrid around =
            reference.cast(errors.color_grid, rays_around(errors.color_grid, disagreeing, *cast), {});
        for (std::size_t k = 0; k < disagreeing.size(); ++k) {
            ColorError& error = errors.color[disagreeing[k]];
            for (std::size_t d = k * tie_directions; d < (k + 1) * tie_directions; ++d) {
                const SurfacePoint& p = around.surfaces[check.index()][d];
                const ColorError other =
                    color_error(p.radius > 0 ? p.color : bake::Rgba8{}, pixel(disagreeing[k]));
                // Not `<`: nothing to measure, since both have none, is best.
                if (!(largest(other) >= largest(error))) error = other;
            }
        }
    }
}

} // namespace

double normal_tolerance(ElementFormat format) {
    constexpr double interpolation = 0.05;
    switch (format) {
    case ElementFormat::oct8: return 0.95 + interpolation;
    case ElementFormat::rgb8: return 0.4 + interpolation;
    default: return 0.004 + interpolation;
    }
}

std::vector<TexelErrors> texel_errors(const Part& part, const Reference& reference,
                                      std::uint32_t color_samples, unsigned threads,
                                      const bake::Progress& progress) {
    std::vector<SurfaceCheck> checks;
    for (std::uint32_t layer = 0; layer < part.layers.size(); ++layer) {
        for (const Side side : {Side::outer, Side::inner}) {
            if (!surface_of(part, layer, side).empty()) checks.emplace_back(part, reference, layer, side);
        }
    }
    tbb::task_arena arena(bake::arena_concurrency(threads));
    arena.execute([&] {
        check_shape(checks, reference, progress);
        check_colors(part, checks, reference, color_samples, {});
    });
    std::vector<TexelErrors> result;
    result.reserve(checks.size());
    for (SurfaceCheck& check : checks) result.push_back(std::move(check.errors));
    return result;
}

} // namespace spa::measure
