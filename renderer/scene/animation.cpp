#include "renderer/scene/animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/base/error.h"
#include "renderer/scene/scene_lights.h"

namespace si {
namespace {

glm::dquat quaternion(const float* xyzw) {
    return glm::dquat(static_cast<double>(xyzw[3]), static_cast<double>(xyzw[0]), static_cast<double>(xyzw[1]),
                      static_cast<double>(xyzw[2]));
}

glm::dquat normalised(const glm::dquat& q) {
    const double length = glm::length(q);
    return length > 1e-12 ? q / length : glm::dquat(1, 0, 0, 0);
}

void store(const glm::dquat& q, std::vector<float>& out) {
    out = {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z), static_cast<float>(q.w)};
}

/// Returns the values of one key of a channel, without the tangents of Cubic.
const float* value_of_key(const AnimationChannel& c, std::size_t key) {
    return c.values.data() + (c.interpolation == Interpolation::Cubic ? 3 * key + 1 : key) * c.width;
}

// glTF 2.0, appendix C.5: a Hermite spline whose tangents are scaled by the key distance.
std::vector<float> cubic(const AnimationChannel& c, std::size_t key, double t, double length_s) {
    const float* v0 = value_of_key(c, key);
    const float* out_tangent = v0 + c.width;
    const float* v1 = value_of_key(c, key + 1);
    const float* in_tangent = v1 - c.width;
    const double t2 = t * t, t3 = t2 * t;
    std::vector<float> out(c.width);
    for (std::size_t i = 0; i < c.width; ++i) {
        out[i] = static_cast<float>((2 * t3 - 3 * t2 + 1) * v0[i] + length_s * (t3 - 2 * t2 + t) * out_tangent[i] +
                                    (-2 * t3 + 3 * t2) * v1[i] + length_s * (t3 - t2) * in_tangent[i]);
    }
    if (c.property == AnimatedProperty::Rotation) store(normalised(quaternion(out.data())), out);
    return out;
}

std::vector<float> linear(const AnimationChannel& c, std::size_t key, double t) {
    const float *v0 = value_of_key(c, key), *v1 = value_of_key(c, key + 1);
    std::vector<float> out(c.width);
    if (c.property == AnimatedProperty::Rotation) {
        store(glm::slerp(normalised(quaternion(v0)), normalised(quaternion(v1)), t), out);
        return out;
    }
    for (std::size_t i = 0; i < c.width; ++i) out[i] = static_cast<float>((1 - t) * v0[i] + t * v1[i]);
    return out;
}

glm::dvec3 vec3_of(const std::vector<float>& v) {
    return {v[0], v[1], v[2]};
}

glm::dmat4 matrix_of(const NodeRestPose& n) {
    return glm::scale(glm::translate(glm::dmat4(1.0), n.translation) * glm::mat4_cast(n.rotation), n.scale);
}

/// Sets the local and world transforms of all nodes for a pose. Returns the rest pose with this pose's morph weights.
std::vector<NodeRestPose> move_nodes(Scene& scene, const Rig& rig, int animation, double time_s) {
    std::vector<NodeRestPose> now = rig.rest;
    if (animation >= 0) {
        for (const AnimationChannel& channel : rig.animations[std::size_t(animation)].channels) {
            NodeRestPose& node = now[std::size_t(channel.node)];
            const std::vector<float> value = sample_channel(channel, time_s);
            switch (channel.property) {
                case AnimatedProperty::Translation:
                    node.translation = vec3_of(value);
                    break;
                case AnimatedProperty::Rotation:
                    node.rotation = normalised(quaternion(value.data()));
                    break;
                case AnimatedProperty::Scale:
                    node.scale = vec3_of(value);
                    break;
                case AnimatedProperty::Weights:
                    node.weights = value;
                    break;
            }
        }
    }
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        Node& node = scene.nodes[i];
        if (i < now.size() && now[i].has_trs) node.local = matrix_of(now[i]);
        node.world = node.parent < 0 ? node.local : scene.nodes[std::size_t(node.parent)].world * node.local;
    }
    return now;
}

struct JointMatrix {
    glm::mat4 point;
    glm::mat3 normal;
};

std::vector<JointMatrix> joint_matrices(const Scene& scene, const Skin& skin, const glm::dmat4& to_placement) {
    std::vector<JointMatrix> out(skin.joints.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        const glm::dmat4 m = to_placement * scene.nodes[std::size_t(skin.joints[i])].world * skin.inverse_bind[i];
        const glm::dvec3 x(m[0]), y(m[1]), z(m[2]);
        // Inverse transpose by cofactors, without the division: only its direction counts, and no scale of 0 harms it.
        const double side = glm::dot(x, glm::cross(y, z)) < 0 ? -1 : 1;
        out[i] = {glm::mat4(m), glm::mat3(glm::dmat3(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y)) * side)};
    }
    return out;
}

