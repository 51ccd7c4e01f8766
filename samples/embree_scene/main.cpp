// SPDX-License-Identifier: Apache-2.0
// Spherical maps and triangles in one scene of Embree's, with a sun and its shadows, as a PNG:
//
//   embree_scene OUT.png [MAP.spa]
//
// The first part of MAP.spa, or the sample boot, stands twice on a floor of triangles: as it is, and mirrored
// and stretched; between them a torus of triangles. What is worth copying is in main(): how maps get into the
// scene, and how a hit on one is shaded.
#include "../../formats/container/reader.h"
#include "../../libspa/bake/bake.h"
#include "../../libspa/core/error.h"
#include "../../libspa/trace/embree_geometry.h"
#include "../png.h"
#include "../samples.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <memory>
#include <string>

namespace {

using namespace spa; // NOLINT(google-build-using-namespace)

constexpr std::uint32_t width = 800;
constexpr std::uint32_t height = 500;
constexpr unsigned samples_a_side = 3; // rays a pixel: the square

// The part that is shown, and what owns its pixels.
struct Object {
    container::File file;
    bake::OwnedMap baked;
    [[nodiscard]] const Part& part() const {
        return file.map().parts.empty() ? baked.map.parts[0] : file.map().parts[0];
    }
};

Object load(const char* path) {
    Object object;
    if (path == nullptr) {
        object.baked = bake::bake_model(samples::make_sample("boot", 3), {}).map;
        return object;
    }
    const container::Status status = container::open(path, object.file);
    if (!status.ok()) throw Error(container::exit_code(status.issue), container::describe(status, path));
    return object;
}

struct Mesh {
    Model model;
    unsigned id = RTC_INVALID_GEOMETRY_ID;
};

void attach(RTCDevice device, RTCScene scene, Mesh& mesh) {
    const Model& model = mesh.model;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* const vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                   sizeof(Vec3f), model.positions.size());
    void* const indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                  sizeof(Triangle), model.triangles.size());
    std::copy(model.positions.begin(), model.positions.end(), static_cast<Vec3f*>(vertices));
    std::copy(model.triangles.begin(), model.triangles.end(), static_cast<Triangle*>(indices));
    rtcCommitGeometry(geometry);
    mesh.id = rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

// A square of 2 * size at y = 0.
Model floor_of(float size) {
    Model model;
    model.positions = {{-size, 0, -size}, {-size, 0, size}, {size, 0, size}, {size, 0, -size}};
    model.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
    return model;
}

// The sample torus, lying on the floor.
Model torus_at(Vec3f place, float size) {
    Model model = samples::make_sample("torus", 4);
    for (Vec3f& p : model.positions) p = Vec3f{p.x, p.y + 0.4F, p.z} * size + place;
    return model;
}

// The lowest point of the box around a map's surface, in object space.
double lowest(const trace::TraceMap& map, const trace::MapSpace& space) {
    double result = std::numeric_limits<double>::infinity();
    for (unsigned corner = 0; corner < 8; ++corner) {
        const shader::float3 low = map.map().box_low;
        const shader::float3 high = map.map().box_high;
        const Vec3d q{double((corner & 1U) != 0 ? high.x : low.x),
                      double((corner & 2U) != 0 ? high.y : low.y),
                      double((corner & 4U) != 0 ? high.z : low.z)};
        result = std::min(result, to_world(space, q).y);
    }
    return result;
}

struct Surface {
    Vec3f normal;
    Vec3f color;
};

RTCRayHit make_ray(Vec3f origin, Vec3f direction) {
    RTCRayHit ray{};
    ray.ray.org_x = origin.x;
    ray.ray.org_y = origin.y;
    ray.ray.org_z = origin.z;
    ray.ray.dir_x = direction.x;
    ray.ray.dir_y = direction.y;
    ray.ray.dir_z = direction.z;
    ray.ray.tfar = std::numeric_limits<float>::infinity();
    ray.ray.mask = ~0U;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    return ray;
}

// Sunlight, if nothing is in between, and a sky that is brighter above.
Vec3f light(RTCScene scene, Vec3f place, Vec3f normal, float offset) {
    const Vec3f sun = normalize(Vec3f{0.5F, 0.8F, 0.45F});
    const float sky = 0.25F + 0.15F * normal.y;
    Vec3f result{sky * 0.9F, sky, sky * 1.15F};
    const float facing = dot(normal, sun);
    if (facing <= 0) return result;
    // Away from the surface, so that it does not shadow itself.
    RTCRay ray = make_ray(place + normal * offset, sun).ray;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &ray);
    if (ray.tfar >= 0) result = result + Vec3f{1.0F, 0.95F, 0.85F} * (0.85F * facing);
    return result;
}

