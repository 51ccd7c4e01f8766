// SPDX-License-Identifier: Apache-2.0
#include "render_pictures.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace spa::tools {

namespace {

// Of Frame::kind: nothing, a triangle, and a map's outer ends, inner ends and walls.
constexpr Rgb kind_colors[] = {{0, 0, 0}, {110, 110, 118}, {68, 170, 153}, {136, 120, 220}, {221, 170, 51}};

Picture normal_picture(const render::Frame& frame) {
    Picture picture(frame.width, frame.height, {});
    const auto code = [](float value) {
        return std::uint8_t(std::lround(std::clamp(value * 0.5F + 0.5F, 0.0F, 1.0F) * 255));
    };
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        if (frame.kind[i] != 0)
            picture.pixels[i] = {code(frame.normal[i].x), code(frame.normal[i].y), code(frame.normal[i].z)};
    return picture;
}

// Near is bright, far is dark, and never as dark as nothing.
Picture depth_picture(const render::Frame& frame) {
    float low = std::numeric_limits<float>::infinity(), high = 0;
    for (const float depth : frame.depth)
        if (std::isfinite(depth)) {
            low = std::min(low, depth);
            high = std::max(high, depth);
        }
    Picture picture(frame.width, frame.height, {});
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        if (!std::isfinite(frame.depth[i])) continue;
        const float share = high > low ? (frame.depth[i] - low) / (high - low) : 0;
        const auto grey = std::uint8_t(std::lround(255 - 215 * share));
        picture.pixels[i] = {grey, grey, grey};
    }
    return picture;
}

Picture kind_picture(const render::Frame& frame) {
    Picture picture(frame.width, frame.height, {});
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        picture.pixels[i] = kind_colors[std::min<std::size_t>(frame.kind[i], std::size(kind_colors) - 1)];
    return picture;
}

} // namespace

std::vector<Vec3f> beauty(const render::Frame& frame) {
    std::vector<Vec3f> sum(frame.direct.size());
    std::transform(frame.direct.begin(), frame.direct.end(), frame.indirect.begin(), sum.begin(),
                   [](Vec3f direct, Vec3f indirect) { return direct + indirect; });
    return sum;
}

std::vector<std::byte> encode_frame(const render::Frame& frame) {
    const std::vector<Vec3f> sum = beauty(frame);
    const std::vector<float> kind(frame.kind.begin(), frame.kind.end());
    const std::size_t pixels = sum.size();
    std::vector<ExrChannel> channels;
    const auto add = [&](const std::string& layer, const char(&names)[4], const std::vector<Vec3f>& values) {
        static_assert(sizeof(Vec3f) == 3 * sizeof(float));
        for (std::size_t c = 0; c < 3; ++c)
            channels.push_back({layer + names[c], {&values.front().x + c, 3 * pixels - c}, 3});
    };
    add("", "RGB", sum);
    add("direct.", "RGB", frame.direct);
    add("indirect.", "RGB", frame.indirect);
    add("normal.", "XYZ", frame.normal);
    add("albedo.", "RGB", frame.albedo);
    channels.push_back({"depth.Z", frame.depth});
    channels.push_back({"kind", kind});
    return encode_exr(frame.width, frame.height, channels);
}

std::vector<NamedPicture> aov_pictures(const render::Frame& frame, double exposure) {
    const auto shown = [&](const std::vector<Vec3f>& light) {
        return tone_map(frame.width, frame.height, light, exposure);
    };
    std::vector<Picture> in_order{shown(frame.direct), shown(frame.indirect), normal_picture(frame),
                                  depth_picture(frame), kind_picture(frame)};
    std::vector<NamedPicture> pictures;
    for (std::size_t i = 0; i < in_order.size(); ++i)
        pictures.push_back({aov_names[i], std::move(in_order[i])});
    return pictures;
}

std::filesystem::path beside(const std::filesystem::path& path, const std::string& name) {
    std::filesystem::path result = path;
    return result.replace_extension("." + name + path.extension().string());
}

} // namespace spa::tools