glm::vec3 direction(const glm::vec3& v, const glm::vec3& otherwise) {
    const glm::dvec3 d(v);
    const double length = glm::length(d);
    return length > 0 && std::isfinite(length) ? glm::vec3(d / length) : otherwise;
}

void morph(const DeformSource& source, const std::vector<float>& weights, Mesh& mesh) {
    std::vector<glm::vec3>&positions = mesh.positions.edit(), &normals = mesh.normals.edit();
    std::vector<glm::vec4>& tangents = mesh.tangents.edit();
    for (std::size_t t = 0; t < source.targets.size() && t < weights.size(); ++t) {
        const float w = weights[t];
        if (w == 0) continue;
        const DeformSource::Target& target = source.targets[t];
        for (std::size_t i = 0; i < target.positions.size(); ++i) positions[i] += w * target.positions[i];
        if (!source.normals.empty()) {
            for (std::size_t i = 0; i < target.normals.size(); ++i) normals[i] += w * target.normals[i];
        }
        if (!tangents.empty()) {
            for (std::size_t i = 0; i < target.tangents.size(); ++i)
                tangents[i] += glm::vec4(w * target.tangents[i], 0);
        }
    }
}

void skin_vertices(const DeformSource& source, const std::vector<JointMatrix>& joints, Mesh& mesh) {
    std::vector<glm::vec3>&positions = mesh.positions.edit(), &normals = mesh.normals.edit();
    std::vector<glm::vec4>& tangents = mesh.tangents.edit();
    for (std::size_t i = 0; i < positions.size(); ++i) {
        glm::mat4 point(0.0f);
        glm::mat3 normal(0.0f);
        for (std::size_t s = 0; s < source.influence_sets; ++s) {
            const DeformSource::Influence& influence = source.influences[i * source.influence_sets + s];
            for (int k = 0; k < 4; ++k) {
                const float w = influence.weights[k];
                if (w == 0) continue;
                const JointMatrix& joint = joints[influence.joints[std::size_t(k)]];
                point += w * joint.point;
                normal += w * joint.normal;
            }
        }
        positions[i] = glm::vec3(point * glm::vec4(positions[i], 1.0f));
        if (!source.normals.empty()) normals[i] = normal * normals[i];
        if (!tangents.empty()) tangents[i] = glm::vec4(glm::mat3(point) * glm::vec3(tangents[i]), tangents[i].w);
    }
}

void flatten_normals(Mesh& mesh) {
    std::vector<glm::vec3> normals(mesh.positions.size(), glm::vec3(0, 1, 0));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        const glm::dvec3 p(mesh.positions[a]);
        const glm::vec3 n(glm::cross(glm::dvec3(mesh.positions[b]) - p, glm::dvec3(mesh.positions[c]) - p));
        normals[a] = normals[b] = normals[c] = direction(n, {0, 1, 0});
    }
    mesh.normals = std::move(normals);
}

void deform(Scene& scene, Mesh& mesh, const std::vector<NodeRestPose>& now) {
    const Deformer& deformer = *mesh.deformer;
    const DeformSource& source = *deformer.source;
    mesh.positions.assign(source.positions);
    mesh.normals.assign(source.normals);
    if (!mesh.tangents.empty()) mesh.tangents.assign(source.tangents);
    mesh.indices = source.indices;
    morph(source, now[std::size_t(deformer.node)].weights, mesh);
    if (deformer.skin) {
        const glm::dvec3 origin(scene.nodes[std::size_t(deformer.skin->joints[0])].world[3]);
        glm::dmat4 world = glm::translate(glm::dmat4(1.0), origin);
        // The mesh's own node does not move the vertices, but its determinant sets their winding (glTF 2.0, section
        // 3.7.4).
        if (glm::determinant(glm::dmat3(scene.nodes[std::size_t(deformer.node)].world)) < 0)
            world = glm::scale(world, glm::dvec3(-1, 1, 1));
        Node& placement = scene.nodes[std::size_t(deformer.placement)];
        placement.local = placement.world = world;
        skin_vertices(source, joint_matrices(scene, *deformer.skin, glm::inverse(world)), mesh);
    }
    if (source.normals.empty()) {
        flatten_normals(mesh);
    } else {
        for (glm::vec3& n : mesh.normals.edit()) n = direction(n, {0, 1, 0});
    }
    for (glm::vec4& t : mesh.tangents.edit()) t = glm::vec4(direction(glm::vec3(t), {1, 0, 0}), t.w);
}

}  // namespace

