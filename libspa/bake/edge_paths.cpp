// SPDX-License-Identifier: Apache-2.0
#include "edge_paths.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spa::bake {
namespace {

using To = EdgePath::To;

// A crossing that ends alone costs as much as this many times its W.
constexpr double cost_alone = 20;
// More crossings than this at two neighbouring points are not aligned: time and memory grow with the product.
constexpr std::size_t most_to_align = std::size_t(1) << 18U;

} // namespace

bool points_match(const EdgePoint& a, const EdgePoint& b, double length) {
    if (a.crossings.size() != b.crossings.size()) return false;
    for (std::size_t i = 0; i < a.crossings.size(); ++i)
        if (a.crossings[i].inner != b.crossings[i].inner ||
            !ends_match(a.crossings[i].end, a.direction, b.crossings[i].end, b.direction, length))
            return false;
    return true;
}

EdgePaths::EdgePaths(std::span<const EdgePoint> points, double length) : points_(points) {
    for (std::vector<Links>& side : links_) {
        side.resize(points.size());
        for (std::size_t p = 0; p < points.size(); ++p) side[p].resize(points[p].crossings.size());
    }
    for (std::size_t p = 0; p + 1 < points.size(); ++p) {
        const double piece = (points[p + 1].position - points[p].position) * length;
        align(points[p], points[p + 1], piece, links_[0][p], links_[1][p + 1]);
    }
    for (const unsigned end : {0U, 1U}) {
        const EdgePoint& point = end == 0 ? points.front() : points.back();
        for (std::uint32_t i = 0; i < point.crossings.size(); ++i) paths_[end].push_back(follow(end, i));
    }
}

// A table of the least costs of aligning the first i crossings of a with the first j of b.
void EdgePaths::align(const EdgePoint& a, const EdgePoint& b, double length, Links& from_a, Links& from_b) {
    const std::size_t n = a.crossings.size();
    const std::size_t m = b.crossings.size();
    const auto match = [&](std::size_t i, std::size_t j) {
        from_a[i] = {To::other_end, std::uint32_t(j)};
        from_b[j] = {To::other_end, std::uint32_t(i)};
    };
    if (points_match(a, b, length)) {
        for (std::size_t i = 0; i < n; ++i) match(i, i);
        return;
    }
    if ((n + 1) * (m + 1) > most_to_align) return;
    enum class Step : std::uint8_t { match, pair_a, pair_b, single_a, single_b };
    struct Cell {
        double cost = std::numeric_limits<double>::infinity();
        Step step = Step::match;
    };
    std::vector<Cell> table((n + 1) * (m + 1));
    table[0].cost = 0;
    const auto at = [&](std::size_t i, std::size_t j) -> Cell& { return table[i * (m + 1) + j]; };
    const auto pair_cost = [](const EdgePoint& p, std::size_t i) {
        const bool opposite = p.crossings[i - 2].inner != p.crossings[i - 1].inner;
        return opposite ? std::abs(p.crossings[i - 1].end.w - p.crossings[i - 2].end.w)
                        : std::numeric_limits<double>::infinity();
    };
    for (std::size_t i = 0; i <= n; ++i) {
        for (std::size_t j = 0; j <= m; ++j) {
            Cell& cell = at(i, j);
            const auto consider = [&](const Cell& before, double cost, Step step) {
                if (before.cost + cost < cell.cost) cell = {before.cost + cost, step};
            };
            if (i > 0 && j > 0 && a.crossings[i - 1].inner == b.crossings[j - 1].inner)
                consider(at(i - 1, j - 1),
                         ends_differ(a.crossings[i - 1].end, a.direction, b.crossings[j - 1].end, b.direction,
                                     length),
                         Step::match);
            if (i > 1) consider(at(i - 2, j), pair_cost(a, i), Step::pair_a);
            if (j > 1) consider(at(i, j - 2), pair_cost(b, j), Step::pair_b);
            if (i > 0) consider(at(i - 1, j), cost_alone * a.crossings[i - 1].end.w, Step::single_a);
            if (j > 0) consider(at(i, j - 1), cost_alone * b.crossings[j - 1].end.w, Step::single_b);
        }
    }
    const auto pair = [](Links& links, std::size_t i) {
        links[i - 2] = {To::same_end, std::uint32_t(i - 1)};
        links[i - 1] = {To::same_end, std::uint32_t(i - 2)};
    };
    for (std::size_t i = n, j = m; i > 0 || j > 0;) {
        switch (at(i, j).step) {
        case Step::match: match(--i, --j); break;
        case Step::pair_a:
            pair(from_a, i);
            i -= 2;
            break;
        case Step::pair_b:
            pair(from_b, j);
            j -= 2;
            break;
        case Step::single_a: --i; break;
        case Step::single_b: --j; break;
        }
    }
}

// Every link is passed at most once in a direction, so a path ends.
EdgePath EdgePaths::follow(unsigned end, std::uint32_t crossing) const {
    const std::size_t last = points_.size() - 1;
    std::size_t p = end == 0 ? 0 : last;
    unsigned towards = 1 - end;
    EdgePath path;
    double farthest = -1;
    for (;;) {
        const Link link = links_[1 - towards][p][crossing];
        const std::size_t next = towards == 1 ? p + 1 : p - 1;
        const double between = (points_[p].position + points_[next].position) / 2;
        const double own_w = points_[p].crossings[crossing].end.w;
        if (link.to == To::nowhere) {
            path.to = To::nowhere;
            path.position = between;
            path.w = own_w;
            return path;
        }
        crossing = link.index;
        if (link.to == To::other_end) {
            p = next;
            if (p != (towards == 1 ? last : 0)) continue;
            path.to = towards == end ? To::same_end : To::other_end;
        } else {
            const double distance = std::abs(between - (end == 0 ? 0.0 : 1.0));
            if (distance > farthest) {
                farthest = distance;
                path.position = between;
                path.w = (own_w + points_[p].crossings[crossing].end.w) / 2;
            }
            towards = 1 - towards;
            // At an end of the edge there is nothing on the other side.
            if (p != (towards == 1 ? last : 0)) continue;
            path.to = towards == end ? To::same_end : To::other_end;
        }
        path.index = crossing;
        return path;
    }
}

} // namespace spa::bake
