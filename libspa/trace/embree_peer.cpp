// SPDX-License-Identifier: Apache-2.0
#include "embree_peer.h"

#include "embree_handles.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <vector>

#if defined(__SSE3__) || defined(__x86_64__)
#include <pmmintrin.h>
#endif

namespace spa::trace {
namespace {

// Embree's manual asks for both modes; they are left as they were.
class FlushDenormals {
public:
#if defined(__SSE3__) || defined(__x86_64__)
    FlushDenormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | flush_to_zero | denormals_are_zero); }
    ~FlushDenormals() { _mm_setcsr(before_); }
#else
    FlushDenormals() = default;
#endif
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
    static constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x40;
    unsigned before_ = 0;
};

// Which lane of which packet a ray is.
template <class Packet>
constexpr std::size_t lanes = sizeof(Packet::ray.org_x) / sizeof(float);
template <>
constexpr std::size_t lanes<RTCRayHit> = 1;

float& lane(float& value, std::size_t) { return value; }
unsigned& lane(unsigned& value, std::size_t) { return value; }
template <class T, std::size_t N>
T& lane(T (&values)[N], std::size_t i) {
    return values[i];
}

template <class Packet>
void set_ray(Packet& packet, std::size_t i, const Ray& ray) {
    lane(packet.ray.org_x, i) = ray.origin.x;
    lane(packet.ray.org_y, i) = ray.origin.y;
    lane(packet.ray.org_z, i) = ray.origin.z;
    lane(packet.ray.tnear, i) = ray.t_min;
    lane(packet.ray.dir_x, i) = ray.direction.x;
    lane(packet.ray.dir_y, i) = ray.direction.y;
    lane(packet.ray.dir_z, i) = ray.direction.z;
    lane(packet.ray.time, i) = 0;
    lane(packet.ray.tfar, i) = ray.t_max;
    lane(packet.ray.mask, i) = ~0U;
    lane(packet.ray.id, i) = 0;
    lane(packet.ray.flags, i) = 0;
    lane(packet.hit.geomID, i) = RTC_INVALID_GEOMETRY_ID;
    lane(packet.hit.instID[0], i) = RTC_INVALID_GEOMETRY_ID;
}

// Lanes beyond the last ray: t_near > t_far, which Embree takes as inactive.
template <class Packet>
void fill(std::vector<Packet>& packets, std::span<const Ray> rays) {
    constexpr std::size_t n = lanes<Packet>;
    packets.resize((rays.size() + n - 1) / n);
    for (std::size_t i = 0; i < packets.size() * n; ++i) {
        if (i < rays.size())
            set_ray(packets[i / n], i % n, rays[i]);
        else
            set_ray(packets[i / n], i % n, {{0, 0, 0}, 1, {0, 0, 1}, -1});
    }
}

template <class Packet>
Hit hit_of(std::vector<Packet>& packets, std::size_t ray) {
    constexpr std::size_t n = lanes<Packet>;
    Packet& packet = packets[ray / n];
    const std::size_t i = ray % n;
    Hit hit;
    if (lane(packet.hit.geomID, i) == RTC_INVALID_GEOMETRY_ID) return hit;
    hit.t = lane(packet.ray.tfar, i);
    hit.normal =
        normalize(Vec3f{lane(packet.hit.Ng_x, i), lane(packet.hit.Ng_y, i), lane(packet.hit.Ng_z, i)});
    const Vec3f direction{lane(packet.ray.dir_x, i), lane(packet.ray.dir_y, i), lane(packet.ray.dir_z, i)};
    hit.front = dot(hit.normal, direction) < 0;
    return hit;
}

template <class Packet>
std::uint32_t triangle_of(std::vector<Packet>& packets, std::size_t ray) {
    constexpr std::size_t n = lanes<Packet>;
    return lane(packets[ray / n].hit.primID, ray % n);
}

template <class Packet>
Vec2f barycentric_of(std::vector<Packet>& packets, std::size_t ray) {
    constexpr std::size_t n = lanes<Packet>;
    Packet& packet = packets[ray / n];
    return {lane(packet.hit.u, ray % n), lane(packet.hit.v, ray % n)};
}

