// SPDX-License-Identifier: Apache-2.0
#include "fold_records.h"

#include <algorithm>
#include <cmath>

namespace spa::bake {
namespace {

using To = EdgePath::To;

std::uint8_t place_of(double distance) {
    return std::uint8_t(std::clamp(std::lround(distance * 256) - 1, 0L, 255L));
}

std::uint16_t depth_code(double depth) {
    return std::uint16_t(std::clamp(std::lround(depth * 65535), 1L, 65535L));
}

// The records of one end.
class EndRecords {
public:
    EndRecords(std::uint32_t edge, unsigned end, std::span<const EdgePoint> points,
               const std::vector<EdgePath>& paths, std::array<std::uint32_t, 2> stored)
        : edge_(edge), end_(end), own_(end == 0 ? points.front() : points.back()),
          other_(end == 0 ? points.back() : points.front()), paths_(paths), stored_(stored) {
        for (std::uint32_t i = 0; i < stored[end]; ++i) left_.push_back(i);
    }

    // Appends them in the order in which they apply.
    void write(std::vector<FoldRecord>& records) {
        for (std::size_t i = 0; i < left_.size();) {
            if (ends_alone(left_[i]))
                write_single(i, records);
            else
                ++i;
        }
        // Pairs from the inside out: what lies between two that meet has met before.
        for (std::size_t i = 0; i + 1 < left_.size();) {
            const EdgePath& path = paths_[left_[i]];
            if (path.to == To::same_end && path.index == left_[i + 1]) {
                write_pair(i, records);
                i = i > 0 ? i - 1 : 0;
            } else {
                ++i;
            }
        }
        for (std::size_t i = 0; i < left_.size();) {
            if (paths_[left_[i]].to == To::same_end)
                write_single(i, records);
            else
                ++i;
        }
    }

    // Those that reach the other end.
    [[nodiscard]] const std::vector<std::uint32_t>& left() const { return left_; }

private:
    [[nodiscard]] bool ends_alone(std::uint32_t crossing) const {
        const EdgePath& path = paths_[crossing];
        if (path.to == To::nowhere) return true;
        return path.index >= stored_[path.to == To::same_end ? end_ : 1 - end_];
    }

    [[nodiscard]] FoldRecord record_at(std::size_t i, double distance) const {
        FoldRecord record;
        record.edge = edge_;
        record.end = std::uint8_t(end_);
        record.index = std::uint8_t(i);
        record.place = place_of(distance);
        return record;
    }
    [[nodiscard]] Vec3d cut_direction(const FoldRecord& record) const {
        const double f = fold_position(record.place);
        return own_.direction * (1 - f) + other_.direction * f;
    }

    // The depth at the cut of a crossing that runs into another one where W is `w`. Towards a silhouette W
    // behaves like a square root: what is linear up to a third of the tangent plane's rest has the same mean.
    [[nodiscard]] std::uint16_t cut_of(std::uint32_t crossing, double w, Vec3d g) const {
        const SurfaceEnd& end = own_.crossings[crossing].end;
        const double tangent = end.bounded ? dot(end.plane, g) : end.w;
        const double bounded = std::clamp(tangent, std::min(w, end.w), std::max(w, end.w));
        return depth_code(length(g) / (w + 2.0 / 3 * (bounded - w)));
    }

    void write_pair(std::size_t i, std::vector<FoldRecord>& records) {
        const EdgePath& path = paths_[left_[i]];
        FoldRecord record = record_at(i, distance_of(path));
        record.pair = true;
        const Vec3d g = cut_direction(record);
        record.cut = {cut_of(left_[i], path.w, g), cut_of(left_[i + 1], path.w, g)};
        records.push_back(record);
        left_.erase(left_.begin() + std::ptrdiff_t(i), left_.begin() + std::ptrdiff_t(i) + 2);
    }

    void write_single(std::size_t i, std::vector<FoldRecord>& records) {
        const EdgePath& path = paths_[left_[i]];
        const bool continues = path.to == To::other_end; // but is not stored there
        FoldRecord record = record_at(i, continues ? 1 : distance_of(path));
        const Vec3d g = cut_direction(record);
        if (path.to == To::same_end)
            record.cut[0] = cut_of(left_[i], path.w, g);
        else
            record.cut[0] = depth_code(length(g) / (continues ? other_.crossings[path.index].end.w : path.w));
        records.push_back(record);
        left_.erase(left_.begin() + std::ptrdiff_t(i));
    }

    [[nodiscard]] double distance_of(const EdgePath& path) const {
        return end_ == 0 ? path.position : 1 - path.position;
    }

    std::uint32_t edge_;
    unsigned end_;
    const EdgePoint& own_;
    const EdgePoint& other_;
    const std::vector<EdgePath>& paths_;
    std::array<std::uint32_t, 2> stored_;
    std::vector<std::uint32_t> left_;
};

// Where nothing else can be said.
EdgeFolds all_end(std::uint32_t edge, std::span<const EdgePoint> points,
                  std::array<std::uint32_t, 2> stored) {
    EdgeFolds folds;
    folds.unresolved = true;
    const Vec3d middle = (points.front().direction + points.back().direction) * 0.5;
    for (const unsigned end : {0U, 1U}) {
        const EdgePoint& point = end == 0 ? points.front() : points.back();
        for (std::uint32_t i = 0; i < stored[end]; ++i) {
            FoldRecord record;
            record.edge = edge;
            record.end = std::uint8_t(end);
            record.place = place_of(0.5);
            const double w = i < point.crossings.size() ? point.crossings[i].end.w : 1;
            record.cut[0] = depth_code(length(middle) / w);
            folds.records.push_back(record);
        }
    }
    return folds;
}

} // namespace

EdgeFolds fold_records(std::uint32_t edge, std::span<const EdgePoint> points, const EdgePaths& paths,
                       std::array<std::uint32_t, 2> stored) {
    // Another caster may have seen something else at the samples.
    if (stored[0] > paths.from(0).size() || stored[1] > paths.from(1).size())
        return all_end(edge, points, stored);
    EdgeFolds folds;
    EndRecords first(edge, 0, points, paths.from(0), stored);
    EndRecords second(edge, 1, points, paths.from(1), stored);
    first.write(folds.records);
    second.write(folds.records);
    bool in_order = first.left().size() == second.left().size();
    for (std::size_t i = 0; in_order && i < first.left().size(); ++i)
        in_order = paths.from(0)[first.left()[i]].index == second.left()[i] &&
                   points.front().crossings[first.left()[i]].inner ==
                       points.back().crossings[second.left()[i]].inner;
    return in_order ? folds : all_end(edge, points, stored);
}

} // namespace spa::bake
