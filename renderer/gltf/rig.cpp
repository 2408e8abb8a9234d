#include "renderer/gltf/rig.h"

#include <fmt/format.h>

#include <cmath>

namespace si::gltf {
namespace {

constexpr std::size_t kMostDeformedVertices = std::size_t{1} << 24;

class Builder {
public:
    Builder(Context& context, const tinygltf::Model& model, Accessors& accessors, Primitives& primitives,
            const PlacedNodes& placed, Scene& scene)
        : context_(context),
          model_(model),
          accessors_(accessors),
          primitives_(primitives),
          placed_(placed),
          scene_(scene) {}

    /// Adds the deformed meshes and objects of glTF node `node`.
    void add(int node) {
        const tinygltf::Node& from = model_.nodes[std::size_t(node)];
        const tinygltf::Mesh& mesh = model_.meshes[std::size_t(from.mesh)];
        const int scene_node = placed_.scene_node[std::size_t(node)];
        const auto skin = from.skin >= 0 ? skin_of(from.skin) : nullptr;
        int placement = -1;
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            Part part = part_of(from.mesh, i, skin.get(), from.skin);
            if (!part.source) continue;
            vertices_ += part.source->positions.size();
            if (vertices_ > kMostDeformedVertices) {
                context_.fail(Place("nodes", node),
                              fmt::format("the scene would deform more than {} vertices", kMostDeformedVertices),
                              "use fewer copies of deformed meshes");
            }
            auto deformer = std::make_shared<Deformer>();
            deformer->source = part.source;
            deformer->node = scene_node;
            if (skin && part.source->influence_sets > 0) {
                if (placement < 0) placement = add_placement(scene_node);
                deformer->skin = skin;
                deformer->placement = placement;
            }
            Object object;
            object.node = deformer->skin ? placement : scene_node;
            object.mesh = int(scene_.meshes.size());
            Mesh made = part.mesh;
            made.deformer = std::move(deformer);
            scene_.meshes.push_back(std::move(made));
            scene_.objects.push_back(object);
        }
    }

private:
    struct Part {
        Mesh mesh;
        std::shared_ptr<const DeformSource> source;  ///< null: nothing to draw
    };

    /// Adds a root node for a skinned object, as its own node's transform must not move it (glTF 2.0, section 3.7.3.3).
    int add_placement(int scene_node) {
        Node node;
        node.name = scene_.nodes[std::size_t(scene_node)].name + " (skinned)";
        scene_.nodes.push_back(std::move(node));
        return int(scene_.nodes.size()) - 1;
    }

    std::shared_ptr<const Skin> skin_of(int skin) {
        if (const auto it = skins_.find(skin); it != skins_.end()) return it->second;
        auto& out = skins_[skin];
        const tinygltf::Skin& from = model_.skins[std::size_t(skin)];
        const Place place("skins", skin);
        auto made = std::make_shared<Skin>();
        for (const int joint : from.joints) {
            made->joints.push_back(placed_.scene_node[std::size_t(joint)]);
            if (made->joints.back() < 0) {
                context_.warn(
                    place,
                    fmt::format("joint node {} is not in this scene; its meshes are drawn without the skin", joint));
                return out = nullptr;
            }
        }
        made->inverse_bind.assign(made->joints.size(), glm::dmat4(1.0));
        if (from.inverseBindMatrices >= 0) {
            const auto matrices = accessors_.matrices(from.inverseBindMatrices, Place(place, "inverseBindMatrices"));
            for (std::size_t i = 0; i < made->joints.size(); ++i) made->inverse_bind[i] = glm::dmat4(matrices[i]);
        }
        return out = std::move(made);
    }

    const Part& part_of(int mesh, std::size_t primitive_index, const Skin* skin, int skin_index) {
        const auto key = std::tuple(mesh, primitive_index, skin ? skin_index : -1);
        if (const auto it = parts_.find(key); it != parts_.end()) return it->second;
        Part& out = parts_[key];
        const tinygltf::Mesh& from = model_.meshes[std::size_t(mesh)];
        const tinygltf::Primitive& primitive = from.primitives[primitive_index];
        const Place mesh_place("meshes", mesh);
        const Place place(mesh_place, "primitives", primitive_index);
        std::vector<std::uint32_t> pick;
        auto made = primitives_.make(primitive, place, from.name, pick);
        if (!made) return out;
        if (made->normals.empty()) {  // a flat normal needs three vertices of the triangle's own
            std::vector<std::uint32_t> corners = made->indices;
            if (!pick.empty())
                for (std::uint32_t& corner : corners) corner = pick[corner];
            pick = std::move(corners);
            split_vertices(*made);
        }
        auto source = std::make_shared<DeformSource>();
        source->positions = made->positions.all();
        source->normals = made->normals.all();
        source->tangents = made->tangents.all();
        source->indices = made->indices;
        for (std::size_t t = 0; t < primitive.targets.size(); ++t) {
            source->targets.push_back(read_target(primitive, Place(place, "targets", t), t, pick));
        }
        if (skin) read_influences(primitive, place, pick, skin->joints.size(), *source);
        out.mesh = std::move(*made);
        out.source = std::move(source);
        return out;
    }

