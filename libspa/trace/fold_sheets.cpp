// SPDX-License-Identifier: Apache-2.0
#include "fold_sheets.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace spa::trace {
namespace {

// Where a crossing ends on the way to another corner.
struct Cut {
    bool there = false;
    bool alone = false;
    CellPoint at;
    double w = 0;
};

class SheetFinder {
public:
    SheetFinder(unsigned triangle, const std::array<SampleCrossings, 3>& crossings)
        : places_(triangle_places(triangle)), crossings_(crossings) {
        for (std::size_t i = 0; i < 3; ++i) first_[i + 1] = first_[i] + std::uint32_t(crossings[i].size());
        sheet_of_.resize(first_[3]);
        std::iota(sheet_of_.begin(), sheet_of_.end(), 0U);
        for (std::vector<Cut>& cuts : cuts_) cuts.resize(first_[3]);
    }

    bool add_edge(const EdgeRecords& edge) {
        std::array<std::vector<std::uint32_t>, 2> left;
        for (const std::size_t end : {0U, 1U}) {
            left[end].resize(crossings_[edge.edge.corner[end]].size());
            std::iota(left[end].begin(), left[end].end(), 0U);
        }
        for (const FoldRecord& record : edge.records)
            if (!apply(record, edge, left[record.end])) return false;
        if (left[0].size() != left[1].size()) return false;
        for (std::size_t i = 0; i < left[0].size(); ++i) {
            if ((left[0][i] ^ left[1][i]) & 1U) return false;
            unite(number(edge.edge.corner[0], left[0][i]), number(edge.edge.corner[1], left[1][i]));
        }
        return true;
    }

    bool write(Sheets& sheets) {
        for (std::uint32_t root = 0; root < first_[3]; ++root) {
            if (find(root) != root) continue;
            std::array<std::uint32_t, 3> at{none, none, none};
            for (unsigned corner = 0; corner < 3; ++corner)
                for (std::uint32_t k = 0; k < crossings_[corner].size(); ++k)
                    if (find(number(corner, k)) == root) {
                        if (at[corner] != none) return false;
                        at[corner] = k;
                    }
            if (!write_sheet(at, sheets)) return false;
        }
        return true;
    }

private:
    static constexpr std::uint32_t none = UINT32_MAX;

    [[nodiscard]] std::uint32_t number(unsigned corner, std::uint32_t crossing) const {
        return first_[corner] + crossing;
    }
    [[nodiscard]] std::uint32_t find(std::uint32_t i) const {
        while (sheet_of_[i] != i) i = sheet_of_[i];
        return i;
    }
    void unite(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        sheet_of_[std::max(a, b)] = std::min(a, b);
    }

    bool apply(const FoldRecord& record, const EdgeRecords& edge, std::vector<std::uint32_t>& left) {
        const std::size_t count = record.pair ? 2 : 1;
        if (left.size() < count || record.index > left.size() - count) return false;
        const unsigned own = edge.edge.corner[record.end];
        const unsigned other = edge.edge.corner[1U - record.end];
        const double f = fold_position(record.place);
        const Vec3d g = edge.direction[record.end] * (1 - f) + edge.direction[1U - record.end] * f;
        const auto first = left.begin() + record.index;
        if (record.pair && ((first[0] ^ first[1]) & 1U) == 0) return false;
        for (std::size_t k = 0; k < count; ++k) {
            if (record.cut[k] == 0) return false;
            Cut& cut = cuts_[other][number(own, first[std::ptrdiff_t(k)])];
            cut.there = true;
            cut.alone = !record.pair;
            cut.at = {places_[own].u * (1 - f) + places_[other].u * f,
                      places_[own].v * (1 - f) + places_[other].v * f};
            cut.w = length(g) * 65535 / record.cut[k];
        }
        left.erase(first, first + std::ptrdiff_t(count));
        return true;
    }

    static CellPlane plane_through(const CellPoint& a, double wa, const CellPoint& b, double wb,
                                   const CellPoint& c, double wc) {
        const double bu = b.u - a.u, bv = b.v - a.v, cu = c.u - a.u, cv = c.v - a.v;
        const double turn = bu * cv - cu * bv;
        const double u = ((wb - wa) * cv - (wc - wa) * bv) / turn;
        const double v = ((wc - wa) * bu - (wb - wa) * cu) / turn;
        return {wa - u * a.u - v * a.v, u, v};
    }

