// SPDX-License-Identifier: Apache-2.0
// A program of somebody else that traces: includes every installed header of the tracers and of the tracing
// text, makes a map of a ball and shoots rays at it, one and many, through a scene and through the text.
#include <libspa/trace/fan.h>
#include <libspa/trace/march.h>
#include <libspa/trace/ray.h>
#include <libspa/trace/scene.h>
#include <libspa/trace/shade.h>
#include <libspa/trace/space.h>
#include <libspa/trace/trace.h>
#include <libspa/trace/trace_map.h>
#include <shaders/spa_trace.h>

#include <cmath>
#include <cstdio>
#include <vector>

namespace {

int fail(const char* what) {
    std::fprintf(stderr, "tracer: %s\n", what);
    return 1;
}

} // namespace

int main() {
    const spa::Grid grid{spa::Mapping::octahedral, 33, 33};
    const std::size_t samples = std::size_t(grid.width) * grid.height;
    const std::vector<std::byte> depth(samples, std::byte(255));
    const std::vector<std::byte> color(samples * 4, std::byte(255));
    spa::Layer layer;
    layer.outer.depth = {depth, grid.width, grid.height, spa::ElementFormat::u8};
    layer.outer.color = {color, grid.width, grid.height, spa::ElementFormat::rgba8};
    spa::Part part;
    part.radius = 2;
    part.center = {5, 0, 0};
    part.layers = {layer};

    const spa::trace::TraceMap map(part);
    const spa::trace::Ray ray{{0.01F, 0.02F, 3}, 0, {0, 0, -1}};
    spa::trace::Hit hit;
    if (!spa::trace::closest_hit(map, ray, spa::trace::no_flags, hit)) return fail("the map is missed");
    if (std::abs(hit.t - 2) > 0.01F || hit.normal.z < 0.9F) return fail("the hit is not on the ball");
    if (spa::trace::shade(map, hit).color.x < 0.99F) return fail("the ball is not white");
    if (!spa::trace::fan_hit(map, ray, spa::shader::spa_fan_defaults(), 0, hit))
        return fail("the fan misses");
    if (!spa::trace::march_hit(map, ray, spa::shader::spa_march_defaults(), 0, hit))
        return fail("the march misses");

    spa::trace::Scene scene;
    scene.add(map, part);
    std::vector<spa::trace::Ray> rays(100, spa::trace::Ray{{5.01F, 0.02F, 6}, 0, {0, 0, -1}});
    std::vector<spa::trace::Hit> hits(rays.size());
    scene.closest_hits(rays, spa::trace::no_flags, hits);
    for (const spa::trace::Hit& one : hits)
        if (!one.valid() || std::abs(one.t - 4) > 0.02F) return fail("the instance is not hit");
    std::printf("%zu rays hit, by %s\n", hits.size(), spa::trace::stream_target());
    return 0;
}
