// SPDX-License-Identifier: Apache-2.0
#include "paper_printed.h"

#include <algorithm>

namespace spa::tools {
namespace {

constexpr std::array<std::string_view, 6> rows{"fan 0", "fan 1", "fan 3", "fan 5", "fan 10", "triangles"};

constexpr double tables[7][6][4] = {
    {{128.8, 43.6, 13.3, 6.7},
     {55.4, 16.8, 4.5, 2.3},
     {49.7, 14.5, 3.8, 1.7},
     {45.8, 13.2, 3.3, 1.6},
     {42.5, 12.2, 2.9, 1.4},
     {42.1, 12.3, 3.3, 1.6}},
    {{130.5, 49.5, 12.5, 6.1},
     {55.7, 16.9, 4.4, 2.2},
     {47.6, 14.6, 3.4, 1.8},
     {46.8, 13, 3.2, 1.4},
     {41.6, 11.8, 2.8, 1.3},
     {42.3, 12.8, 3.1, 1.5}},
    {{127, 45.3, 12.6, 5.8},
     {56.2, 17.1, 4.4, 2.3},
     {46.2, 13.8, 3.7, 1.7},
     {43.8, 12.7, 6.7, 1.4},
     {40.7, 11.6, 3.3, 1.4},
     {35.8, 10.7, 2.4, 1.3}},
    {{127.2, 45.8, 12.4, 6.2},
     {56.7, 17.4, 4.2, 2.3},
     {47.8, 14.2, 3.6, 1.7},
     {44.3, 13.1, 3.1, 1.6},
     {41.3, 11.9, 3.2, 1.5},
     {32.9, 9.5, 2.4, 1.1}},
    {{121.1, 44.7, 13.5, 6.6},
     {56.6, 18.3, 4.8, 2.1},
     {48.4, 14.6, 3.8, 1.8},
     {44.6, 13.8, 3.4, 1.6},
     {41.4, 12.3, 2.9, 1.5},
     {28.8, 8.5, 2.2, 0.9}},
    {{98.5, 42.6, 13.4, 6.4},
     {51.2, 17.7, 4.8, 2.2},
     {44.0, 14.7, 3.6, 1.9},
     {38.8, 12.9, 3.4, 1.3},
     {38.1, 12.3, 2.7, 1.3},
     {24.9, 7.4, 1.9, 0.3}},
    {{48.6, 31.1, 11.7, 6.3},
     {38.5, 15.9, 4.8, 2.1},
     {33.6, 13.3, 3.7, 1.8},
     {32.2, 12.2, 3.4, 1.9},
     {30.2, 11.3, 3.2, 1.7},
     {20.9, 6.9, 1.6, 0.2}},
};

} // namespace

std::optional<double> printed_frames_per_second(int level, std::string_view method, std::uint32_t samples) {
    const auto row = std::find(rows.begin(), rows.end(), method);
    const auto column = std::find(paper_samples.begin(), paper_samples.end(), samples);
    if (level < 0 || level > 6 || row == rows.end() || column == paper_samples.end()) return {};
    return tables[level][row - rows.begin()][column - paper_samples.begin()];
}

} // namespace spa::tools
