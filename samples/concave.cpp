// SPDX-License-Identifier: Apache-2.0
#include "shapes.h"

#include <utility>

namespace spa::samples {
namespace {

struct ProfilePoint {
    double radius, height;
    Vec4f color;
};

// From the lowest point of the bowl's outside over its rim, down to its floor, over the ring wall, up the
// stem and over the ball. Front faces lie to the right of the way.
std::vector<ProfilePoint> control_profile() {
    const Vec4f bowl = srgb(40, 130, 140), inside = srgb(235, 225, 200), wall = srgb(240, 170, 40),
                ball = srgb(205, 50, 50);
    return {{0, -0.80, bowl},     {0.45, -0.80, bowl},   {0.82, -0.52, bowl},   {0.98, 0.00, bowl},
            {0.96, 0.42, bowl},   {0.95, 0.52, bowl},    {0.86, 0.52, inside},  {0.86, 0.42, inside},
            {0.87, 0.00, inside}, {0.78, -0.38, inside}, {0.68, -0.42, inside}, {0.66, -0.30, wall},
            {0.66, 0.15, wall},   {0.66, 0.24, wall},    {0.57, 0.24, wall},    {0.57, 0.15, wall},
            {0.57, -0.42, wall},  {0.40, -0.64, inside}, {0.14, -0.66, inside}, {0.09, -0.55, ball},
            {0.09, -0.28, ball},  {0.30, -0.22, ball},   {0.43, 0.05, ball},    {0.34, 0.32, ball},
            {0.16, 0.42, ball},   {0, 0.42, ball}};
}

ProfilePoint mix(const ProfilePoint& a, const ProfilePoint& b, double t) {
    const auto s = static_cast<float>(t);
    const auto channel = [s](float x, float y) { return x + (y - x) * s; };
    return {a.radius + (b.radius - a.radius) * t,
            a.height + (b.height - a.height) * t,
            {channel(a.color.x, b.color.x), channel(a.color.y, b.color.y), channel(a.color.z, b.color.z), 1}};
}

// Corner cutting (Chaikin 1974), which keeps the ends: they lie on the axis.
std::vector<ProfilePoint> cut_corners(const std::vector<ProfilePoint>& profile) {
    std::vector<ProfilePoint> finer{profile.front()};
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
        if (i > 0) finer.push_back(mix(profile[i], profile[i + 1], 0.25));
        if (i + 2 < profile.size()) finer.push_back(mix(profile[i], profile[i + 1], 0.75));
    }
    finer.push_back(profile.back());
    return finer;
}

} // namespace

Model make_concave(int level) {
    std::vector<ProfilePoint> profile = control_profile();
    for (int i = 0; i < level; ++i) profile = cut_corners(profile);
    Model model = empty_model("rings");
    const std::uint32_t columns = 12U << level;
    std::vector<std::uint32_t> below;
    for (const ProfilePoint& point : profile) {
        std::vector<std::uint32_t> ring = add_ring(model, point.radius, point.height, columns, point.color);
        if (!below.empty()) join_rings(model, ring, below);
        below = std::move(ring);
    }
    set_smooth_normals(model);
    return model;
}

} // namespace spa::samples