    // at: its crossing of each corner.
    bool write_sheet(const std::array<std::uint32_t, 3>& at, Sheets& sheets) {
        Sheet sheet;
        std::array<unsigned, 3> has{}, lacks{};
        unsigned count = 0, lacking = 0;
        sheet.least_w = SPA_FAR;
        for (unsigned corner = 0; corner < 3; ++corner) {
            if (at[corner] == none) {
                lacks[lacking++] = corner;
                continue;
            }
            if (count == 0) {
                sheet.inner = (at[corner] & 1U) != 0;
                sheet.layer = at[corner] / 2;
            }
            has[count++] = corner;
            sheet.least_w = std::min(sheet.least_w, w_at(corner, at[corner]));
        }
        // A crossing that ends on the way to a corner where its own sheet stands makes no sense.
        for (unsigned a = 0; a < count; ++a)
            for (unsigned b = 0; b < count; ++b)
                if (a != b && cuts_[has[b]][number(has[a], at[has[a]])].there) return false;
        if (count == 3) {
            sheet.plane = plane_through(places_[0], w_at(0, at[0]), places_[1], w_at(1, at[1]), places_[2],
                                        w_at(2, at[2]));
            sheets.sheets.push_back(sheet);
            return true;
        }
        // The two cuts: of one corner towards the others, or of two corners towards the third.
        const unsigned a = has[0];
        const unsigned b = count == 2 ? has[1] : a;
        const Cut& first = cuts_[lacks[0]][number(a, at[a])];
        const Cut& second = cuts_[lacks[lacking - 1]][number(b, at[b])];
        if (!first.there || !second.there) return false;
        sheet.ends_alone = first.alone && second.alone;
        if (count == 1) {
            sheet.least_w = std::min({sheet.least_w, first.w, second.w});
            sheet.plane = plane_through(places_[a], w_at(a, at[a]), first.at, first.w, second.at, second.w);
        } else {
            sheet.least_w = std::min(sheet.least_w, (first.w + second.w) / 2);
            const CellPoint middle{(first.at.u + second.at.u) / 2, (first.at.v + second.at.v) / 2};
            sheet.plane = plane_through(places_[a], w_at(a, at[a]), places_[b], w_at(b, at[b]), middle,
                                        (first.w + second.w) / 2);
        }
        // One of two corners may be on the line.
        const CellPoint inside{(places_[a].u + places_[b].u) / 2, (places_[a].v + places_[b].v) / 2};
        if (!end_at(first.at, second.at, inside, sheet, sheets)) return false;
        sheets.sheets.push_back(sheet);
        return true;
    }

    // The line through two cut points; inside: a point where the sheet stands.
    static bool end_at(const CellPoint& p, const CellPoint& q, const CellPoint& inside, Sheet& sheet,
                       Sheets& sheets) {
        const double du = q.u - p.u;
        const double dv = q.v - p.v;
        const double size = std::sqrt(du * du + dv * dv);
        if (size < 1e-9) return true; // both at the third corner: it stands everywhere
        // The same line, whichever sheet it comes from.
        CellPlane line{(dv * p.u - du * p.v) / -size, dv / size, -du / size};
        if (line.u < 0 || (line.u == 0 && line.v < 0)) line = {-line.c, -line.u, -line.v};
        const auto same = [&](const CellPlane& known) {
            return std::abs(known.c - line.c) + std::abs(known.u - line.u) + std::abs(known.v - line.v) <
                   1e-9;
        };
        const auto known = std::find_if(sheets.lines.begin(), sheets.lines.end(), same);
        sheet.line = int(known - sheets.lines.begin());
        sheet.beyond = line.at(inside.u, inside.v) < 0;
        if (known != sheets.lines.end()) return true;
        sheets.lines.push_back(line);
        return sheets.lines.size() <= most_fold_lines;
    }

    [[nodiscard]] double w_at(unsigned corner, std::uint32_t crossing) const {
        return crossings_[corner][crossing];
    }

    std::array<CellPoint, 3> places_;
    const std::array<SampleCrossings, 3>& crossings_;
    std::array<std::uint32_t, 4> first_{};
    std::vector<std::uint32_t> sheet_of_;  // disjoint sets of crossings
    std::array<std::vector<Cut>, 3> cuts_; // towards each corner, of every crossing
};

} // namespace

bool find_sheets(unsigned triangle, const std::array<EdgeRecords, 3>& edges,
                 const std::array<SampleCrossings, 3>& crossings, Sheets& sheets) {
    sheets = {};
    SheetFinder finder(triangle, crossings);
    for (const EdgeRecords& edge : edges)
        if (!finder.add_edge(edge)) return false;
    return finder.write(sheets);
}

} // namespace spa::trace
