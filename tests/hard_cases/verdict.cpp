// SPDX-License-Identifier: Apache-2.0
#include "verdict.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace spa::test {
namespace {

constexpr double step = 1e-5;    // how far rays are moved, in units of R
constexpr double grazing = 0.01; // sine of the angle between a ray and a plane that it all but runs in

bool valid(const trace::Ray& ray, const trace::Hit& hit) {
    if (!hit.valid()) return hit.t == std::numeric_limits<float>::infinity();
    const double len = double(length(hit.normal));
    return std::isfinite(hit.t) && hit.t >= ray.t_min && hit.t <= ray.t_max && std::abs(len - 1) < 1e-3 &&
           hit.map.x >= 0 && hit.map.x <= 1 && hit.map.y >= 0 && hit.map.y <= 1;
}

class Neighbours {
public:
    Neighbours(const Judge& judge, const RayD& ray, std::uint32_t flags)
        : judge_(judge), flags_(flags), speed_(length(ray.direction)), t_min_(ray.t_min) {
        const Vec3d d = ray.direction * (1 / speed_);
        const Vec3d other = std::abs(d.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
        const Vec3d u = normalize(cross(d, other));
        const Vec3d v = cross(d, u);
        add(ray);
        for (const double size : {step / 10, step}) {
            for (int k = 0; k < 8; ++k) {
                const double angle = k * 0.785398163397448;
                RayD moved = ray;
                moved.origin = ray.origin + u * (size * std::cos(angle)) + v * (size * std::sin(angle));
                add(moved);
            }
        }
        const double along = step / speed_;
        for (const double by : {-along, along}) {
            RayD moved = ray;
            moved.t_min += by;
            add(moved);
            moved = ray;
            moved.t_max += by;
            add(moved);
        }
    }

    // Rays through points of the solid that the traced point may have been meant to be.
    void aim(const RayD& ray, double t) {
        const Vec3d point = ray.origin + ray.direction * t;
        for (const Vec3d& inside : judge_.points_inside(point, step)) {
            RayD moved = ray;
            moved.origin = moved.origin + (inside - point);
            add(moved);
        }
    }

    [[nodiscard]] bool some_miss() const {
        return std::any_of(answers_.begin(), answers_.end(),
                           [](const Answer& answer) { return !answer.first.has_value(); });
    }
    // Whether all of them are in the solid, or within `wide` of it along the ray, at one time before t. If
    // not, a ray that rounding bends may be outside until then.
    [[nodiscard]] bool blocked_before(double t) const {
        constexpr double wide = 4 * step;
        std::vector<std::pair<double, int>> changes;
        int rays = 0;
        for (const Answer& answer : answers_) {
            if (answer.filled) continue;
            ++rays;
            double end = -std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i + 1 < answer.events.size(); i += 2) {
                const double from = std::max(answer.events[i].t - wide / speed_, std::max(end, t_min_));
                end = answer.events[i + 1].t + wide / speed_;
                if (from >= end) continue;
                changes.emplace_back(from, 1);
                changes.emplace_back(end, -1);
            }
        }
        std::sort(changes.begin(), changes.end());
        int inside = 0;
        for (const auto& [time, change] : changes) {
            if (time >= t) break;
            inside += change;
            if (inside == rays) return true;
        }
        return false;
    }
    // Whether one of the rays has a hit at t, from this side of the surface. arrived: when the latest of them
    // came to the solid for it.
    [[nodiscard]] bool some_hit(double t, bool front, double bound, double& arrived) const {
        bool found = false;
        for (const Answer& answer : answers_) {
            for (std::size_t i = 0; i < answer.events.size(); ++i) {
                const Event& event = answer.events[i];
                if (event.open || event.enters != front) continue;
                if (std::abs(event.t - t) * speed_ > bound + event.core_length) continue;
                arrived = std::max(found ? arrived : -1e300, front || i == 0 ? t : answer.events[i - 1].t);
                found = true;
            }
        }
        return found;
    }
    // Whether one of the rays meets nothing earlier than t, less `bound` (in units of R).
    [[nodiscard]] bool some_free_before(double t, double bound) const {
        return std::any_of(answers_.begin(), answers_.end(), [&](const Answer& answer) {
            return !answer.first.has_value() || (t - answer.first->t) * speed_ <= bound;
        });
    }
    // Whether they meet the solid differently often, or first meet something else.
    [[nodiscard]] bool differ() const {
        const Answer& own = answers_.front();
        return std::any_of(answers_.begin(), answers_.end(), [&](const Answer& answer) {
            if (answer.filled) return false;
            if (answer.events.size() != own.events.size() ||
                answer.first.has_value() != own.first.has_value())
                return true;
            return answer.first.has_value() && (answer.first->enters != own.first->enters ||
                                                std::abs(answer.first->t - own.first->t) * speed_ > 1e-3);
        });
    }
    // Whether one of the rays has a hit at t that the core hides.
    [[nodiscard]] bool in_core(double t, double bound) const {
        return std::any_of(answers_.begin(), answers_.end(), [&](const Answer& answer) {
            return std::any_of(answer.events.begin(), answer.events.end(), [&](const Event& event) {
                return event.core_length > 0 && std::abs(event.t - t) * speed_ <= bound + event.core_length;
            });
        });
    }
    // Whether one of the rays goes through an open wall at t.
    [[nodiscard]] bool some_open(double t, bool front, double bound) const {
        return std::any_of(answers_.begin(), answers_.end(), [&](const Answer& answer) {
            return std::any_of(answer.events.begin(), answer.events.end(), [&](const Event& event) {
                return event.open && event.enters == front && std::abs(event.t - t) * speed_ <= bound;
            });
        });
    }
    [[nodiscard]] bool open_walls() const {
        return std::any_of(answers_.begin(), answers_.end(), [](const Answer& answer) {
            return std::any_of(answer.events.begin(), answer.events.end(),
                               [](const Event& event) { return event.open; });
        });
    }
    // Whether t lies between the earliest and the latest of their first hits.
    [[nodiscard]] bool between(double t) const {
        double first = std::numeric_limits<double>::infinity();
        double last = -first;
        for (const Answer& answer : answers_) {
            if (!answer.first.has_value()) continue;
            first = std::min(first, answer.first->t);
            last = std::max(last, answer.first->t);
        }
        return t >= first && t <= last;
    }

private:
    struct Answer {
        std::vector<Event> events;
        std::optional<Event> first;
        bool filled = false; // without thin gaps, or without tips
    };

