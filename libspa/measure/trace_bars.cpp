// SPDX-License-Identifier: Apache-2.0
#include "trace_bars.h"

#include <cmath>

namespace spa::measure {
namespace {

constexpr RaySet judged = RaySet::chords;
constexpr unsigned threads = 1;
constexpr std::uint32_t usual_cells = 128;

double mean_distance(const MethodReport& method) {
    const SetErrors* const errors = method.errors_of(judged);
    return errors == nullptr ? 0 : errors->errors.distance.mean;
}

double missed_share(const MethodReport& method) {
    const SetErrors* const errors = method.errors_of(judged);
    if (errors == nullptr || errors->errors.rays() == 0) return 0;
    return double(errors->errors.band.missed) / double(errors->errors.rays());
}

std::optional<double> fastest_ns(const MethodReport* method, unsigned thread_count) {
    if (method == nullptr) return {};
    const TraceTiming* const timing = method->fastest(judged, thread_count);
    if (timing == nullptr) return {};
    return timing->ns.median;
}

std::optional<double> ns(const MethodReport& method, CallKind kind) {
    const TraceTiming* const timing = method.timing(judged, threads, kind);
    if (timing == nullptr) return {};
    return timing->ns.median;
}

// a at 0, b at 1, in logarithms.
double between(double a, double b, double at) {
    if (!(a > 0) || !(b > 0)) return a + (b - a) * at;
    return std::exp(std::log(a) + (std::log(b) - std::log(a)) * at);
}

class Judge {
public:
    Judge(const std::string& model, const TraceBenchmark& benchmark)
        : model_(model), benchmark_(benchmark), mesh_(fastest_ns(benchmark.find("mesh"), threads)) {
        for (const MethodReport& method : benchmark.methods)
            if (method.family == Family::projective) maps_.push_back(&method);
    }

    std::vector<Bar> judge() {
        const bool boot = model_.starts_with("boot"), smooth = model_.starts_with("smooth");
        const bool large = benchmark_.vertices >= 1000000;
        for (const MethodReport* const map : maps_) {
            if (map->cells != usual_cells) continue;
            if ((boot || smooth) && large) {
                against_mesh(*map, "stream against the mesh", CallKind::stream, 10);
                against_mesh(*map, "single ray against the mesh", CallKind::single, 2);
                against_lod(*map, smooth ? 3 : 1.5, smooth);
                first_ray(*map);
            }
            if (smooth) add("mean distance", *map, mean_distance(*map), 6e-4, false, "R");
        }
        if (boot || smooth) against_fan();
        interior();
        if (boot) layers();
        return std::move(bars_);
    }

private:
    Bar& add(const char* name, const MethodReport& map, double value, double limit, bool at_least,
             const char* unit) {
        Bar bar{name, model_, map.name, value, limit, at_least, unit, missed_share(map), {}};
        bars_.push_back(std::move(bar));
        return bars_.back();
    }

    void against_mesh(const MethodReport& map, const char* name, CallKind kind, double limit) {
        const std::optional<double> ours = ns(map, kind);
        if (mesh_ && ours) add(name, map, *mesh_ / *ours, limit, true, "times");
    }

    void against_lod(const MethodReport& map, double limit, bool bytes_too) {
        const std::optional<double> ours = ns(map, CallKind::stream);
        const auto lod = equal_lod(benchmark_, mean_distance(map), threads);
        if (!ours || !lod) return;
        add("stream against the equal LOD", map, lod->ns / *ours, limit, true, "times").rival_missed =
            lod->missed;
        if (bytes_too)
            add("bytes against the equal LOD", map, lod->bytes / double(map.bytes), 20, true, "times")
                .rival_missed = lod->missed;
    }

    void first_ray(const MethodReport& map) {
        const MethodReport* const mesh = benchmark_.find("mesh");
        if (!map.file || mesh == nullptr || !mesh->build_seconds) return;
        add("first ray against the build", map, *mesh->build_seconds / map.file->first_ray.median, 50, true,
            "times");
    }