template <class Packet>
bool is_blocked(std::vector<Packet>& packets, std::size_t ray) {
    constexpr std::size_t n = lanes<Packet>;
    return lane(packets[ray / n].ray.tfar, ray % n) < 0;
}

bool count_bytes(void* counter, ssize_t bytes, bool) {
    *static_cast<std::atomic<std::int64_t>*>(counter) += bytes;
    return true;
}

RTCIntersectContext make_context(EmbreeCall call) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (call == EmbreeCall::stream_coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
}

alignas(64) constexpr std::array<int, 16> all_valid{-1, -1, -1, -1, -1, -1, -1, -1,
                                                    -1, -1, -1, -1, -1, -1, -1, -1};

} // namespace

std::span<const EmbreeCall> embree_calls() {
    static constexpr std::array calls{EmbreeCall::single,          EmbreeCall::packet8,
                                      EmbreeCall::packet16,        EmbreeCall::stream,
                                      EmbreeCall::stream_coherent, EmbreeCall::stream_packets};
    return calls;
}

const char* name(EmbreeCall call) {
    switch (call) {
    case EmbreeCall::single: return "rtcIntersect1";
    case EmbreeCall::packet8: return "rtcIntersect8";
    case EmbreeCall::packet16: return "rtcIntersect16";
    case EmbreeCall::stream: return "rtcIntersect1M";
    case EmbreeCall::stream_coherent: return "rtcIntersect1M coherent";
    case EmbreeCall::stream_packets: break;
    }
    return "rtcIntersectNM";
}

bool is_native(EmbreeCall call) {
    const DeviceOwner device(rtcNewDevice(nullptr));
    if (!device) return false;
    switch (call) {
    case EmbreeCall::single: return true;
    case EmbreeCall::packet8:
        return rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0;
    case EmbreeCall::packet16:
        return rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
    default: return rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_RAY_STREAM_SUPPORTED) != 0;
    }
}

// One of the three is in use.
struct EmbreeRays::State {
    std::vector<RTCRayHit> ones;
    std::vector<RTCRayHit8> eights;
    std::vector<RTCRayHit16> sixteens;

    // Calls what(packets) with those of `call`.
    template <class What>
    auto with(EmbreeCall call, What&& what) {
        switch (call) {
        case EmbreeCall::packet8: return what(eights);
        case EmbreeCall::packet16:
        case EmbreeCall::stream_packets: return what(sixteens);
        default: return what(ones);
        }
    }
};

EmbreeRays::EmbreeRays(EmbreeCall call, std::span<const Ray> rays)
    : call_(call), state_(std::make_unique<State>()) {
    reset(rays);
}
EmbreeRays::~EmbreeRays() = default;
EmbreeRays::EmbreeRays(EmbreeRays&&) noexcept = default;
EmbreeRays& EmbreeRays::operator=(EmbreeRays&&) noexcept = default;

void EmbreeRays::reset(std::span<const Ray> rays) {
    state_->with(call_, [&](auto& packets) { fill(packets, rays); });
}
Hit EmbreeRays::hit(std::size_t ray) const {
    return state_->with(call_, [&](auto& packets) { return hit_of(packets, ray); });
}
bool EmbreeRays::blocked(std::size_t ray) const {
    return state_->with(call_, [&](auto& packets) { return is_blocked(packets, ray); });
}
std::uint32_t EmbreeRays::triangle(std::size_t ray) const {
    return state_->with(call_, [&](auto& packets) { return triangle_of(packets, ray); });
}
Vec2f EmbreeRays::barycentric(std::size_t ray) const {
    return state_->with(call_, [&](auto& packets) { return barycentric_of(packets, ray); });
}

struct EmbreePeer::State {
    std::atomic<std::int64_t> bytes{0}; // outlives the device, which counts in it
    DeviceOwner device;
    SceneOwner scene;
};

