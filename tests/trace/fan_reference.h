// SPDX-License-Identifier: Apache-2.0
// The paper's intersection as its text has it, in double precision and with the core's direction maps:
// written without looking at shaders/spa_fan.h, of which it shares the names of the options alone.
#pragma once

#include "trace_image.h"

#include "../../libspa/trace/ray.h"
#include "../../shaders/spa_fan.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace spa::test {

struct FanAnswer {
    bool hit = false;
    bool front = true;
    double t = 0;
    Vec3d shading;       // the test ray that says where on the map
    bool certain = true; // false: so close to a border of texels or to a surface that roundings decide
};

class FanReference {
public:
    FanReference(const TraceImage& image, const shader::SpaFan& options) : image_(image), options_(options) {}

    FanAnswer operator()(const trace::Ray& ray, std::uint32_t flags) {
        answer_ = {};
        origin_ = to_double(ray.origin);
        direction_ = to_double(ray.direction);
        const double dd = dot(direction_, direction_);
        const double closest = -dot(origin_, direction_) / dd;
        foot_ = at(closest);
        distance_ = length(foot_);
        doubt(distance_ - 1, 1e-5);
        if (distance_ >= 1) return answer_;
        const double half = std::sqrt((1 - distance_ * distance_) / dd);
        const double enter = closest - half;
        const double leave = closest + half;
        const double t_min = double(ray.t_min);
        const double t_max = double(ray.t_max);
        doubt((leave - t_min) / half, 1e-4);
        doubt((enter - t_max) / half, 1e-4);
        doubt((leave - t_max) / half, 1e-4);
        doubt((enter - t_min) / half, 1e-4);
        if (leave <= t_min || enter >= t_max) return answer_;
        begin_ = std::max(enter, t_min);

        std::vector<double> times;
        for (const double t : test_times(closest, half)) {
            doubt((t - t_min) / half, 1e-4);
            doubt((t - t_max) / half, 1e-4);
            if (t >= t_min && t <= t_max) times.push_back(t);
        }
        const bool front_wanted = (flags & trace::cull_front) == 0;
        const bool back_wanted = (flags & trace::cull_back) == 0;
        if (options_.count == 0) {
            if (enter >= t_min && front_wanted) return found(enter, true);
            if (leave <= t_max && back_wanted) return found(leave, false);
            return answer_;
        }
        if (options_.pick == SPA_FAN_MIDDLE) {
            if (!front_wanted) return answer_;
            // Outwards from the middle; of two equally far ones the later one first.
            std::stable_sort(times.begin(), times.end(), [&](double a, double b) {
                const double from_a = std::abs(a - middle_);
                const double from_b = std::abs(b - middle_);
                return std::abs(from_a - from_b) > 1e-9 * half ? from_a < from_b : a > b;
            });
            for (const double t : times)
                if (inside(t)) return found(t, true);
            return answer_;
        }
        const bool starts_inside = enter < t_min && inside(t_min);
        const bool leaves_first = options_.start == SPA_FAN_START_LEAVES || !front_wanted;
        bool solid = starts_inside && leaves_first;
        for (const double t : times) {
            const bool now = inside(t);
            if (now && !solid && front_wanted) return found(t, true);
            if (!now && solid && back_wanted) return found(t, false);
            solid = now;
        }
        if (solid && back_wanted && leave <= t_max) return found(leave, false);
        return answer_;
    }

private:
    [[nodiscard]] Vec3d at(double t) const { return origin_ + direction_ * t; }

    void doubt(double difference, double margin) {
        if (std::abs(difference) < margin) answer_.certain = false;
    }

    std::vector<double> test_times(double closest, double half) {
        unsigned n = options_.count;
        if (options_.count_rule == SPA_FAN_BY_DISTANCE && n > 0) {
            const double exact = (n - 1) * (1 - distance_);
            doubt(exact - std::floor(exact) - 0.5, 1e-4);
            n = unsigned(1 + std::lround(exact));
        }
        std::vector<double> times;
        const double widest = std::acos(distance_);
        const double speed = length(direction_);
        for (unsigned i = 0; i < n; ++i) {
            double share = (i + 1.0) / (n + 1.0);
            if (options_.ends == SPA_FAN_WITH_ENDS) share = n == 1 ? 0.5 : i / (n - 1.0);
            if (options_.ends == SPA_FAN_HALF_ENDS) share = (i + 0.5) / n;
            if (options_.spacing == SPA_FAN_EVEN_T)
                times.push_back(closest + half * (2 * share - 1));
            else
                times.push_back(closest + distance_ * std::tan(widest * (2 * share - 1)) / speed);
        }
        // The middle of an even number of test points has one more behind it than before it.
        middle_ = n > 0 ? times[(n - 1) / 2] : closest;
        return times;
    }

    double depth(Vec3d u) {
        const Grid& grid = image_.grid();
        const Vec2d position = position_of(grid, u);
        if (options_.filtering == SPA_FAN_NEAREST) {
            doubt(position.x - std::floor(position.x) - 0.5, 1e-3);
            doubt(position.y - std::floor(position.y) - 0.5, 1e-3);
            return image_.depth(wrap(grid, std::lround(position.x), std::lround(position.y)));
        }
        const double x = std::floor(position.x);
        const double y = std::floor(position.y);
        double sum = 0;
        double weights = 0;
        for (int dy = 0; dy < 2; ++dy) {
            for (int dx = 0; dx < 2; ++dx) {
                const double stored = image_.depth(wrap(grid, std::int64_t(x) + dx, std::int64_t(y) + dy));
                const double weight =
                    (1 - std::abs(position.x - x - dx)) * (1 - std::abs(position.y - y - dy));
                sum += stored * weight;
                weights += stored > 0 ? weight : 0;
            }
        }
        doubt(weights - 0.5, 1e-3);
        return weights < 0.5 ? 0 : sum / weights;
    }

    bool inside(double t) {
        const Vec3d x = at(t);
        double r = depth(x);
        if (r == 0) {
            if (options_.empty == SPA_FAN_EMPTY_MISSES) return false;
            r = 1;
        }
        doubt(length(x) - r, 1e-4);
        return length(x) <= r;
    }

    FanAnswer found(double t, bool front) {
        answer_.hit = true;
        answer_.front = front;
        answer_.t = options_.report == SPA_FAN_T_SPHERE && front ? begin_ : t;
        answer_.shading = at(t);
        if (options_.shading == SPA_FAN_SHADE_FOOT) answer_.shading = foot_;
        if (options_.shading == SPA_FAN_SHADE_SPHERE) answer_.shading = at(begin_);
        return answer_;
    }

    const TraceImage& image_;
    shader::SpaFan options_;
    FanAnswer answer_;
    Vec3d origin_, direction_, foot_;
    double distance_ = 0, begin_ = 0, middle_ = 0;
};

} // namespace spa::test