    // The worst of all sizes.
    void against_fan() {
        const MethodReport* const fan = benchmark_.find("fan 10");
        const std::optional<double> rival = fastest_ns(fan, threads);
        if (!rival) return;
        const MethodReport* slowest = nullptr;
        const MethodReport* least_exact = nullptr;
        double speed = 0, exactness = 0;
        for (const MethodReport* const map : maps_) {
            const std::optional<double> ours = fastest_ns(map, threads);
            if (!ours || !(mean_distance(*map) > 0)) continue;
            if (slowest == nullptr || *rival / *ours < speed) {
                slowest = map;
                speed = *rival / *ours;
            }
            const double times = mean_distance(*fan) / mean_distance(*map);
            if (least_exact == nullptr || times < exactness) {
                least_exact = map;
                exactness = times;
            }
        }
        if (slowest == nullptr) return;
        add("speed against the fan of 10", *slowest, speed, 1, true, "times").rival_missed =
            missed_share(*fan);
        add("exactness against the fan of 10", *least_exact, exactness, 40, true, "times").rival_missed =
            missed_share(*fan);
    }

    void interior() {
        const MethodReport* worst = nullptr;
        std::uint64_t most = 0;
        for (const MethodReport* const map : maps_) {
            const SetErrors* const errors = map->errors_of(judged);
            if (errors == nullptr) continue;
            if (worst != nullptr && errors->errors.interior.missed <= most) continue;
            worst = map;
            most = errors->errors.interior.missed;
        }
        if (worst != nullptr) add("missed in the interior", *worst, double(most), 0, false, "rays");
    }

    void layers() {
        const MethodReport* worst = nullptr;
        double most = 0;
        for (const MethodReport* const two : maps_) {
            if (two->layers != 2) continue;
            const auto cost = ns(*two, CallKind::stream);
            const MethodReport* const one =
                benchmark_.find("projective " + std::to_string(two->cells) + "x1");
            const auto base = one == nullptr ? std::nullopt : ns(*one, CallKind::stream);
            if (!cost || !base || *cost / *base <= most) continue;
            worst = two;
            most = *cost / *base;
        }
        if (worst != nullptr) add("cost of the second layer", *worst, most, 1.4, false, "times");
    }

    const std::string& model_;
    const TraceBenchmark& benchmark_;
    std::optional<double> mesh_; // ns of the model's own triangles
    std::vector<const MethodReport*> maps_;
    std::vector<Bar> bars_;
};

} // namespace

std::optional<EqualLod> equal_lod(const TraceBenchmark& benchmark, double mean, unsigned thread_count) {
    const MethodReport* coarse = nullptr;
    for (const MethodReport& fine : benchmark.methods) {
        if (fine.family != Family::lod || !fastest_ns(&fine, thread_count)) continue;
        const double to = mean_distance(fine);
        if (coarse == nullptr && to <= mean) coarse = &fine;
        if (coarse != nullptr && to <= mean) {
            const double from = mean_distance(*coarse);
            const double at = from > mean && to > 0 ? std::log(from / mean) / std::log(from / to) : 0;
            return EqualLod{between(*fastest_ns(coarse, thread_count), *fastest_ns(&fine, thread_count), at),
                            between(double(coarse->bytes), double(fine.bytes), at),
                            between(missed_share(*coarse), missed_share(fine), at)};
        }
        coarse = &fine;
    }
    const MethodReport* const mesh = benchmark.find("mesh");
    const std::optional<double> ns = fastest_ns(mesh, thread_count);
    if (coarse == nullptr || !ns) return {};
    return EqualLod{*ns, double(mesh->bytes), missed_share(*mesh)};
}

std::vector<Bar> trace_bars(const std::string& model, const TraceBenchmark& benchmark) {
    return Judge(model, benchmark).judge();
}

} // namespace spa::measure
