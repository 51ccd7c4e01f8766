// SPDX-License-Identifier: Apache-2.0
#include "allocate.h"

#include <algorithm>
#include <numeric>
#include <queue>

namespace spa::plan {
namespace {

// From the cheapest choice to the most exact, each step saving less error a byte than the one before: the
// lower left hull of the menu.
std::vector<std::size_t> hull_of(const Menu& menu) {
    std::vector<std::size_t> order(menu.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        if (menu[a].bytes != menu[b].bytes) return menu[a].bytes < menu[b].bytes;
        if (menu[a].error != menu[b].error) return menu[a].error < menu[b].error;
        return a < b;
    });
    const auto rate = [&](std::size_t from, std::size_t to) {
        return (menu[from].error - menu[to].error) / double(menu[to].bytes - menu[from].bytes);
    };
    std::vector<std::size_t> hull;
    for (const std::size_t next : order) {
        if (!hull.empty() &&
            (menu[next].error >= menu[hull.back()].error || menu[next].bytes == menu[hull.back()].bytes))
            continue;
        while (hull.size() >= 2 && rate(hull[hull.size() - 2], hull.back()) <= rate(hull.back(), next))
            hull.pop_back();
        hull.push_back(next);
    }
    return hull;
}

struct Step {
    double rate;          // of error a byte
    std::size_t menu, to; // `to`: in the hull
    bool operator<(const Step& other) const {
        if (rate != other.rate) return rate < other.rate;
        return menu > other.menu;
    }
};

class Allocator {
public:
    Allocator(std::span<const Menu> menus, const Limits& limits) : menus_(menus), limits_(limits) {
        for (std::size_t i = 0; i < menus.size(); ++i) {
            hulls_.push_back(hull_of(menus[i]));
            offer(i, 1);
        }
        at_.resize(menus.size());
        for (std::size_t i = 0; i < at_.size(); ++i) {
            bytes_ += choice(i, 0).bytes;
            error_ += choice(i, 0).error;
        }
    }

    Allocation run() {
        while (!steps_.empty()) {
            if (limits_.error && error_ <= *limits_.error) break;
            const Step step = steps_.top();
            steps_.pop();
            const Choice &now = choice(step.menu, step.to - 1), &next = choice(step.menu, step.to);
            if (limits_.bytes && bytes_ - now.bytes + next.bytes > *limits_.bytes) continue; // others may fit
            move(step.menu, step.to);
            offer(step.menu, step.to + 1);
        }
        give_back();
        return result();
    }

private:
    [[nodiscard]] const Choice& choice(std::size_t menu, std::size_t at) const {
        return menus_[menu][hulls_[menu][at]];
    }

    void offer(std::size_t menu, std::size_t to) {
        if (to >= hulls_[menu].size()) return;
        const Choice &a = choice(menu, to - 1), &b = choice(menu, to);
        steps_.push({(a.error - b.error) / double(b.bytes - a.bytes), menu, to});
    }

    void move(std::size_t menu, std::size_t to) {
        const Choice &now = choice(menu, at_[menu]), &next = choice(menu, to);
        bytes_ = bytes_ - now.bytes + next.bytes;
        error_ = error_ - now.error + next.error;
        at_[menu] = to;
    }

    // The last step may have brought more than was missing: steps back, largest saving first, as far as the
    // error allows.
    void give_back() {
        if (!limits_.error || error_ > *limits_.error) return;
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < at_.size(); ++i)
            if (at_[i] > 0) order.push_back(i);
        const auto saving = [&](std::size_t i) {
            return choice(i, at_[i]).bytes - choice(i, at_[i] - 1).bytes;
        };
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return saving(a) > saving(b); });
        for (const std::size_t i : order)
            if (error_ - choice(i, at_[i]).error + choice(i, at_[i] - 1).error <= *limits_.error)
                move(i, at_[i] - 1);
    }

    [[nodiscard]] Allocation result() const {
        Allocation allocation;
        for (std::size_t i = 0; i < at_.size(); ++i) allocation.chosen.push_back(hulls_[i][at_[i]]);
        allocation.bytes = bytes_;
        allocation.error = error_;
        allocation.meets_error = !limits_.error || error_ <= *limits_.error;
        allocation.meets_bytes = !limits_.bytes || bytes_ <= *limits_.bytes;
        return allocation;
    }

    std::span<const Menu> menus_;
    const Limits& limits_;
    std::vector<std::vector<std::size_t>> hulls_;
    std::vector<std::size_t> at_; // in the hulls
    std::priority_queue<Step> steps_;
    std::uint64_t bytes_ = 0;
    double error_ = 0;
};

} // namespace

Allocation allocate(std::span<const Menu> menus, const Limits& limits) {
    return Allocator(menus, limits).run();
}

} // namespace spa::plan
