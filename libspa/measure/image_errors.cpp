// SPDX-License-Identifier: Apache-2.0
#include "image_errors.h"

#include "../core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace spa::measure {

namespace {

std::string size_of(const ImageRef& image) {
    return std::to_string(image.width) + " x " + std::to_string(image.height);
}

void require_finite(const ImageRef& image, const char* which) {
    const std::uint64_t count = non_finite_pixels(image);
    if (count != 0)
        throw Error(ExitCode::invalid_data, std::string(which) + " has " + std::to_string(count) +
                                                (count == 1 ? " pixel that is" : " pixels that are") +
                                                " NaN or infinite, and no figure can be formed with " +
                                                (count == 1 ? "it" : "them"));
}

void check(const ImageRef& picture, const ImageRef& reference) {
    if (picture.width != reference.width || picture.height != reference.height)
        throw Error(ExitCode::invalid_data, "the picture has " + size_of(picture) +
                                                " pixels and the reference " + size_of(reference) +
                                                "; only pictures of one size can be compared");
    if (picture.pixels.empty()) throw Error(ExitCode::invalid_data, "the pictures have no pixels");
    require_finite(picture, "the picture");
    require_finite(reference, "the reference");
}

std::array<double, 3> channels(Vec3f pixel) { return {double(pixel.x), double(pixel.y), double(pixel.z)}; }

std::array<double, 3> displayed(Vec3f pixel, double exposure) {
    std::array<double, 3> values = channels(pixel);
    for (double& value : values) value = display_value(value, exposure);
    return values;
}

// Of the values that a display is sent, with the weights of ITU-R BT.709.
double luma(const std::array<double, 3>& rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

// Compensated (Kahan 1965), so that the figure does not depend on how many pixels there are.
class Sum {
public:
    void add(double value) {
        const double corrected = value - lost_;
        const double next = sum_ + corrected;
        lost_ = (next - sum_) - corrected;
        sum_ = next;
    }
    [[nodiscard]] double value() const { return sum_; }

private:
    double sum_ = 0, lost_ = 0;
};

} // namespace

std::uint64_t non_finite_pixels(const ImageRef& picture) {
    return std::uint64_t(std::count_if(picture.pixels.begin(), picture.pixels.end(),
                                       [](Vec3f pixel) { return !is_finite(pixel); }));
}

double display_value(double linear, double exposure) {
    const double value = std::clamp(linear * std::exp2(exposure), 0.0, 1.0);
    if (value == 1) return 1; // the formula rounds
    return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

ImageErrors image_errors(const ImageRef& picture, const ImageRef& reference,
                         const ImageErrorOptions& options) {
    check(picture, reference);
    const std::size_t pixels = picture.pixels.size();
    Sum squares, relative, displayed_squares;
    std::vector<double> luma_picture(pixels), luma_reference(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::array<double, 3> x = channels(picture.pixels[i]), ref = channels(reference.pixels[i]);
        const std::array<double, 3> shown_x = displayed(picture.pixels[i], options.exposure);
        const std::array<double, 3> shown_ref = displayed(reference.pixels[i], options.exposure);
        for (std::size_t c = 0; c < 3; ++c) {
            const double square = (x[c] - ref[c]) * (x[c] - ref[c]);
            squares.add(square);
            relative.add(square / (ref[c] * ref[c] + options.epsilon));
            displayed_squares.add((shown_x[c] - shown_ref[c]) * (shown_x[c] - shown_ref[c]));
        }
        luma_picture[i] = luma(shown_x);
        luma_reference[i] = luma(shown_ref);
    }
    const double samples = 3 * double(pixels);
    ImageErrors errors;
    errors.pixels = pixels;
    errors.mse = squares.value() / samples;
    errors.rmse = std::sqrt(errors.mse);
    errors.rel_mse = relative.value() / samples;
    const double displayed_mse = displayed_squares.value() / samples;
    errors.psnr = -10 * std::log10(displayed_mse); // infinity for 0
    errors.ssim = structural_similarity(picture.width, picture.height, luma_picture, luma_reference);
    return errors;
}

} // namespace spa::measure
