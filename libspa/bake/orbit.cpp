// SPDX-License-Identifier: Apache-2.0
#include "orbit.h"

#include "orbit_batches.h"
#include "orbit_naive.h"
#include "orbit_tiles.h"
#include "order_crossings.h"
#include <orbit_shaders.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace spa::bake {
namespace {

// Views in flight at once: bounds the tiles to 40 MB.
constexpr std::uint32_t most_views = 1U << 19;

// Binding points and uniform locations of shaders/orbit_common.glsl, orbit.vert and orbit.frag.
constexpr GLuint camera_binding = 1, material_binding = 3;
constexpr GLint first_camera_location = 0;

class Orbit {
public:
    Orbit(const GlFunctions& gl, const CenteredModel& model, const Grid& grid, bool naive,
          const CastOptions& options)
        : gl_(gl), errors_(gl), model_(model), grid_(grid), naive_(naive), options_(options),
          materials_(gl, *model.model), vertex_array_(make_vertex_array(gl)), program_(build(gl, naive)) {
        gl.BindVertexArray(vertex_array_.name());
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, material_binding, materials_.buffer().name());
        gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        gl.Enable(GL_DEPTH_TEST);
        gl.DepthFunc(GL_GREATER);
        gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
        for (unsigned i = 0; i < 4; ++i) gl.Enable(GL_CLIP_DISTANCE0 + i);
        errors_.check("setting up the orbit baker");
    }
    ~Orbit() {
        for (unsigned i = 0; i < 4; ++i) gl_.Disable(GL_CLIP_DISTANCE0 + i);
        gl_.Disable(GL_DEPTH_TEST);
        gl_.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
        gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
        gl_.BindVertexArray(0);
        gl_.UseProgram(0);
    }
    Orbit(const Orbit&) = delete;
    Orbit& operator=(const Orbit&) = delete;

    // The crossings of all canonical samples; Fragment::camera is the sample's row-major index.
    std::vector<Fragment> cast() {
        const std::uint32_t rows = std::max(1U, most_views / grid_.width);
        const std::uint32_t bands = (grid_.height + rows - 1) / rows;
        if (naive_) {
            const WholeModel whole(gl_, model_, materials_);
            const Tiles tiles(gl_, 1, !options_.outermost_only);
            for (std::uint32_t b = 0; b < bands; ++b) {
                cast_naive(b * rows, std::min(rows, grid_.height - b * rows), whole, tiles);
            }
            return std::move(fragments_);
        }
        Batches batches(gl_, model_, materials_, options_.threads);
        const Tiles tiles(gl_, std::min(rows, grid_.height) * grid_.width, !options_.outermost_only);
        for (std::uint32_t b = 0; b < bands; ++b) {
            share_begin_ = double(b) / bands;
            share_size_ = 1.0 / bands;
            cast_band(b * rows, std::min(rows, grid_.height - b * rows), batches, tiles);
        }
        return std::move(fragments_);
    }

private:
    static GlObject build(const GlFunctions& gl, bool naive) {
        const std::string head =
            std::string("#version 450 core\n") + (naive ? "#define NAIVE\n" : "") + orbit_common_source;
        return make_program(gl, head + orbit_vertex_source, head + orbit_fragment_source);
    }

    void report(double share) const {
        if (options_.progress && !options_.progress(share)) throw Cancelled{};
    }

    // Draws until no view finds a crossing any more. draw(round) draws all that may be seen; next(first) is
    // told where the fragments of the round begin.
    template <class Draw, class Next>
    void peel(const Tiles& tiles, std::uint32_t first_camera, const Draw& draw, const Next& next) {
        gl_.ProgramUniform1ui(program_.name(), first_camera_location, first_camera);
        for (std::uint32_t round = 0;; ++round) {
            const std::size_t first = fragments_.size();
            tiles.begin(program_, round);
            draw(round);
            tiles.read(fragments_);
            errors_.check("drawing views");
            if (options_.outermost_only || fragments_.size() == first) return;
            next(first);
        }
    }

    struct Band {
        std::vector<Vec3f> directions;
        std::vector<std::uint8_t> wanted;
        GlObject cameras;
    };

    Band make_band(std::uint32_t y0, std::uint32_t rows) const {
        Band band;
        std::vector<GpuCamera> cameras;
        for (std::uint32_t y = y0; y < y0 + rows; ++y) {
            for (std::uint32_t x = 0; x < grid_.width; ++x) {
                cameras.push_back(make_camera(grid_, {x, y}));
                band.directions.push_back(to_float(normalize(sample_direction(grid_, {x, y}))));
                // Identified samples get copies, so that they are equal to the bit.
                const bool own = canonical(grid_, {x, y}) == TexelIndex{x, y};
                band.wanted.push_back(own ? want_front | want_back : 0);
            }
        }
        band.cameras = make_buffer(gl_, std::as_bytes(std::span(cameras)));
        return band;
    }

