// SPDX-License-Identifier: Apache-2.0
#include "gltf_animation.h"

#include "gltf_check.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>

namespace spa::import::gltf {
namespace {

// The places of each node that animations move: not its instances, which stand still in it.
std::vector<std::vector<std::uint32_t>> places_of_nodes(std::size_t nodes, std::span<const Place> places) {
    std::vector<std::vector<std::uint32_t>> of_node(nodes);
    for (std::uint32_t i = 0; i < places.size(); ++i)
        if (places[i].kind != Place::Kind::instance) of_node[places[i].node].push_back(i);
    return of_node;
}

class AnimationReader {
public:
    AnimationReader(const tinygltf::Model& model, std::span<const Place> places, Buffers& buffers,
                    std::uint64_t most_bytes, const Context& context)
        : model_(model), buffers_(buffers), bytes_left_(most_bytes), context_(context),
          places_(places_of_nodes(model.nodes.size(), places)) {}

    Animation read(const Json& source, const std::string& where) {
        Animation animation;
        animation.name = source.value("name", std::string());
        track_of_.clear();
        const Json& channels = source["channels"];
        for (std::size_t i = 0; i < channels.size(); ++i)
            read_channel(source, channels[i], where, where + "." + at("channels", i), animation);
        for (const Track& track : animation.tracks)
            for (const Curve* curve : {&track.translations, &track.rotations, &track.scales})
                if (!curve->times.empty())
                    animation.seconds = std::max(animation.seconds, double(curve->times.back()));
        return animation;
    }

private:
    void read_channel(const Json& source, const Json& channel, const std::string& animation_place,
                      const std::string& where, Animation& animation) {
        const Json& target = channel["target"];
        const std::string& path = target["path"].get_ref<const std::string&>();
        if (path == "weights") {
            warn(context_, where, "moves the weights of morph targets, which keep their default values");
            return;
        }
        Curve Track::*const curve = path == "translation" ? &Track::translations
                                    : path == "rotation"  ? &Track::rotations
                                    : path == "scale"     ? &Track::scales
                                                          : nullptr;
        if (curve == nullptr || !target.contains("node")) {
            warn(context_, where, "does not move a node and is left out");
            return;
        }
        const std::uint64_t node = integer_of(target, "node");
        if (model_.nodes[node].matrix.size() == 16)
            fail(context_, where,
                 at("nodes", node) + " has a matrix; give it translation, rotation and scale");
        if (places_[node].empty()) return;
        const std::uint64_t sampler = integer_of(channel, "sampler");
        const Curve read = read_curve(source["samplers"][sampler], path == "rotation" ? 4 : 3,
                                      animation_place + "." + at("samplers", sampler), places_[node].size());
        for (const std::uint32_t place : places_[node]) {
            Curve& to = track(animation, place, node).*curve;
            if (!to.times.empty()) fail(context_, where, "moves what a channel before it moves: one must go");
            to = read;
        }
    }

    Track& track(Animation& animation, std::uint32_t place, std::uint64_t node) {
        const auto [found, is_new] = track_of_.try_emplace(place, animation.tracks.size());
        if (is_new) {
            const LocalParts parts = local_parts(model_.nodes[node]);
            animation.tracks.push_back(
                {place, parts.translation, parts.scale, parts.rotation, Curve{}, Curve{}, Curve{}});
        }
        return animation.tracks[found->second];
    }

    // Curves share their data, so that a small document could have it read again and again.
    void claim(std::uint64_t bytes, const std::string& where) {
        if (bytes > bytes_left_)
            fail(context_, where, "has more keys than the limit of bytes of the model leaves room for");
        bytes_left_ -= bytes;
    }

    Curve read_curve(const Json& sampler, std::size_t width, const std::string& where, std::uint64_t copies) {
        Curve curve;
        const std::string mode = sampler.value("interpolation", std::string("LINEAR"));
        if (mode == "STEP") curve.interpolation = Interpolation::step;
        if (mode == "CUBICSPLINE") curve.interpolation = Interpolation::cubic_spline;
        const std::size_t per_key = mode == "CUBICSPLINE" ? 3 : 1;
        const tinygltf::Accessor& input = model_.accessors[integer_of(sampler, "input")];
        const tinygltf::Accessor& output = model_.accessors[integer_of(sampler, "output")];
        if (input.type != TINYGLTF_TYPE_SCALAR || input.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT)
            fail(context_, where + ".input", "is not a SCALAR of floats");
        const bool is_float = output.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
        if (output.type != (width == 4 ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3) ||
            !(is_float || output.normalized))
            fail(context_, where + ".output",
                 std::string("is not a ") + (width == 4 ? "VEC4" : "VEC3") +
                     " of floats or normalized integers");
        if (output.count / per_key != input.count || output.count % per_key != 0)
            fail(context_, where + ".output",
                 "has " + std::to_string(output.count) + " elements for " + std::to_string(input.count) +
                     " times" + std::string(per_key == 3 ? ", of which each wants 3" : ""));
        claim((copies + 1) * sizeof(float) * (input.count + output.count * width), where);
        curve.times.resize(input.count);
        read_floats(input, buffers_, {}, 1, curve.times.data(), 1, context_);
        for (std::size_t i = 0; i < curve.times.size(); ++i)
            if (!std::isfinite(curve.times[i]) || (i > 0 && !(curve.times[i - 1] < curve.times[i])))
                fail(context_, where + ".input",
                     "has a time at position " + std::to_string(i) + " that is not finite or does not grow");
        curve.values.resize(output.count * width);
        read_floats(output, buffers_, {}, width, curve.values.data(), width, context_);
        const auto bad = std::find_if(curve.values.begin(), curve.values.end(),
                                      [](float value) { return !std::isfinite(value); });
        if (bad != curve.values.end())
            fail(context_, where + ".output",
                 "has a value at position " +
                     std::to_string(static_cast<std::size_t>(bad - curve.values.begin()) / width) +
                     " that is not finite");
        return curve;
    }

    const tinygltf::Model& model_;
    Buffers& buffers_;
    std::uint64_t bytes_left_;
    const Context& context_;
    std::vector<std::vector<std::uint32_t>> places_;          // by node
    std::unordered_map<std::uint32_t, std::size_t> track_of_; // by place, of one animation
};

} // namespace

std::vector<Animation> read_animations(const Json& document, const tinygltf::Model& model,
                                       std::span<const Place> places, Buffers& buffers,
                                       std::uint64_t most_bytes, const Context& context) {
    std::vector<Animation> animations;
    AnimationReader reader(model, places, buffers, most_bytes, context);
    const Json& sources = member_of(document, "animations");
    for (std::size_t i = 0; i < sources.size(); ++i)
        animations.push_back(reader.read(sources[i], at("animations", i)));
    return animations;
}

} // namespace spa::import::gltf
