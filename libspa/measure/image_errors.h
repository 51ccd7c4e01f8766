// SPDX-License-Identifier: Apache-2.0
// How far a rendered picture is from a reference: figures over all pixels. Pictures are linear RGB.
// What the figures are good for: ../../docs/measures.md, "Pictures".
#pragma once

#include "../core/vector.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace spa::measure {

// A picture of somebody else's: width * height pixels, row by row.
struct ImageRef {
    std::uint32_t width = 0, height = 0;
    std::span<const Vec3f> pixels;
};

struct ImageErrorOptions {
    // Added to the square of the reference in rel_mse, so that black pixels do not divide by zero. In units
    // of radiance squared: below a radiance of 0.1 the error counts more and more as it is, not as a share.
    double epsilon = 1e-2;
    double exposure = 0; // stops; of the pictures as they are looked at (psnr, ssim)
};

struct ImageErrors {
    std::uint64_t pixels = 0;
    // Of linear values, over pixels and channels:
    double mse = 0;     // mean of (x - ref)^2
    double rmse = 0;    // its root
    double rel_mse = 0; // mean of (x - ref)^2 / (ref^2 + epsilon)
    // Of the pictures as they are looked at, display_value():
    double psnr = 0; // decibels, over pixels and channels; infinity for equal pictures
    std::optional<double>
        ssim; // mean over all places of the window; none if the pictures are smaller than it
};

// Side of the window of SSIM, pixels.
inline constexpr std::uint32_t ssim_window = 11;

// The error of a picture. Deterministic; O(pixels), some 16 bytes of memory a pixel. Throws
// Error{invalid_data} if the sizes differ, if there are no pixels, or if a value of either is not finite: it
// says how many pixels of which are.
ImageErrors image_errors(const ImageRef& picture, const ImageRef& reference,
                         const ImageErrorOptions& options = {});

// Pixels with a value that is NaN or infinite.
std::uint64_t non_finite_pixels(const ImageRef& picture);

// A linear value as a display shows it: times 2^exposure, clamped to [0,1], sRGB transfer. In [0,1].
double display_value(double linear, double exposure);

// Mean structural similarity (Wang, Bovik, Sheikh, Simoncelli, 2004) of two pictures of one channel with
// values in [0,1]: a Gaussian window of 11x11 pixels, sigma 1.5, at every place where it lies in the picture
// as a whole; C1 = 0.01^2, C2 = 0.03^2. 1 for equal pictures; symmetric. None if width or height is below
// ssim_window.
std::optional<double> structural_similarity(std::uint32_t width, std::uint32_t height,
                                            std::span<const double> a, std::span<const double> b);

} // namespace spa::measure
