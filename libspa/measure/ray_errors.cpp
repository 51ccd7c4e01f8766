// SPDX-License-Identifier: Apache-2.0
#include "ray_errors.h"

#include "angle.h"

#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

namespace spa::measure {
namespace {

void count(Confusion& confusion, bool truth, bool answer) {
    if (truth)
        ++(answer ? confusion.both : confusion.missed);
    else
        ++(answer ? confusion.extra : confusion.neither);
}

double color_difference(const std::array<std::uint8_t, 4>& a, const std::array<std::uint8_t, 4>& b) {
    int sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += std::abs(int(a[i]) - int(b[i]));
    return sum / 3.0;
}

bool is_known(Vec3f normal) { return is_finite(normal) && !(normal == Vec3f{}); }

} // namespace

RayErrors compare_answers(std::span<const trace::Ray> rays, std::span<const RayAnswer> truth,
                          std::span<const RayAnswer> answers, std::span<const std::uint8_t> in_band) {
    RayErrors errors;
    std::vector<double> distances, interior_distances, angles, colors;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const RayAnswer& expected = truth[i];
        const RayAnswer& answer = answers[i];
        const bool band = !in_band.empty() && in_band[i] != 0;
        count(band ? errors.band : errors.interior, expected.hits(), answer.hits());
        if (!expected.hits() || !answer.hits()) continue;
        const double dt =
            std::abs(double(answer.t) - double(expected.t)) * length(to_double(rays[i].direction));
        distances.push_back(dt);
        if (!band) interior_distances.push_back(dt);
        if (is_known(expected.normal) && is_known(answer.normal))
            angles.push_back(angle_degrees(to_double(expected.normal), to_double(answer.normal)));
        if (expected.color[3] != 0 && answer.color[3] != 0)
            colors.push_back(color_difference(expected.color, answer.color));
    }
    errors.distance = distribution(std::move(distances));
    errors.interior_distance = distribution(std::move(interior_distances));
    errors.normal = distribution(std::move(angles));
    errors.color = distribution(std::move(colors));
    return errors;
}

RayErrors compare_occlusion(std::span<const RayAnswer> truth, std::span<const std::uint8_t> blocked,
                            std::span<const std::uint8_t> in_band) {
    RayErrors errors;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const bool band = !in_band.empty() && in_band[i] != 0;
        count(band ? errors.band : errors.interior, truth[i].hits(), blocked[i] != 0);
    }
    return errors;
}

} // namespace spa::measure
