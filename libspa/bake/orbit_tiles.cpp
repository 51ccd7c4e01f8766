// SPDX-License-Identifier: Apache-2.0
#include "orbit_tiles.h"

#include <algorithm>
#include <bit>

namespace spa::bake {
namespace {

// Uniform locations and texture units of shaders/orbit.vert and orbit.frag.
constexpr GLint tiles_per_row_location = 1, tile_rows_location = 2, back_tiles_location = 3,
                first_round_location = 4;
constexpr GLuint found_radius_unit = 1;

} // namespace

Tiles::Tiles(const GlFunctions& gl, std::uint32_t cameras, bool both_facings)
    : gl_(gl), cameras_(cameras), tiles_(both_facings ? 2 * cameras : cameras),
      width_(std::min(std::bit_ceil(tiles_), 1024U)), height_(std::bit_ceil((tiles_ + width_ - 1) / width_)) {
    const auto texture = [&](GLenum format) {
        return make_texture(gl, format, GLsizei(width_), GLsizei(height_), 1);
    };
    surface_ = texture(GL_RGBA32UI);
    normal_ = texture(GL_RGBA32UI);
    const std::array<const GlObject*, 2> colors{&surface_, &normal_};
    for (std::size_t i = 0; i < 2; ++i) {
        radius_[i] = texture(GL_DEPTH_COMPONENT32F);
        target_[i] = make_framebuffer(gl, colors, radius_[i]);
    }
    sampler_ = make_sampler(gl);
    gl.SamplerParameteri(sampler_.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl.SamplerParameteri(sampler_.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void Tiles::begin(const GlObject& program, std::uint32_t round) const {
    gl_.UseProgram(program.name());
    gl_.ProgramUniform1ui(program.name(), tiles_per_row_location, width_);
    gl_.ProgramUniform1ui(program.name(), tile_rows_location, height_);
    gl_.ProgramUniform1ui(program.name(), back_tiles_location, tiles_ - cameras_);
    gl_.ProgramUniform1ui(program.name(), first_round_location, round == 0 ? 1 : 0);
    gl_.BindTextureUnit(found_radius_unit, radius_[(round + 1) % 2].name());
    gl_.BindSampler(found_radius_unit, sampler_.name());

    const GLuint target = target_[round % 2].name();
    gl_.BindFramebuffer(GL_FRAMEBUFFER, target);
    gl_.Viewport(0, 0, GLsizei(width_), GLsizei(height_));
    constexpr GLfloat no_radius = 0;
    constexpr Pixel nothing{};
    gl_.ClearNamedFramebufferfv(target, GL_DEPTH, 0, &no_radius);
    gl_.ClearNamedFramebufferuiv(target, GL_COLOR, 0, nothing.data());
    gl_.ClearNamedFramebufferuiv(target, GL_COLOR, 1, nothing.data());
}

void Tiles::read(std::vector<Fragment>& fragments) const {
    const std::uint32_t rows = (tiles_ + width_ - 1) / width_;
    const auto pixels = [&](GLenum attachment) {
        std::vector<Pixel> image(std::size_t(width_) * rows);
        gl_.NamedFramebufferReadBuffer(target_[0].name(), attachment);
        gl_.ReadPixels(0, 0, GLsizei(width_), GLsizei(rows), GL_RGBA_INTEGER, GL_UNSIGNED_INT, image.data());
        return image;
    };
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, target_[0].name());
    const std::vector<Pixel> surface = pixels(GL_COLOR_ATTACHMENT0);
    const std::vector<Pixel> normal = pixels(GL_COLOR_ATTACHMENT1);
    for (std::uint32_t tile = 0; tile < tiles_; ++tile) {
        const Pixel& s = surface[tile];
        const Pixel& n = normal[tile];
        if (s[3] == 0) continue;
        Fragment fragment;
        fragment.camera = tile % cameras_;
        fragment.crossing.radius = std::bit_cast<float>(s[0]);
        fragment.crossing.triangle = s[1];
        for (unsigned i = 0; i < 4; ++i) fragment.crossing.color[i] = std::uint8_t(s[2] >> (8 * i));
        fragment.crossing.normal = {std::bit_cast<float>(n[0]), std::bit_cast<float>(n[1]),
                                    std::bit_cast<float>(n[2])};
        fragment.crossing.front_facing = n[3] == 0;
        fragments.push_back(fragment);
    }
}

} // namespace spa::bake
