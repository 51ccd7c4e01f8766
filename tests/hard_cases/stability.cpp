// SPDX-License-Identifier: Apache-2.0
// stability: how far single precision moves hits, as CSV: |dt| in units of R against the distance of the
// origin, the size of the part, and the elongation of an instance. The judge, in double precision, is the
// truth, for the very ray that the tracer gets.
//   stability >stability.csv && gnuplot -e "csv='stability.csv'; png='stability.png'" stability.gp
#include "judge.h"
#include "maps.h"

#include "../../libspa/trace/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

namespace {

using namespace spa;
using namespace spa::test;

constexpr int rays = 20000;
constexpr float unlimited = std::numeric_limits<float>::infinity();

OwnedPart bumpy() {
    return make_part({.cells = 32}, [](Vec3d g) {
        const Vec3d u = normalize(g);
        const double r = 0.7 + 0.2 * std::sin(5 * u.x + 1) * std::cos(4 * u.y - 2) * std::sin(3 * u.z + 0.5);
        return std::vector<MadeInterval>{{r, 0, u, {}}};
    });
}

Vec3d random_direction(std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    const double x = normal(random);
    const double y = normal(random);
    return normalize(Vec3d{x, y, normal(random)});
}

// One line: rays from `distance` (in units of R, in the map's space) at the inside of the solid.
void measure(const char* what, double value, const Part& part, const trace::TraceMap& map, const Judge& judge,
             const Affine& place, double distance) {
    trace::Scene scene;
    scene.add(map, part, place);
    const trace::MapSpace space = scene.space(0);
    std::mt19937_64 random(1);
    std::vector<double> errors;
    int differ = 0;
    for (int i = 0; i < rays; ++i) {
        const Vec3d from = random_direction(random) * distance;
        const Vec3d target = random_direction(random) * 0.4;
        const Vec3d origin = to_world(space, from);
        const trace::Ray ray{to_float(origin), 0, to_float(to_world(space, target) - origin), unlimited};
        // The same ray, exactly.
        const RayD exact{space.to_map * (to_double(ray.origin) - space.origin),
                         space.to_map * to_double(ray.direction), 0, 1e30};
        const auto truth = judge.first(exact);
        trace::Hit hit;
        if (scene.closest_hit(ray, 0, hit) && truth.has_value())
            errors.push_back(std::abs(double(hit.t) - truth->t) * length(exact.direction));
        else
            differ += hit.valid() != truth.has_value() ? 1 : 0;
    }
    if (errors.empty()) return;
    std::sort(errors.begin(), errors.end());
    std::printf("%s,%g,%.3g,%.3g,%.3g,%zu,%d\n", what, value, errors[errors.size() / 2],
                errors[errors.size() * 99 / 100], errors.back(), errors.size(), differ);
}

} // namespace

int main() {
    const OwnedPart owned = bumpy();
    const trace::TraceMap map(owned.part);
    const Judge judge(owned.part);
    std::printf("what,value,median,p99,max,rays,one_misses\n");
    for (int step = 0; step <= 12; ++step) {
        const double distance = std::pow(10.0, 0.5 * step);
        measure("origin", distance, owned.part, map, judge, {}, distance);
    }
    for (int step = -6; step <= 6; ++step) {
        Part part = owned.part;
        part.radius = std::pow(10.0, step);
        measure("radius", part.radius, part, map, judge, {}, 3);
    }
    // Stretched along x; and along no axis of the world.
    for (const bool turned : {false, true}) {
        const Vec3d x = turned ? normalize(Vec3d{1, 2, -1}) : Vec3d{1, 0, 0};
        const Vec3d y = turned ? normalize(cross(x, Vec3d{0.3, -0.5, 0.8})) : Vec3d{0, 1, 0};
        for (int step = 0; step <= 6; ++step) {
            const double elongation = std::pow(10.0, 0.5 * step);
            Affine place;
            place.linear = transpose(Mat3{{x * elongation, y, cross(x, y)}});
            measure(turned ? "turned elongation" : "elongation", elongation, owned.part, map, judge, place,
                    3);
        }
    }
    return 0;
}
