// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: any bytes become a valid part, whatever the container allows, and rays of any bits;
// compiled and traced by every tracer. They must end, read nothing outside the image, agree with each other,
// and report hits without NaN and within the limits of t.
#include "../../libspa/core/cell_triangles.h"
#include "../../libspa/trace/fan.h"
#include "../../libspa/trace/march.h"
#include "../../libspa/trace/shade.h"
#include "../../libspa/trace/trace.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace {

using namespace spa;

void require(bool condition, const char* what) {
    if (condition) return;
    std::fprintf(stderr, "%s\n", what);
    std::abort();
}

// The input, zeros behind its end.
class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

    std::uint8_t byte() { return at_ < size_ ? data_[at_++] : std::uint8_t(0); }
    std::uint32_t below(std::uint32_t count) { return byte() % count; }
    std::uint32_t word() {
        std::uint32_t word = 0;
        for (int i = 0; i < 4; ++i) word = word << 8U | byte();
        return word;
    }
    // Any bits, or a number of the size of the map.
    float number() {
        const std::uint32_t bits = word();
        if ((bits & 1U) != 0) return std::bit_cast<float>(bits);
        return float(std::int32_t(bits)) * 0x1p-30F;
    }
    [[nodiscard]] bool left() const { return at_ < size_; }

private:
    const std::uint8_t* data_;
    std::size_t size_;
    std::size_t at_ = 0;
};

struct FuzzedPart {
    Part part;
    std::vector<std::unique_ptr<std::byte[]>> pixels;

    ImageView image(const Grid& grid, ElementFormat format) {
        const std::size_t bytes = std::size_t(grid.width) * grid.height * element_size(format);
        pixels.push_back(std::make_unique<std::byte[]>(bytes));
        return {{pixels.back().get(), bytes}, grid.width, grid.height, format};
    }
};

// Codes of the depths at one sample, outermost first, in the order that the container wants (SPA-502,
// SPA-503).
std::vector<std::uint32_t> depth_codes(Bytes& bytes, ElementFormat format, std::size_t surfaces,
                                       bool last_inner) {
    std::vector<std::uint32_t> codes(surfaces);
    const std::uint8_t kind = bytes.byte();
    for (std::uint32_t& code : codes) {
        code = bytes.word();
        if (format == ElementFormat::u8) code &= 0xFFU;
        if (format == ElementFormat::u16) code &= 0xFFFFU;
        // The patterns of floats in [0, 1], without those between 0 and 2^-126, are in order.
        if (format == ElementFormat::f32) {
            code %= 0x3F800001U;
            if (code < 0x00800000U) code = 0;
        }
    }
    std::sort(codes.rbegin(), codes.rend());
    // Some without surface, some to the centre, some of no thickness.
    const std::size_t kept = (kind & 1U) != 0 ? surfaces : kind / 2 % (surfaces + 1);
    std::fill(codes.begin() + std::ptrdiff_t(kept), codes.end(), 0);
    if ((kind & 0x80U) != 0 && surfaces > 1) codes[1] = codes[0];
    if (!last_inner) codes.push_back(0);
    // What is below an end that is missing is missing.
    for (std::size_t i = 1; i < codes.size(); ++i)
        if (codes[i - 1] == 0) codes[i] = 0;
    return codes;
}

void store(ElementFormat format, std::uint32_t code, std::byte* out) {
    std::memcpy(out, &code, element_size(format)); // little-endian machines alone are fuzzed
}

FuzzedPart make_part(Bytes& bytes) {
    FuzzedPart made;
    Part& part = made.part;
    part.mapping = bytes.below(4) == 0 ? Mapping::latlong : Mapping::octahedral;
    const std::uint32_t cells = 2 * (1 + bytes.below(8));
    const Grid grid = part.mapping == Mapping::octahedral
                          ? Grid{part.mapping, cells + 1, cells + 1}
                          : Grid{part.mapping, 1 + bytes.below(9), 1 + bytes.below(9)};
    const ElementFormat format =
        std::array{ElementFormat::u8, ElementFormat::u16, ElementFormat::f32}[bytes.below(3)];
    const ElementFormat normals =
        std::array{ElementFormat::oct8, ElementFormat::oct16, ElementFormat::rgb8}[bytes.below(3)];
    const std::size_t layers = 1 + bytes.below(3);
    const std::uint8_t images = bytes.byte();
    const bool last_inner = (images & 1U) != 0;
    part.center_inside = (images & 2U) != 0;
    const Grid other =
        part.mapping == Mapping::octahedral ? Grid{part.mapping, 5, 5} : Grid{part.mapping, 3, 2};
    for (std::size_t k = 0; k < layers; ++k) {
        Layer& layer = part.layers.emplace_back();
        layer.outer.depth = made.image(grid, format);
        layer.outer.normal = made.image((images & 4U) != 0 ? other : grid, normals);
        layer.outer.color = made.image(other, ElementFormat::rgba8);
        if (k + 1 == layers && !last_inner) break;
        layer.inner.depth = made.image(grid, format);
        if ((images & 8U) != 0) layer.inner.normal = made.image(grid, normals);
        if ((images & 16U) != 0) layer.inner.color = made.image(grid, ElementFormat::rgba8);
    }
    const std::size_t size = element_size(format);
    for (std::uint32_t y = 0; y < grid.height; ++y) {
        for (std::uint32_t x = 0; x < grid.width; ++x) {
            const TexelIndex same = canonical(grid, {x, y});
            const bool first = same == TexelIndex{x, y};
            std::vector<std::uint32_t> codes;
            if (first) codes = depth_codes(bytes, format, 2 * layers - (last_inner ? 0 : 1), last_inner);
            for (std::size_t i = 0; i < 2 * layers; ++i) {
                const Surface& surface = i % 2 == 0 ? part.layers[i / 2].outer : part.layers[i / 2].inner;
                if (surface.empty()) continue;
                auto* const out = const_cast<std::byte*>(surface.depth.at(x, y));
                if (first)
                    store(format, codes[i], out);
                else
                    std::copy_n(surface.depth.at(same.x, same.y), size, out);
            }
        }
    }
    for (Layer& layer : part.layers) {
        for (const ImageView* image :
             {&layer.outer.normal, &layer.inner.normal, &layer.outer.color, &layer.inner.color}) {
            for (const std::byte& element : image->bytes) {
                std::uint8_t code = bytes.byte();
                // The codes -128 and -32768 are not used (SPA-504).
                if (image->format == ElementFormat::oct8 || image->format == ElementFormat::oct16)
                    code = code == 0x80 ? 0x81 : code;
                const_cast<std::byte&>(element) = std::byte(code);
            }
        }
    }
    if (part.mapping == Mapping::octahedral && (images & 32U) != 0) {
        const auto count = std::size_t(mixed_bytes(cells));
        made.pixels.push_back(std::make_unique<std::byte[]>(count));
        for (std::size_t i = 0; i < count; ++i) made.pixels.back()[i] = std::byte(bytes.byte());
        part.mixed = {made.pixels.back().get(), count};
    }
    return made;
}