std::vector<float> sample_channel(const AnimationChannel& c, double time_s) {
    const auto hold = [&](std::size_t key) {
        return std::vector<float>(value_of_key(c, key), value_of_key(c, key) + c.width);
    };
    // NaN counts as before the first key.
    if (!(time_s > c.times_s.front())) return hold(0);
    if (time_s >= c.times_s.back()) return hold(c.times_s.size() - 1);
    const auto after = std::upper_bound(c.times_s.begin(), c.times_s.end(), time_s,
                                        [](double t, float key) { return t < static_cast<double>(key); });
    const auto key = std::size_t(after - c.times_s.begin()) - 1;
    if (c.interpolation == Interpolation::Step) return hold(key);
    const double length_s = static_cast<double>(c.times_s[key + 1]) - static_cast<double>(c.times_s[key]);
    const double t = (time_s - static_cast<double>(c.times_s[key])) / length_s;
    return c.interpolation == Interpolation::Cubic ? cubic(c, key, t, length_s) : linear(c, key, t);
}

void apply_pose(Scene& scene, int animation, double time_s) {
    if (!scene.rig) return;
    const Rig& rig = *scene.rig;
    if (animation < -1 || animation >= static_cast<int>(rig.animations.size())) {
        throw Error(
            fmt::format("{}: animation {} does not exist, there are {}; choose one of them or -1 for the rest pose",
                        scene.name, animation, rig.animations.size()));
    }
    const std::vector<NodeRestPose> now = move_nodes(scene, rig, animation, time_s);
    for (Mesh& mesh : scene.meshes) {
        if (mesh.deformer) deform(scene, mesh, now);
    }
    const auto follow = [&](auto& things, const std::vector<int>& nodes) {
        // finalise() drops cameras and lights with a transform that is not finite; indices would no longer match.
        if (things.size() != nodes.size()) return;
        for (std::size_t i = 0; i < things.size(); ++i)
            things[i].world = things[i].home = scene.nodes[std::size_t(nodes[i])].world;
    };
    follow(scene.cameras, rig.camera_nodes);
    follow(scene.lights, rig.light_nodes);
}

namespace {

constexpr std::size_t kAnimationSteps = 256;             // least number over a whole animation
constexpr std::size_t kLeastSteps = 4, kMostSteps = 32;  // limits between two keys
constexpr double kMostPoseWork = 5e7;                    // nodes and deformed vertices times poses

/// Returns the key times of all channels in ascending order without duplicates, thinned evenly to at most `most`.
std::vector<double> key_times(const Animation& animation, std::size_t most) {
    std::vector<double> times;
    for (const AnimationChannel& c : animation.channels)
        for (const float t : c.times_s)
            if (std::isfinite(t)) times.push_back(static_cast<double>(t));
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    if (times.size() <= most) return times;
    std::vector<double> some;
    for (std::size_t i = 0; i < most; ++i) some.push_back(times[i * (times.size() - 1) / (most - 1)]);
    return some;
}

/// Bounds of all objects of a scene in poses of one animation.
class PoseBounds {
public:
    PoseBounds(const Scene& scene, int animation) : posed_(scene), animation_(animation) {
        for (const Mesh& mesh : posed_.meshes) {
            std::vector<std::uint32_t>& used = used_.emplace_back();
            if (!mesh.deformer) continue;
            used.assign(mesh.deformer->source->indices.begin(), mesh.deformer->source->indices.end());
            std::sort(used.begin(), used.end());
            used.erase(std::unique(used.begin(), used.end()), used.end());
        }
        objects_ = all_objects(posed_);
    }

    /// Returns the cost of one pose: nodes plus deformed vertices.
    double work() const {
        double vertices = 0;
        for (std::size_t i = 0; i < posed_.meshes.size(); ++i)
            if (posed_.meshes[i].deformer) vertices += static_cast<double>(posed_.meshes[i].positions.size());
        return vertices + static_cast<double>(posed_.nodes.size() + posed_.objects.size());
    }

