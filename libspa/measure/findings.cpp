// SPDX-License-Identifier: Apache-2.0
#include "findings.h"

#include <cmath>
#include <locale>
#include <sstream>

namespace spa::measure {
namespace {

// As the bounding sphere is rounded: part_frame adds 1e-7.
constexpr double radius_tolerance = 1e-6;

std::string number(double value) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out.precision(6);
    out << value;
    return out.str();
}

std::string count(std::uint64_t n, const char* one, const char* many) {
    return std::to_string(n) + " " + (n == 1 ? one : many);
}

std::string place(const WorstTexel& at) {
    return "layer " + std::to_string(at.layer) + " " + name(at.side) + ", texel (" +
           std::to_string(at.texel.x) + ", " + std::to_string(at.texel.y) + ")";
}

struct NamedFigure {
    const char* name;
    float ErrorFigures::*value;
};
constexpr NamedFigure figures[] = {
    {"texel_distance_max", &ErrorFigures::texel_distance_max},
    {"texel_distance_mean", &ErrorFigures::texel_distance_mean},
    {"surface_distance_max", &ErrorFigures::surface_distance_max},
    {"surface_distance_mean", &ErrorFigures::surface_distance_mean},
    {"captured_area", &ErrorFigures::captured_area},
    {"normal_angle_mean", &ErrorFigures::normal_angle_mean},
    {"color_difference_mean", &ErrorFigures::color_difference_mean},
    {"quantization_bound", &ErrorFigures::quantization_bound},
};

// Another program may spread its points otherwise. nullptr: all are as measured, or not in the file.
const char* lying_figure(const ErrorFigures& written, const ErrorFigures& measured) {
    for (const NamedFigure& figure : figures) {
        const double w = double(written.*figure.value);
        const double m = double(measured.*figure.value);
        if (!std::isnan(w) && std::abs(w - m) > 0.1 * m + 1e-6) return figure.name;
    }
    return nullptr;
}

} // namespace

std::vector<Finding> find_defects(const Part& part, const Measurement& m, double color_tolerance) {
    std::vector<Finding> findings;
    const double ratio = part.radius / m.source_radius;
    if (std::abs(ratio - 1) > radius_tolerance) {
        findings.push_back({"radius",
                            "the radius is " + number(part.radius) +
                                ", but the bounding sphere of the source about the map's centre has " +
                                number(m.source_radius) + ": every distance is scaled by " + number(ratio),
                            {}});
    }
    if (!m.quantization.holds()) {
        findings.push_back({"depth",
                            count(m.quantization.above, "depth is", "depths are") +
                                " off by more than quantization explains (" + number(m.quantization.bound) +
                                " R); the worst, " + place(*m.worst_depth) + ", by " +
                                number(m.worst_depth->value) + " R",
                            m.worst_depth});
    }
    if (m.coverage.missing > 0) {
        findings.push_back({"missing",
                            count(m.coverage.missing, "texel has", "texels have") +
                                " no surface where the source has one; the first is " +
                                place(*m.first_missing),
                            m.first_missing});
    }
    if (m.coverage.extra > 0) {
        findings.push_back({"extra",
                            count(m.coverage.extra, "texel has", "texels have") +
                                " a surface where the source has none; the first is " + place(*m.first_extra),
                            m.first_extra});
    }
    if (m.normals_above > 0) {
        findings.push_back({"normal",
                            count(m.normals_above, "normal is", "normals are") +
                                " off by more than quantization explains; the worst, " +
                                place(*m.worst_normal) + ", by " + number(m.worst_normal->value) + " degrees",
                            m.worst_normal});
    }
    if (m.color_difference.mean > color_tolerance) {
        findings.push_back({"color",
                            "colours are off by " + number(m.color_difference.mean) +
                                " of 255 on average; the worst, " + place(*m.worst_color) + ", by " +
                                number(m.worst_color->value),
                            m.worst_color});
    }
    if (m.alpha_difference.mean > color_tolerance) {
        findings.push_back({"alpha",
                            "the coverage of colours is off by " + number(m.alpha_difference.mean) +
                                " of 255 on average; the worst, " + place(*m.worst_alpha) + ", by " +
                                number(m.worst_alpha->value),
                            m.worst_alpha});
    }
    if (const char* const name = lying_figure(part.errors, error_figures(m))) {
        findings.push_back(
            {"figures",
             std::string("the error figures in the file are not those measured, for one ") + name,
             {}});
    }
    return findings;
}

} // namespace spa::measure
