// SPDX-License-Identifier: Apache-2.0
// From the crossings at a triangle's corners and the records of its edges to sheets of surface. The
// definition is ../../docs/tracing.md, "Mixed triangles with folds".
#pragma once

#include "fold_cells.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace spa::trace {

struct EdgeRecords {
    TriangleEdge edge;
    std::array<Vec3d, 2> direction; // of its ends, |g|_1 = 1
    std::span<const FoldRecord> records;
};

// Crossings that are one surface within the triangle.
struct Sheet {
    CellPlane plane;    // W
    double least_w = 0; // of what it goes through
    bool inner = false;
    std::uint32_t layer = 0; // of its crossing at the first corner that has one
    int line = -1;           // where it ends: index in Sheets::lines; -1: nowhere
    bool beyond = false;     // it stands where the line is negative
    bool ends_alone = false; // by single records on both sides

    // lines: bit l = where line l is negative.
    [[nodiscard]] bool stands(std::uint32_t lines) const {
        return line < 0 || ((lines >> unsigned(line) & 1U) != 0) == beyond;
    }
};

struct Sheets {
    std::vector<Sheet> sheets;
    std::vector<CellPlane> lines; // of unit gradient; most_fold_lines at most
};

constexpr std::size_t most_fold_lines = 5;
// A plane that falls below this share of the least W that it goes through is none.
constexpr double least_share_of_w = 0.25;

// Where the corners of a cell's triangle lie, in the order of triangle_corners().
constexpr std::array<CellPoint, 3> triangle_places(unsigned triangle) {
    return {triangle == 0 ? CellPoint{0, 0} : CellPoint{1, 1}, CellPoint{0, 1}, CellPoint{1, 0}};
}

// False: the records do not make sense. edges: as triangle_edges(); crossings: of the corners.
bool find_sheets(unsigned triangle, const std::array<EdgeRecords, 3>& edges,
                 const std::array<SampleCrossings, 3>& crossings, Sheets& sheets);

} // namespace spa::trace
