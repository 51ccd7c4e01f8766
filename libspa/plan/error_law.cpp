// SPDX-License-Identifier: Apache-2.0
#include "error_law.h"

#include <algorithm>
#include <cmath>

namespace spa::plan {

ErrorLaw ErrorLaw::fit(std::span<const SizedValue> points) {
    ErrorLaw law;
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const SizedValue& point : points) {
        if (!(point.value > 0)) {
            law.zero_from_ = std::min(law.zero_from_, point.size);
            continue;
        }
        law.zero_from_ = 0xFFFFFFFFU; // a larger map is worse than nothing wrong: it was luck
        const double x = std::log(double(point.size)), y = std::log(point.value);
        n += 1;
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    if (n == 0) {
        law.zero_from_ = 0;
        return law;
    }
    const double spread = n * sxx - sx * sx;
    if (n > 1 && spread > 0) law.b_ = std::clamp(-(n * sxy - sx * sy) / spread, 0.0, 4.0);
    law.log_a_ = (sy + law.b_ * sx) / n;
    return law;
}

double ErrorLaw::at(std::uint32_t size) const {
    if (size >= zero_from_) return 0;
    return std::exp(log_a_ - b_ * std::log(double(size)));
}

BytesLaw BytesLaw::fit(std::span<const SizedValue> points) {
    BytesLaw law;
    const SizedValue& last = points.back();
    const double n = last.size;
    law.c2_ = last.value / (n * n);
    if (points.size() < 2) return law;
    const SizedValue& before = points[points.size() - 2];
    const double m = before.size;
    // c2 n^2 + c1 n = b(n), c2 m^2 + c1 m = b(m)
    const double c2 = (last.value / n - before.value / m) / (n - m);
    const double c1 = last.value / n - c2 * n;
    if (!(c2 > 0) || !(c1 > 0)) return law;
    law.c2_ = c2;
    law.c1_ = c1;
    return law;
}

std::uint64_t BytesLaw::at(std::uint32_t size) const {
    const double n = size;
    return std::uint64_t(std::llround(c2_ * n * n + c1_ * n));
}

} // namespace spa::plan