    void add(const RayD& ray) {
        const std::vector<Event> events = judge_.events(ray);
        answers_.push_back({events, Judge::first(events, ray, flags_), false});
        const std::vector<Event> filled = judge_.without_thin_gaps(events, ray, step);
        answers_.push_back({filled, Judge::first(filled, ray, flags_), true});
        const std::vector<Event> thick = without_tips(events);
        if (thick.size() != events.size())
            answers_.push_back({thick, Judge::first(thick, ray, flags_), true});
    }

    // The events, but for solid less than a step long that a wall bounds.
    [[nodiscard]] std::vector<Event> without_tips(const std::vector<Event>& events) const {
        std::vector<Event> left;
        for (std::size_t i = 0; i + 1 < events.size(); i += 2) {
            const bool wall =
                events[i].side == trace::HitSide::wall || events[i + 1].side == trace::HitSide::wall;
            if (wall && (events[i + 1].t - events[i].t) * speed_ < step) continue;
            left.insert(left.end(), {events[i], events[i + 1]});
        }
        return left;
    }

    const Judge& judge_;
    std::uint32_t flags_;
    double speed_;
    double t_min_;
    std::vector<Answer> answers_;
};

// Of walls that are left the layer is not known.
bool leaves_wall(const trace::Hit& hit) { return !hit.front && hit.side == trace::HitSide::wall; }

// Of what the core hides nothing but the change from outside to inside is seen, or back.
bool same_record(const Event& event, const trace::Hit& hit) {
    if (event.core_length > 0) return event.enters == hit.front;
    return event.enters == hit.front && event.side == hit.side &&
           (event.layer == hit.layer || leaves_wall(hit)) &&
           dot(event.normal, to_double(hit.normal)) > 1 - 1e-4;
}

Judgement judge_once(const Judge& judge, const trace::Ray& ray, std::uint32_t flags, const trace::Hit& hit,
                     double bound) {
    if (!valid(ray, hit)) return {Verdict::invalid, 0, hit.valid()};
    const RayD exact = to_double(ray);
    const std::optional<Event> truth = judge.first(exact, flags);
    const bool traced = hit.valid();
    if (!traced && !truth.has_value()) return {};
    const double speed = length(exact.direction);
    const double t = double(hit.t);
    Judgement judgement{Verdict::agrees, 0, traced};
    if (traced && truth.has_value()) {
        judgement.dt = std::abs(t - truth->t) * speed;
        if (judgement.dt <= bound + truth->core_length && same_record(*truth, hit)) return judgement;
    }
    const Vec3d point = exact.origin + exact.direction * t;
    const Event face{.side = hit.side, .layer = hit.layer, .normal = to_double(hit.normal)};
    if (traced && truth.has_value() && judgement.dt <= bound && truth->enters == hit.front &&
        judge.near_face(point, bound, face, leaves_wall(hit))) {
        judgement.verdict = Verdict::beside;
        return judgement;
    }
    Neighbours near(judge, exact, flags);
    if (!traced) {
        if (near.some_miss() || !near.blocked_before(exact.t_max))
            judgement.verdict = Verdict::excused;
        else
            judgement.verdict =
                near.differ() && (flags != 0 || near.open_walls()) ? Verdict::bent : Verdict::missed;
        return judgement;
    }
    near.aim(exact, t);
    // A ray that grazes a face meets it anywhere along it.
    const bool on_face = judge.near_passage(point, bound, exact.direction, hit.front);
    double arrived = t;
    // Along a ray that all but runs in the plane the place is uncertain by this much more.
    const double slant = std::abs(dot(to_double(hit.normal), exact.direction)) / speed;
    const double wide = slant < grazing ? bound * std::min(1 / slant, 100.0) : bound;
    const bool at_open = hit.side == trace::HitSide::wall && near.some_open(t, hit.front, bound);
    const bool is_there = near.some_hit(t, hit.front, wide, arrived) || on_face || at_open ||
                          (near.between(t) && judge.near_boundary(point, bound));
    const bool nothing_before =
        near.some_free_before(t, bound) || !near.blocked_before(arrived - 5 * bound / speed);
    const bool in_core = near.in_core(t, bound);
    if (!is_there || !nothing_before)
        judgement.verdict = truth.has_value() ? Verdict::wrong_time : Verdict::invented;
    else if (!in_core && !judge.near_face(point, std::min(wide, 4 * bound), face, leaves_wall(hit)) &&
             !(leaves_wall(hit) && judge.near_sample_line(point, bound)))
        judgement.verdict = Verdict::wrong_record;
    else
        judgement.verdict = Verdict::excused;
    if (!is_right(judgement.verdict) && near.differ() && judge.near_boundary(point, bound))
        judgement.verdict = Verdict::bent;
    return judgement;
}

} // namespace