EmbreePeer::EmbreePeer(std::span<const Vec3f> positions, std::span<const Triangle> triangles)
    : state_(std::make_unique<State>()) {
    State& s = *state_;
    s.device.reset(rtcNewDevice(nullptr));
    if (!s.device) check(nullptr);
    rtcSetDeviceMemoryMonitorFunction(s.device.get(), count_bytes, &s.bytes);
    s.scene.reset(rtcNewScene(s.device.get()));
    attach_triangles(s.device.get(), s.scene.get(), positions, triangles);
}
void EmbreePeer::build() {
    rtcJoinCommitScene(state_->scene.get());
    check(state_->device.get());
}
EmbreePeer::~EmbreePeer() = default;
EmbreePeer::EmbreePeer(EmbreePeer&&) noexcept = default;
EmbreePeer& EmbreePeer::operator=(EmbreePeer&&) noexcept = default;

std::uint64_t EmbreePeer::bytes() const { return std::uint64_t(std::max<std::int64_t>(state_->bytes, 0)); }

void EmbreePeer::closest_hits(EmbreeRays& rays, std::size_t begin, std::size_t end) const {
    const FlushDenormals modes;
    RTCScene scene = state_->scene.get();
    RTCIntersectContext context = make_context(rays.call_);
    EmbreeRays::State& r = *rays.state_;
    const auto packets = [&](std::size_t n) { return (end - begin + n - 1) / n; };
    switch (rays.call_) {
    case EmbreeCall::single:
        for (std::size_t i = begin; i < end; ++i) rtcIntersect1(scene, &context, &r.ones[i]);
        break;
    case EmbreeCall::packet8:
        for (std::size_t i = 0; i < packets(8); ++i)
            rtcIntersect8(all_valid.data(), scene, &context, &r.eights[begin / 8 + i]);
        break;
    case EmbreeCall::packet16:
        for (std::size_t i = 0; i < packets(16); ++i)
            rtcIntersect16(all_valid.data(), scene, &context, &r.sixteens[begin / 16 + i]);
        break;
    case EmbreeCall::stream:
    case EmbreeCall::stream_coherent:
        rtcIntersect1M(scene, &context, &r.ones[begin], unsigned(end - begin), sizeof(RTCRayHit));
        break;
    case EmbreeCall::stream_packets:
        rtcIntersectNM(scene, &context, reinterpret_cast<RTCRayHitN*>(&r.sixteens[begin / 16]), 16,
                       unsigned(packets(16)), sizeof(RTCRayHit16));
        break;
    }
}

void EmbreePeer::occluded(EmbreeRays& rays, std::size_t begin, std::size_t end) const {
    const FlushDenormals modes;
    RTCScene scene = state_->scene.get();
    RTCIntersectContext context = make_context(rays.call_);
    EmbreeRays::State& r = *rays.state_;
    const auto packets = [&](std::size_t n) { return (end - begin + n - 1) / n; };
    switch (rays.call_) {
    case EmbreeCall::single:
        for (std::size_t i = begin; i < end; ++i) rtcOccluded1(scene, &context, &r.ones[i].ray);
        break;
    case EmbreeCall::packet8:
        for (std::size_t i = 0; i < packets(8); ++i)
            rtcOccluded8(all_valid.data(), scene, &context, &r.eights[begin / 8 + i].ray);
        break;
    case EmbreeCall::packet16:
        for (std::size_t i = 0; i < packets(16); ++i)
            rtcOccluded16(all_valid.data(), scene, &context, &r.sixteens[begin / 16 + i].ray);
        break;
    case EmbreeCall::stream:
    case EmbreeCall::stream_coherent:
        rtcOccluded1M(scene, &context, &r.ones[begin].ray, unsigned(end - begin), sizeof(RTCRayHit));
        break;
    case EmbreeCall::stream_packets:
        rtcOccludedNM(scene, &context, reinterpret_cast<RTCRayN*>(&r.sixteens[begin / 16].ray), 16,
                      unsigned(packets(16)), sizeof(RTCRayHit16));
        break;
    }
}

} // namespace spa::trace