    /// Returns the boxes of all_objects() at a time, before Scene::placement; empty where the pose has nothing to draw.
    std::vector<Bounds> at(double time_s) {
        apply_pose(posed_, animation_, time_s);
        std::vector<Bounds> deformed(posed_.meshes.size());
        for (std::size_t i = 0; i < deformed.size(); ++i)
            for (const std::uint32_t v : used_[i]) deformed[i].add(glm::dvec3(posed_.meshes[i].positions[v]));
        std::vector<Bounds> out;
        for (const Object* o : objects_) {
            const auto mesh = std::size_t(o->mesh);
            const Bounds& own = posed_.meshes[mesh].deformer ? deformed[mesh] : posed_.meshes[mesh].bounds;
            const glm::dmat4 world = posed_.nodes[std::size_t(o->node)].world * o->instance;
            Bounds box = own.transformed(world);
            if (!std::isfinite(box.radius())) box = {};
            out.push_back(box);
        }
        return out;
    }

private:
    Scene posed_;
    int animation_;
    std::vector<std::vector<std::uint32_t>> used_;  // by deformed mesh: vertices that its triangles use
    std::vector<const Object*> objects_;
};

/// Grows a box by three boxes at equal time steps, and by twice the overshoot of a parabola through their sides.
void add_bent(Bounds& to, const Bounds& before, const Bounds& at, const Bounds& after) {
    if (before.empty() || at.empty() || after.empty()) return;
    const glm::dvec3 below = glm::max(0.25 * (before.lo + after.lo - 2.0 * at.lo), glm::dvec3(0)),
                     above = glm::max(0.25 * (2.0 * at.hi - before.hi - after.hi), glm::dvec3(0));
    for (const Bounds* b : {&before, &at, &after}) to.add(Bounds{b->lo - below, b->hi + above});
}

/// Returns the same objects as all_objects(), for writing.
std::vector<Object*> every_object(Scene& scene) {
    std::vector<Object*> all(scene.objects.size() + scene.hidden.size());
    for (HiddenObject& h : scene.hidden) all[h.place] = &h.object;
    auto shown = scene.objects.begin();
    for (Object*& o : all)
        if (!o) o = &*shown++;
    return all;
}

}  // namespace

void measure_animation_bounds(Scene& scene, int animation) {
    if (scene.animation_bounds_of == animation) return;
    for (Object* o : every_object(scene)) o->animation_bounds = {};
    scene.animation_bounds = {};
    scene.animation_bounds_of = -1;
    if (!scene.rig || animation < 0 || std::size_t(animation) >= scene.rig->animations.size()) return;
    PoseBounds pose_bounds(scene, animation);
    const double poses = kMostPoseWork / std::max(pose_bounds.work(), 1.0);
    const auto most = std::size_t(std::clamp(poses / kLeastSteps, 2.0, 1e6));
    const std::vector<double> keys = key_times(scene.rig->animations[std::size_t(animation)], most);
    if (keys.empty()) return;
    scene.animation_bounds_of = animation;
    const std::vector<Bounds> first = pose_bounds.at(keys[0]);
    std::vector<Bounds> all = first;
    std::vector<bool> moved(all.size());
    const std::size_t wanted = kAnimationSteps / std::max<std::size_t>(keys.size() - 1, 1);
    const std::size_t steps = std::clamp(wanted, kLeastSteps, kMostSteps);
    for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
        std::vector<Bounds> before, at;
        for (std::size_t step = 0; step <= steps; ++step) {
            // A stepped channel jumps at the next key: sample the last value before the jump.
            const double share = static_cast<double>(step) / static_cast<double>(steps);
            const double time = keys[k] + share * (keys[k + 1] - keys[k]);
            std::vector<Bounds> now = pose_bounds.at(step < steps ? time : std::nextafter(keys[k + 1], keys[k]));
            for (std::size_t i = 0; i < all.size(); ++i) {
                moved[i] = moved[i] || now[i] != first[i];
                all[i].add(now[i]);
                if (step >= 2) add_bent(all[i], before[i], at[i], now[i]);
            }
            before = std::move(at);
            at = std::move(now);
        }
    }
    const std::vector<Bounds> last = pose_bounds.at(keys.back());
    const std::vector<Object*> objects = every_object(scene);
    for (std::size_t i = 0; i < objects.size(); ++i) {
        Object& o = *objects[i];
        if (o.ground) continue;
        all[i].add(last[i]);
        scene.animation_bounds.add(all[i]);
        const bool deforms = scene.meshes[std::size_t(o.mesh)].deformer != nullptr;
        if (moved[i] || deforms || last[i] != first[i]) o.animation_bounds = all[i];
    }
}

bool is_animated(const Scene& scene, int animation) {
    return scene.rig && animation >= 0 && std::size_t(animation) < scene.rig->animations.size() &&
           scene.rig->animations[std::size_t(animation)].duration_s > 0;
}

void pose(Scene& scene, int animation, double time_s) {
    if (!scene.rig) return;
    scene.placement = glm::dmat4(1);
    apply_pose(scene, animation, time_s);
    refresh(scene);
    suggest_lights(scene);
}

}  // namespace si
