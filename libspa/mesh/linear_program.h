// SPDX-License-Identifier: Apache-2.0
// Linear programs of few variables, by adding one constraint after the other (Seidel 1991): where the optimum
// so far breaks the next one, the new optimum lies on its plane, which is a program of one variable less.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace spa {

template <std::size_t N>
using Variables = std::array<double, N>;

// normal . x <= limit
template <std::size_t N>
struct HalfSpace {
    Variables<N> normal{};
    double limit = 0;
};

template <std::size_t N>
double dot(const Variables<N>& a, const Variables<N>& b) {
    double sum = 0;
    for (std::size_t k = 0; k < N; ++k) sum += a[k] * b[k];
    return sum;
}

// Below it, in a program whose normals and box are of the order of 1, a constraint counts as kept.
constexpr double program_tolerance = 1e-11;

// An x of the box low <= x <= high with the largest objective . x that keeps all half-spaces, or nothing
// where there is none. The optimum is one number, but of several x that reach it which is returned depends on
// the order. O(N! constraints) expected if their order is random; O(constraints^N) at most.
template <std::size_t N>
std::optional<Variables<N>> maximize(const Variables<N>& objective, const Variables<N>& low,
                                     const Variables<N>& high, const std::vector<HalfSpace<N>>& kept);

namespace detail {

// Without variable k, on the plane where `plane` holds with equality.
template <std::size_t N>
HalfSpace<N - 1> without(std::size_t k, const HalfSpace<N>& half, const HalfSpace<N>& plane) {
    const double share = half.normal[k] / plane.normal[k];
    HalfSpace<N - 1> out;
    for (std::size_t from = 0, to = 0; from < N; ++from) {
        if (from != k) out.normal[to++] = half.normal[from] - share * plane.normal[from];
    }
    out.limit = half.limit - share * plane.limit;
    return out;
}

template <std::size_t N>
Variables<N - 1> without(std::size_t k, const Variables<N>& x) {
    Variables<N - 1> out{};
    for (std::size_t from = 0, to = 0; from < N; ++from) {
        if (from != k) out[to++] = x[from];
    }
    return out;
}

inline std::optional<Variables<1>> maximize_one(double objective, double low, double high,
                                                const std::vector<HalfSpace<1>>& kept) {
    for (const HalfSpace<1>& half : kept) {
        const double a = half.normal[0];
        if (a > program_tolerance)
            high = std::fmin(high, half.limit / a);
        else if (a < -program_tolerance)
            low = std::fmax(low, half.limit / a);
        else if (half.limit < -program_tolerance)
            return std::nullopt;
    }
    if (low > high + program_tolerance) return std::nullopt;
    return Variables<1>{objective < 0 ? low : high};
}

// The optimum on the plane of kept[at], of the constraints before it.
template <std::size_t N>
std::optional<Variables<N>> maximize_on(std::size_t at, const Variables<N>& objective,
                                        const Variables<N>& low, const Variables<N>& high,
                                        const std::vector<HalfSpace<N>>& kept) {
    const HalfSpace<N>& plane = kept[at];
    std::size_t k = 0; // the largest coefficient loses the fewest digits
    for (std::size_t i = 1; i < N; ++i) {
        if (std::abs(plane.normal[i]) > std::abs(plane.normal[k])) k = i;
    }
    if (!(std::abs(plane.normal[k]) > program_tolerance)) return std::nullopt;
    std::vector<HalfSpace<N - 1>> rest;
    rest.reserve(at + 2);
    HalfSpace<N> above, below;
    above.normal[k] = 1;
    above.limit = high[k];
    below.normal[k] = -1;
    below.limit = -low[k];
    rest.push_back(without(k, above, plane));
    rest.push_back(without(k, below, plane));
    for (std::size_t i = 0; i < at; ++i) rest.push_back(without(k, kept[i], plane));
    const auto found = maximize<N - 1>(without(k, HalfSpace<N>{objective, 0}, plane).normal, without(k, low),
                                       without(k, high), rest);
    if (!found) return std::nullopt;
    Variables<N> x{};
    double sum = plane.limit;
    for (std::size_t to = 0, from = 0; to < N; ++to) {
        if (to == k) continue;
        x[to] = (*found)[from++];
        sum -= plane.normal[to] * x[to];
    }
    x[k] = sum / plane.normal[k];
    return x;
}

} // namespace detail

template <std::size_t N>
std::optional<Variables<N>> maximize(const Variables<N>& objective, const Variables<N>& low,
                                     const Variables<N>& high, const std::vector<HalfSpace<N>>& kept) {
    if constexpr (N == 1) {
        return detail::maximize_one(objective[0], low[0], high[0], kept);
    } else {
        Variables<N> x{};
        for (std::size_t k = 0; k < N; ++k) x[k] = objective[k] < 0 ? low[k] : high[k];
        for (std::size_t i = 0; i < kept.size(); ++i) {
            if (dot(kept[i].normal, x) <= kept[i].limit + program_tolerance) continue;
            const auto moved = detail::maximize_on(i, objective, low, high, kept);
            if (!moved) return std::nullopt;
            x = *moved;
        }
        return x;
    }
}

} // namespace spa