    void cast_band(std::uint32_t y0, std::uint32_t rows, Batches& batches, const Tiles& tiles) {
        Band band = make_band(y0, rows);
        gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, camera_binding, band.cameras.name());
        ViewTree tree(std::move(band.directions), grid_.width, rows);
        tree.set_wanted(band.wanted);
        std::vector<Reached> reached(band.wanted.size());
        batches.begin(tree, reached);
        const std::size_t begin = fragments_.size();
        const auto draw = [&](std::uint32_t round) {
            batches.draw([&](double share) {
                // How many rounds will follow is unknown: each fills half of what is left.
                const double done = options_.outermost_only ? share : 1 - std::pow(0.5, round + share);
                report(share_begin_ + share_size_ * done);
            });
        };
        const auto next = [&](std::size_t first) {
            std::fill(band.wanted.begin(), band.wanted.end(), std::uint8_t(0));
            for (std::size_t i = first; i < fragments_.size(); ++i) {
                const auto& [view, crossing] = fragments_[i];
                band.wanted[view] |= crossing.front_facing ? want_front : want_back;
                (crossing.front_facing ? reached[view].front : reached[view].back) = crossing.radius;
            }
            tree.set_wanted(band.wanted);
            batches.plan();
        };
        peel(tiles, 0, draw, next);
        for (std::size_t i = begin; i < fragments_.size(); ++i) fragments_[i].camera += y0 * grid_.width;
    }

    void cast_naive(std::uint32_t y0, std::uint32_t rows, const WholeModel& whole, const Tiles& tiles) {
        const Band band = make_band(y0, rows);
        gl_.BindBufferBase(GL_SHADER_STORAGE_BUFFER, camera_binding, band.cameras.name());
        const auto draw = [&](std::uint32_t) { whole.draw(); };
        for (std::uint32_t view = 0; view < std::uint32_t(band.wanted.size()); ++view) {
            if (band.wanted[view] == 0) continue;
            const std::size_t begin = fragments_.size();
            peel(tiles, view, draw, [](std::size_t) {});
            const std::uint32_t sample = y0 * grid_.width + view;
            for (std::size_t i = begin; i < fragments_.size(); ++i) fragments_[i].camera = sample;
            report(double(sample + 1) / (double(grid_.width) * grid_.height));
        }
    }

    const GlFunctions& gl_;
    GlErrors errors_;
    const CenteredModel& model_;
    const Grid& grid_;
    bool naive_;
    const CastOptions& options_;
    MaterialTable materials_;
    GlObject vertex_array_;
    GlObject program_;
    std::vector<Fragment> fragments_;
    double share_begin_ = 0, share_size_ = 1;
};

// Sorts fragments by sample, outermost first, and gives identified samples copies.
CrossingGrid to_grid(const Grid& grid, const std::vector<Fragment>& fragments) {
    const std::size_t samples = std::size_t(grid.width) * grid.height;
    std::vector<std::uint64_t> first(samples + 1, 0);
    for (const Fragment& f : fragments) ++first[f.camera + 1];
    for (std::size_t i = 0; i < samples; ++i) first[i + 1] += first[i];
    std::vector<Crossing> sorted(fragments.size());
    std::vector<std::uint64_t> end(first.begin(), first.end() - 1);
    for (const Fragment& f : fragments) sorted[end[f.camera]++] = f.crossing;
    for (std::size_t i = 0; i < samples; ++i) {
        end[i] =
            std::uint64_t(order_crossings(sorted.data() + first[i], sorted.data() + end[i]) - sorted.data());
    }

    CrossingGrid result;
    result.grid = grid;
    result.first.reserve(samples + 1);
    result.crossings.reserve(fragments.size());
    for (std::uint32_t y = 0; y < grid.height; ++y) {
        for (std::uint32_t x = 0; x < grid.width; ++x) {
            const TexelIndex source = canonical(grid, {x, y});
            const std::size_t i = std::size_t(source.y) * grid.width + source.x;
            result.first.push_back(result.crossings.size());
            result.crossings.insert(result.crossings.end(), sorted.begin() + std::ptrdiff_t(first[i]),
                                    sorted.begin() + std::ptrdiff_t(end[i]));
        }
    }
    result.first.push_back(result.crossings.size());
    return result;
}

} // namespace

CrossingGrid cast_orbit(const GlContext& context, const CenteredModel& model, const Grid& grid, bool naive,
                        const CastOptions& options) {
    return to_grid(grid, Orbit(context.functions(), model, grid, naive, options).cast());
}

} // namespace spa::bake
