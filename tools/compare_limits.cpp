// SPDX-License-Identifier: Apache-2.0
#include "compare_limits.h"

#include "arguments.h"

#include <algorithm>
#include <array>

namespace spa::tools {

namespace {

using measure::PartDifference;
using measure::SurfaceDifference;

double share(std::uint64_t count, std::uint64_t all) { return all == 0 ? 0 : double(count) / double(all); }

constexpr std::array<ComparedFigure, 12> figures{{
    {"center", "distance of the centres, in R", nullptr, [](const PartDifference& p) { return p.center; }},
    {"radius", "difference of the radii, relative", nullptr,
     [](const PartDifference& p) { return p.radius; }},
    {"frame", "largest difference of the frames' elements", nullptr,
     [](const PartDifference& p) { return p.frame; }},
    {"coverage", "share of samples with a surface in one map alone",
     [](const SurfaceDifference& s) { return share(s.coverage_differs, s.samples); }, nullptr},
    {"depth_differs", "share of common samples whose depths differ by more than 2 codes of u16",
     [](const SurfaceDifference& s) { return share(s.depth_differs, s.both); }, nullptr},
    {"depth_mean", "mean difference of depth, in R", [](const SurfaceDifference& s) { return s.depth_mean; },
     nullptr},
    {"depth_max", "largest difference of depth, in R", [](const SurfaceDifference& s) { return s.depth_max; },
     nullptr},
    {"normal_mean", "mean angle between normals, in degrees",
     [](const SurfaceDifference& s) { return s.normal_mean; }, nullptr},
    {"normal_max", "largest angle between normals, in degrees",
     [](const SurfaceDifference& s) { return s.normal_max; }, nullptr},
    {"color_mean", "mean difference of red, green and blue, in codes of 255",
     [](const SurfaceDifference& s) { return s.color_mean; }, nullptr},
    {"color_max", "largest difference of red, green and blue, in codes of 255",
     [](const SurfaceDifference& s) { return double(s.color_max); }, nullptr},
    {"alpha_mean", "mean difference of the colours' coverage, in codes of 255",
     [](const SurfaceDifference& s) { return s.alpha_mean; }, nullptr},
}};

Limit parse_limit(const std::string& option, std::string_view item) {
    const std::size_t equals = item.find('=');
    const std::string_view name = item.substr(0, equals);
    const auto* const figure =
        std::find_if(figures.begin(), figures.end(), [&](const ComparedFigure& f) { return f.name == name; });
    if (figure == figures.end() || equals == std::string_view::npos) {
        std::string message = option + ": '" + std::string(item) + "' is not NAME=VALUE with a NAME out of ";
        for (const ComparedFigure& f : figures)
            message += std::string(&f == figures.data() ? "" : ", ") + f.name;
        throw Error(ExitCode::usage, message);
    }
    return {figure, parse_measure(option, std::string(item.substr(equals + 1)))};
}

} // namespace

std::span<const ComparedFigure> compared_figures() { return figures; }

double worst(const ComparedFigure& figure, const measure::MapDifference& difference) {
    double value = 0;
    if (figure.of_part != nullptr)
        for (const PartDifference& part : difference.parts) value = std::max(value, figure.of_part(part));
    else
        for (const SurfaceDifference& surface : difference.surfaces)
            value = std::max(value, figure.of_surface(surface));
    return value;
}

std::vector<Limit> parse_limits(const std::string& option, const std::string& text) {
    std::vector<Limit> limits;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        limits.push_back(parse_limit(option, std::string_view(text).substr(begin, end - begin)));
        begin = end + 1;
    }
    return limits;
}

std::vector<Limit> exceeded(const std::vector<Limit>& limits, const measure::MapDifference& difference) {
    std::vector<Limit> result;
    std::copy_if(limits.begin(), limits.end(), std::back_inserter(result),
                 [&](const Limit& limit) { return worst(*limit.figure, difference) > limit.value; });
    return result;
}

} // namespace spa::tools
