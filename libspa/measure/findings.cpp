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

// Another program may spread its points otherwise. nullptr: all are as measured, or not in the file.
const char* lying_figure(const ErrorFigures& written, const ErrorFigures& measured) {
    for (const ErrorFigureField& figure : error_figure_fields) {
        const double w = double(written.*figure.value);
        const double m = double(measured.*figure.value);
        if (!std::isnan(w) && std::abs(w - m) > 0.1 * m + 1e-6) return figure.name;
    }
    return nullptr;
}

} // namespace

std::string place(const WorstTexel& at) {
    return (at.part > 0 ? "part " + std::to_string(at.part) + " " : "") + "layer " +
           std::to_string(at.layer) + " " + name(at.side) + ", texel (" + std::to_string(at.texel.x) + ", " +
           std::to_string(at.texel.y) + ")";
}

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
    const auto judge_color = [&](const char* kind, const char* what, const Distribution& difference,
                                 const std::optional<WorstTexel>& worst) {
        if (!(difference.mean > color_tolerance)) return;
        findings.push_back({kind,
                            std::string(what) + " off by " + number(difference.mean) +
                                " of 255 on average; the worst, " + place(*worst) + ", by " +
                                number(worst->value),
                            worst});
    };
    judge_color("color", "colours are", m.color_difference, m.worst_color);
    judge_color("alpha", "the coverage of colours is", m.alpha_difference, m.worst_alpha);
    if (const char* const name = lying_figure(part.errors, error_figures(m))) {
        findings.push_back(
            {"figures",
             std::string("the error figures in the file are not those measured, for one ") + name,
             {}});
    }
    return findings;
}

} // namespace spa::measure