const char* name(Verdict verdict) {
    constexpr std::array<const char*, verdict_count> names{"agrees",       "beside", "excused",  "bent",
                                                           "core",         "missed", "invented", "wrong t",
                                                           "wrong record", "invalid"};
    return names[std::size_t(verdict)];
}

double time_bound(const trace::Ray& ray) {
    return std::max(step, 4 * double(std::numeric_limits<float>::epsilon()) * length(to_double(ray.origin)));
}

Judgement judge_hit(const Judge& judge, const trace::Ray& ray, std::uint32_t flags, const trace::Hit& hit,
                    double bound) {
    const Judgement judgement = judge_once(judge, ray, flags, hit, bound);
    if (is_right(judgement.verdict) || judgement.verdict == Verdict::invalid) return judgement;
    const double lost = judge.digits_lost(to_double(ray));
    if (lost == 0) return judgement;
    Judgement again = judge_once(judge, ray, flags, hit, bound + lost);
    const Vec3d point = to_double(ray.origin) + to_double(ray.direction) * double(hit.t);
    if (!is_right(again.verdict) && !(hit.valid() && judge.near_boundary(point, bound + lost)))
        return judgement;
    again.verdict = Verdict::core;
    return again;
}

std::string describe(const Judge& judge, const trace::Ray& ray, std::uint32_t flags, const trace::Hit& hit) {
    constexpr std::array<const char*, 3> sides{"outer", "inner", "wall"};
    char text[640];
    std::snprintf(text, sizeof text,
                  "Ray{{%.9gF, %.9gF, %.9gF}, %.9gF, {%.9gF, %.9gF, %.9gF}, %.9gF}, flags %u\n"
                  "    traced: t %.9g %s %s layer %u normal (%.4f %.4f %.4f)\n    events:",
                  double(ray.origin.x), double(ray.origin.y), double(ray.origin.z), double(ray.t_min),
                  double(ray.direction.x), double(ray.direction.y), double(ray.direction.z),
                  double(ray.t_max), flags, double(hit.t), hit.front ? "front" : "back",
                  sides[std::size_t(hit.side)], hit.layer, double(hit.normal.x), double(hit.normal.y),
                  double(hit.normal.z));
    std::string lines = text;
    for (const Event& event : judge.events(to_double(ray))) {
        std::snprintf(text, sizeof text, "\n      %.9g %s %s%s layer %u normal (%.4f %.4f %.4f)%s", event.t,
                      event.enters ? "enters" : "leaves", event.open ? "open " : "",
                      sides[std::size_t(event.side)], event.layer, event.normal.x, event.normal.y,
                      event.normal.z, event.core_length > 0 ? " core" : "");
        lines += text;
    }
    return lines;
}

} // namespace spa::test