    DeformSource::Target read_target(const tinygltf::Primitive& primitive, const Place& place, std::size_t index,
                                     std::span<const std::uint32_t> pick) {
        const std::size_t vertices = accessors_.count(primitive.attributes.at("POSITION"));
        const auto read = [&](const char* name) -> std::vector<glm::vec3> {
            const auto it = primitive.targets[index].find(name);
            if (it == primitive.targets[index].end()) return {};
            const Place here(place, name);
            if (accessors_.count(it->second) != vertices) {
                context_.fail(here, fmt::format("accessor {} has {} elements, POSITION has {}", it->second,
                                                accessors_.count(it->second), vertices));
            }
            return accessors_.floats<3>(it->second, here, pick);
        };
        return {read("POSITION"), read("NORMAL"), read("TANGENT")};
    }

    void read_influences(const tinygltf::Primitive& primitive, const Place& place, std::span<const std::uint32_t> pick,
                         std::size_t joint_count, DeformSource& source) {
        std::vector<std::vector<glm::vec4>> joints, weights;
        for (int set = 0; set < 4; ++set) {
            const auto j = primitive.attributes.find(fmt::format("JOINTS_{}", set));
            const auto w = primitive.attributes.find(fmt::format("WEIGHTS_{}", set));
            if (j == primitive.attributes.end() || w == primitive.attributes.end()) break;
            joints.push_back(accessors_.floats<4>(j->second, Place(place, j->first), pick));
            weights.push_back(accessors_.floats<4>(w->second, Place(place, w->first), pick));
        }
        if (joints.empty()) {
            context_.warn(place, "has a skin but neither JOINTS_0 nor WEIGHTS_0; drawn without the skin");
            return;
        }
        source.influence_sets = joints.size();
        source.influences.resize(source.positions.size() * joints.size());
        std::size_t unweighted = 0;
        for (std::size_t v = 0; v < source.positions.size(); ++v) {
            DeformSource::Influence* influence = &source.influences[v * joints.size()];
            float sum = 0;
            for (std::size_t s = 0; s < joints.size(); ++s) {
                for (int k = 0; k < 4; ++k) {
                    const float joint = joints[s][v][k], weight = weights[s][v][k];
                    if (!(weight > 0 && weight < 1e6f)) continue;
                    if (!(joint >= 0 && joint < static_cast<float>(joint_count)) || joint > 65535) {
                        context_.fail(
                            Place(place, "attributes.JOINTS_0"),
                            fmt::format("vertex {}: joint {} is out of range, the skin has {}", v, joint, joint_count));
                    }
                    influence[s].joints[std::size_t(k)] = static_cast<std::uint16_t>(joint);
                    influence[s].weights[k] = weight;
                    sum += weight;
                }
            }
            if (!(sum > 0)) {
                ++unweighted;
                influence[0].weights[0] = sum = 1;
            }
            for (std::size_t s = 0; s < joints.size(); ++s) influence[s].weights /= sum;
        }
        if (unweighted > 0)
            context_.warn(place, fmt::format("{} vertices have no weights; they follow joint 0", unweighted));
    }

    Context& context_;
    const tinygltf::Model& model_;
    Accessors& accessors_;
    Primitives& primitives_;
    const PlacedNodes& placed_;
    Scene& scene_;
    std::map<int, std::shared_ptr<const Skin>> skins_;
    std::map<std::tuple<int, std::size_t, int>, Part> parts_;
    std::size_t vertices_ = 0;
};

NodeRestPose rest_of(const tinygltf::Model& model, const tinygltf::Node& node) {
    NodeRestPose out;
    out.has_trs = false;
    if (node.translation.size() == 3) out.translation = {node.translation[0], node.translation[1], node.translation[2]};
    if (node.scale.size() == 3) out.scale = {node.scale[0], node.scale[1], node.scale[2]};
    if (node.rotation.size() == 4) {
        const glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        if (const double length = glm::length(q); length > 1e-12) out.rotation = q / length;
    }
    if (const std::size_t targets = target_count(model, node.mesh); targets > 0) {
        const auto& mesh_weights = model.meshes[std::size_t(node.mesh)].weights;
        const auto& weights = node.weights.empty() ? mesh_weights : node.weights;
        out.weights.assign(weights.begin(), weights.end());
        out.weights.resize(targets, 0.0f);
    }
    return out;
}

}  // namespace

void add_rig(Context& context, const Json& root, const tinygltf::Model& model, Accessors& accessors,
             Primitives& primitives, const PlacedNodes& placed, Scene& scene) {
    auto rig = std::make_shared<Rig>();
    rig->animations = read_animations(context, root, model, accessors, placed.scene_node);
    if (rig->animations.empty() && placed.deformed.empty()) return;

    Builder builder(context, model, accessors, primitives, placed, scene);
    for (const int node : placed.deformed) builder.add(node);
    NodeRestPose fixed;
    fixed.has_trs = false;
    rig->rest.assign(scene.nodes.size(), fixed);
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (placed.scene_node[i] >= 0) rig->rest[std::size_t(placed.scene_node[i])] = rest_of(model, model.nodes[i]);
    }
    for (const Animation& animation : rig->animations) {
        for (const AnimationChannel& channel : animation.channels) {
            if (channel.property != AnimatedProperty::Weights) rig->rest[std::size_t(channel.node)].has_trs = true;
        }
    }
    rig->camera_nodes = placed.camera_nodes;
    rig->light_nodes = placed.light_nodes;
    scene.rig = std::move(rig);
    apply_pose(scene, -1, 0);
}

}  // namespace si::gltf
