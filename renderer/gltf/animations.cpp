#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/base/printable.h"
#include "renderer/gltf/rig.h"

namespace si::gltf {
namespace {

const Json* array_of(const Json& object, const char* key) {
    const Json* const value = member(&object, key);
    return value && value->is_array() ? value : nullptr;
}

class Reader {
public:
    Reader(const tinygltf::Model& model, Accessors& accessors, const std::vector<int>& scene_node)
        : model_(model), accessors_(accessors), scene_node_(scene_node) {}

    /// Returns the channels of the last animation that target a JSON pointer (KHR_animation_pointer); these are left
    /// out.
    std::size_t pointers() const { return pointers_; }

    /// Reads the channels of an animation. Returns the reason when one of them is invalid, else an empty text.
    std::string read(const Json& json, const Place& place, Animation& out) {
        const Json *channels = array_of(json, "channels"), *samplers = array_of(json, "samplers");
        pointers_ = 0;
        if (!channels || !samplers || channels->empty()) return "has no channels or no samplers";
        for (const Json& channel : *channels) {
            const std::string broken = read_channel(channel, *samplers, place, out);
            if (!broken.empty()) return broken;
        }
        return "";
    }

private:
    std::string read_channel(const Json& json, const Json& samplers, const Place& place, Animation& out) {
        const auto sampler = index_member(json, "sampler", samplers.size());
        if (!sampler) return "a channel has no valid sampler";
        const auto target = json.find("target");
        if (target == json.end() || !target->is_object()) return "a channel has no target";
        if (extension_of(*target, "KHR_animation_pointer")) {
            ++pointers_;
            return "";
        }
        if (!target->contains("node")) return "";  // targets of other extensions are ignored
        const auto node = index_member(*target, "node", model_.nodes.size());
        if (!node) return "a channel's node does not exist";
        AnimationChannel channel;
        if (!set_property(text_member(*target, "path"), *node, channel)) return "";
        const std::string broken = read_sampler(samplers[*sampler], place, channel);
        if (!broken.empty()) return broken;
        channel.node = scene_node_[*node];
        // Channels for nodes of other scenes, nodes with a matrix, and weights without morph targets are ignored.
        if (channel.node < 0 || channel.width == 0) return "";
        if (channel.property != AnimatedProperty::Weights && model_.nodes[*node].matrix.size() == 16) return "";
        out.duration_s = std::max(out.duration_s, static_cast<double>(channel.times_s.back()));
        out.channels.push_back(std::move(channel));
        return "";
    }

    bool set_property(const std::string& path, std::size_t node, AnimationChannel& channel) const {
        static constexpr std::string_view kPaths[] = {"translation", "rotation", "scale", "weights"};
        const auto found = std::ranges::find(kPaths, path);
        if (found == std::end(kPaths)) return false;
        channel.property = AnimatedProperty(found - kPaths);
        channel.width = path == "rotation" ? 4 : path == "weights" ? target_count(model_, model_.nodes[node].mesh) : 3;
        return true;
    }

    std::string read_sampler(const Json& json, const Place& place, AnimationChannel& channel) {
        const auto input = index_member(json, "input", model_.accessors.size());
        const auto output = index_member(json, "output", model_.accessors.size());
        if (!input || !output) return "a sampler has no valid input or output";
        const std::string interpolation = text_member(json, "interpolation");
        if (interpolation == "STEP")
            channel.interpolation = Interpolation::Step;
        else if (interpolation == "CUBICSPLINE")
            channel.interpolation = Interpolation::Cubic;
        else if (!interpolation.empty() && interpolation != "LINEAR")
            return "a sampler's interpolation is unknown";

        const int in = int(*input), out = int(*output);
        const int element = channel.property == AnimatedProperty::Weights ? 1 : int(channel.width);
        if (accessors_.width(in) != 1 || accessors_.width(out) != element)
            return "a sampler's accessors have wrong types";
        const std::size_t keys = accessors_.count(in), parts = channel.interpolation == Interpolation::Cubic ? 3 : 1;
        if (channel.width > 0 && accessors_.count(out) * std::size_t(element) != keys * parts * channel.width) {
            return "a sampler's output does not fit its input";
        }
        channel.times_s = accessors_.numbers(in, place, 1);
        const auto& t = channel.times_s;
        for (std::size_t i = 0; i < t.size(); ++i) {
            if (!std::isfinite(t[i]) || t[i] < 0 || (i > 0 && !(t[i] > t[i - 1])))
                return "a sampler's times do not rise";
        }
        channel.values = accessors_.numbers(out, place, element);
        const bool finite =
            std::all_of(channel.values.begin(), channel.values.end(), [](float v) { return std::abs(v) <= 1e18f; });
        return finite ? "" : "a sampler's values are not finite";
    }

    const tinygltf::Model& model_;
    Accessors& accessors_;
    const std::vector<int>& scene_node_;
    std::size_t pointers_ = 0;
};

}  // namespace

std::vector<Animation> read_animations(Context& context, const Json& root, const tinygltf::Model& model,
                                       Accessors& accessors, const std::vector<int>& scene_node) {
    std::vector<Animation> out;
    const auto all = root.find("animations");
    if (all == root.end()) return out;
    Reader reader(model, accessors, scene_node);
    for (std::size_t i = 0; i < all->size(); ++i) {
        const Place place("animations", i);
        Animation animation;
        animation.name = printable(text_member((*all)[i], "name"));
        if (animation.name.empty()) animation.name = fmt::format("animation {}", i);
        const std::string broken = reader.read((*all)[i], place, animation);
        if (reader.pointers() > 0) {
            context.warn(place,
                         fmt::format("{} of its channels need KHR_animation_pointer, which is not supported; they "
                                     "are left out",
                                     reader.pointers()));
        }
        if (!broken.empty()) {
            context.warn(place, broken + "; left out");
        } else if (!animation.channels.empty()) {
            out.push_back(std::move(animation));
        }
    }
    return out;
}

}  // namespace si::gltf