bool same(const trace::Hit& a, const trace::Hit& b) {
    const auto bits = [](float v) { return std::bit_cast<std::uint32_t>(v); };
    return bits(a.t) == bits(b.t) && bits(a.normal.x) == bits(b.normal.x) &&
           bits(a.normal.y) == bits(b.normal.y) && bits(a.normal.z) == bits(b.normal.z) &&
           bits(a.map.x) == bits(b.map.x) && bits(a.map.y) == bits(b.map.y) && a.layer == b.layer &&
           a.side == b.side && a.front == b.front;
}

void require_same(const trace::Ray& ray, std::uint32_t flags, const trace::Hit& single,
                  const trace::Hit& stream) {
    if (same(single, stream)) return;
    std::fprintf(stderr, "ray {%a, %a, %a}, %a, {%a, %a, %a}, %a, flags %u\n", double(ray.origin.x),
                 double(ray.origin.y), double(ray.origin.z), double(ray.t_min), double(ray.direction.x),
                 double(ray.direction.y), double(ray.direction.z), double(ray.t_max), flags);
    for (const trace::Hit* hit : {&single, &stream})
        std::fprintf(stderr, "  t %.9g side %u layer %u front %d normal %g %g %g map %g %g\n", double(hit->t),
                     unsigned(hit->side), hit->layer, int(hit->front), double(hit->normal.x),
                     double(hit->normal.y), double(hit->normal.z), double(hit->map.x), double(hit->map.y));
    require(false, "stream and single differ");
}

void check_hit(const trace::TraceMap& map, const trace::Ray& ray, const trace::Hit& hit) {
    if (!hit.valid()) return;
    require(std::isfinite(hit.t), "t is not finite");
    require(hit.t >= ray.t_min && hit.t <= ray.t_max, "t is outside its limits");
    require(is_finite(hit.normal), "the normal is not finite");
    require(hit.map.x >= 0 && hit.map.x <= 1 && hit.map.y >= 0 && hit.map.y <= 1, "outside the map");
    const trace::Shade shade = trace::shade(map, hit);
    require(is_finite(shade.color) && is_finite(shade.normal) && shade.coverage >= 0 && shade.coverage <= 1,
            "the shade is not finite");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    const FuzzedPart made = make_part(bytes);
    trace::CompileOptions options;
    options.layers = bytes.below(4);
    options.images = bytes.below(4) != 0;
    const trace::TraceMap map(made.part, options);
    std::vector<trace::Ray> rays;
    while (rays.size() < 40 && (bytes.left() || rays.empty())) {
        trace::Ray ray;
        for (float* const member : {&ray.origin.x, &ray.origin.y, &ray.origin.z, &ray.direction.x,
                                    &ray.direction.y, &ray.direction.z})
            *member = bytes.number();
        const std::uint8_t limits = bytes.byte();
        if ((limits & 1U) != 0) ray.t_min = bytes.number();
        if ((limits & 2U) != 0) ray.t_max = bytes.number();
        rays.push_back(ray);
    }
    shader::SpaFan fan{bytes.byte(),   bytes.below(3), bytes.below(3), bytes.below(4), bytes.below(3),
                       bytes.below(3), bytes.below(4), bytes.below(3), bytes.below(3), bytes.below(3)};
    const shader::SpaMarch march{bytes.byte(), bytes.below(16)};
    for (const std::uint32_t flags :
         {0U, std::uint32_t(trace::cull_back), std::uint32_t(trace::cull_front)}) {
        std::vector<trace::Hit> hits(rays.size());
        std::vector<std::uint8_t> blocked(rays.size());
        trace::closest_hits(map, rays, flags, hits);
        trace::occluded(map, rays, flags, blocked);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            trace::Hit hit;
            require(trace::closest_hit(map, rays[i], flags, hit) == hit.valid(), "found and valid differ");
            check_hit(map, rays[i], hit);
            require_same(rays[i], flags, hit, hits[i]);
            require((blocked[i] != 0) == hit.valid(), "occlusion of streams differs");
            require(trace::occluded(map, rays[i], flags) == hit.valid(), "occlusion differs");
            trace::fan_hit(map, rays[i], fan, flags, hit);
            check_hit(map, rays[i], hit);
            trace::march_hit(map, rays[i], march, flags, hit);
            check_hit(map, rays[i], hit);
        }
    }
    return 0;
}