void write(const Image& image, const char* path) {
    const std::vector<std::byte> png = samples::encode_png(image, path);
    std::ofstream stream(path, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(png.data()), std::streamsize(png.size()));
    if (!stream.flush())
        throw Error(ExitCode::input_output, std::string(path) + ": cannot be written; is the folder there?");
}

void draw(const char* out, const char* map_path) {
    const Object object = load(map_path);
    const Part& part = object.part();

    // The maps: a scene of instances, and that scene as one geometry of Embree's.
    const trace::TraceMap map(part);
    const trace::MapSpace object_space = trace::map_space(part);
    const double r = part.radius * std::cbrt(std::abs(determinant(part.frame)));
    const Vec3d to_floor{-part.center.x, -lowest(map, object_space), -part.center.z};
    trace::Scene maps;
    maps.add(map, part, {{}, to_floor + Vec3d{-1.1 * r, 0, 0}});
    const Mat3 mirrored{{{-0.8, 0, 0}, {0, 1.2, 0}, {0, 0, 0.8}}};
    maps.add(map, part, {mirrored, mirrored * to_floor + Vec3d{1.3 * r, 0, -0.5 * r}});

    const std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device(rtcNewDevice(nullptr),
                                                                           &rtcReleaseDevice);
    if (!device) throw Error(ExitCode::internal, "Embree cannot start");
    const trace::EmbreeGeometry geometry(device.get(), maps);
    // Declared after the geometry, so released before it.
    const std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)> scene(rtcNewScene(device.get()),
                                                                        &rtcReleaseScene);
    const unsigned maps_id = geometry.attach(scene.get());
    const auto size = float(r);
    Mesh floor{floor_of(8 * size)};
    Mesh torus{torus_at({0.15F * size, 0, 0.9F * size}, 0.32F * size)};
    attach(device.get(), scene.get(), floor);
    attach(device.get(), scene.get(), torus);
    rtcCommitScene(scene.get());

    const auto surface_of = [&](const RTCRayHit& ray, Vec3f place) {
        if (ray.hit.geomID == maps_id) {
            const trace::Shade shade = maps.shade(geometry.hit(ray));
            return Surface{shade.normal, shade.color};
        }
        const Vec3f normal = normalize(Vec3f{ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z});
        if (ray.hit.geomID == torus.id) return Surface{normal, {0.55F, 0.12F, 0.1F}};
        const bool odd =
            std::fmod(std::floor(place.x / size * 2) + std::floor(place.z / size * 2), 2.0F) != 0;
        return Surface{normal, odd ? Vec3f{0.45F, 0.45F, 0.43F} : Vec3f{0.62F, 0.62F, 0.6F}};
    };

    const Vec3f eye = Vec3f{0.4F, 1.9F, 4.4F} * size;
    const Vec3f forward = normalize(Vec3f{0.05F, 0.6F, 0} * size - eye);
    const Vec3f right = normalize(cross(forward, Vec3f{0, 1, 0}));
    const Vec3f up = cross(right, forward);
    const auto radiance = [&](double x, double y) {
        const float zoom = 1.0F / float(height);
        const Vec3f direction =
            forward * 2.6F + right * (float(2 * x - width) * zoom) - up * (float(2 * y - height) * zoom);
        RTCRayHit ray = make_ray(eye, direction);
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene.get(), &context, &ray);
        const float above = normalize(direction).y;
        if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID)
            return Vec3f{0.55F - above, 0.7F - 0.7F * above, 0.9F - 0.2F * above};
        const Vec3f place = eye + direction * ray.ray.tfar;
        Surface surface = surface_of(ray, place);
        if (dot(surface.normal, direction) > 0) surface.normal = -surface.normal;
        const Vec3f in = light(scene.get(), place, surface.normal, 4e-3F * size);
        return Vec3f{in.x * surface.color.x, in.y * surface.color.y, in.z * surface.color.z};
    };

    Image image{width, height, {}};
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            Vec3f sum;
            for (unsigned row = 0; row < samples_a_side; ++row)
                for (unsigned column = 0; column < samples_a_side; ++column)
                    sum =
                        sum + radiance(x + (column + 0.5) / samples_a_side, y + (row + 0.5) / samples_a_side);
            sum = sum * (1.0F / (samples_a_side * samples_a_side));
            image.pixels.push_back(
                {linear_to_srgb(sum.x), linear_to_srgb(sum.y), linear_to_srgb(sum.z), std::uint8_t(255)});
        }
    }
    write(image, out);
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 2 && argc != 3) {
        std::fputs("embree_scene OUT.png [MAP.spa]\n", stderr);
        return int(ExitCode::usage);
    }
    try {
        draw(argv[1], argc == 3 ? argv[2] : nullptr);
    } catch (const Error& error) {
        std::fprintf(stderr, "embree_scene: %s\n", error.what());
        return int(error.code());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "embree_scene: %s\n", error.what());
        return int(ExitCode::internal);
    }
    return int(ExitCode::ok);
}
