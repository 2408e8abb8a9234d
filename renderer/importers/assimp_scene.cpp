#include "renderer/importers/assimp_scene.h"

#include <assimp/commonMetaData.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <numbers>
#include <optional>

#include "renderer/base/error.h"
#include "renderer/gltf/extras.h"
#include "renderer/importers/assimp_materials.h"
#include "renderer/scene/axes.h"

namespace si::assimp {
namespace {

using nlohmann::json;

constexpr int kMaxDepth = 1000;

std::string text_of(const aiString& text) {
    return {text.data, text.length};
}

glm::dmat4 matrix_of(const aiMatrix4x4& m) {
    // Assimp's rows are glm's columns transposed.
    return {m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4, m.d4};
}

glm::dvec3 vector_of(const aiVector3D& v) {
    return {v.x, v.y, v.z};
}

json matrix_json(const glm::dmat4& m) {
    return std::vector<double>(glm::value_ptr(m), glm::value_ptr(m) + 16);
}

double linear_of(float srgb) {
    return srgb <= 0.04045f ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

/// Returns the rotation that looks along `forward` as glTF cameras and lights look along -z; the identity without a
/// direction.
glm::dmat4 looking_along(const glm::dvec3& forward, glm::dvec3 up) {
    if (!(glm::length(forward) > 0)) return glm::dmat4(1);
    const glm::dvec3 back = -glm::normalize(forward);
    if (!(glm::length(glm::cross(up, back)) > 1e-6 * glm::length(up)) || !(glm::length(up) > 0))
        up = std::abs(back.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(up, back));
    glm::dmat4 out(1);
    out[0] = glm::dvec4(right, 0);
    out[1] = glm::dvec4(glm::cross(back, right), 0);
    out[2] = glm::dvec4(back, 0);
    return out;
}

/// Up axis and unit of a model's file.
struct Axes {
    UpAxis up = UpAxis::Y;
    double unit_m = 1;
    glm::dmat4 missing{1.0};  ///< the part of turning and scaling that Assimp has not applied
    bool states_up = false, states_unit = false;
};

std::optional<double> number_of(const aiMetadata& data, const char* key) {
    double number = 0;
    float single = 0;
    int whole = 0;
    if (data.Get(key, number)) return number;
    if (data.Get(key, single)) return single;
    if (data.Get(key, whole)) return whole;
    return std::nullopt;
}

/// Returns axes and unit of an FBX, which Assimp reports and does not apply. UnitScaleFactor counts centimetres.
Axes fbx_axes(const aiMetadata& data) {
    Axes out;
    const int axis = int(number_of(data, "UpAxis").value_or(1)), sign = int(number_of(data, "UpAxisSign").value_or(1));
    constexpr UpAxis kPlus[] = {UpAxis::X, UpAxis::Y, UpAxis::Z};
    constexpr UpAxis kMinus[] = {UpAxis::MinusX, UpAxis::MinusY, UpAxis::MinusZ};
    if (axis >= 0 && axis < 3) out.up = sign < 0 ? kMinus[axis] : kPlus[axis];
    const double centimetres = number_of(data, "UnitScaleFactor").value_or(1);
    out.states_up = true;
    out.states_unit = std::isfinite(centimetres) && centimetres > 1e-6 && centimetres < 1e9;
    out.unit_m = 0.01 * (out.states_unit ? centimetres : 1);
    out.missing = glm::dmat4(out.unit_m * y_up_from(out.up));
    return out;
}

/// Returns axes and unit of a model. @param root transform of Assimp's root node, which turns COLLADA and 3DS files
Axes axes_of(const aiScene& scene, const std::string& extension, const glm::dmat4& root) {
    Axes out;
    if (extension == ".fbx") return scene.mMetaData ? fbx_axes(*scene.mMetaData) : out;
    if (extension == ".x3d") {  // metres and y up, by the specification
        out.states_up = out.states_unit = true;
    }
    if (extension == ".dae" || extension == ".3ds") {
        const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(root))));
        if (!(scale > 1e-9 && scale < 1e9)) return out;
        out.up = up_axis_of(glm::dmat3(root) / scale);
        out.states_up = true;
        out.states_unit = extension == ".dae";
        if (out.states_unit) out.unit_m = scale;
    }
    return out;
}

class Converter {
public:
    Converter(const aiScene& scene, const Source& source) : scene_(scene), source_(source), notes_(source.notes) {}

    std::vector<std::uint8_t> convert() {
        if (!scene_.mRootNode) throw Error("the model has no nodes");
        const glm::dmat4 root = matrix_of(scene_.mRootNode->mTransformation);
        axes_ = axes_of(scene_, source_.extension, root);
        Materials(scene_, source_.folder, glb_, notes_).write();
        find_nodes(*scene_.mRootNode, glm::dmat4(1), 0);
        add_lights();

        json roots = json::array();
        const aiNode& top = *scene_.mRootNode;
        if (top.mNumMeshes > 0 || has_view_or_light(top)) {
            roots.push_back(add_node(top, axes_.missing * root));
        } else {  // a root of Assimp's own
            for (unsigned i = 0; i < top.mNumChildren; ++i) {
                const aiNode& child = *top.mChildren[i];
                roots.push_back(add_node(child, axes_.missing * root * matrix_of(child.mTransformation)));
            }
        }
        add_remarks();
        json extras = {{"notes", notes_}, {"unit", axes_.unit_m}, {"up", up_axis_key(axes_.up)}};
        extras["files"] = source_.folder.names();
        glb_.root["asset"]["extras"] = {{gltf::kExtrasKey, std::move(extras)}};
        json scene = {{"extras", {{gltf::kExtrasKey, {{"about", about()}}}}}};
        if (!roots.empty()) scene["nodes"] = std::move(roots);
        glb_.root["scenes"] = json::array({std::move(scene)});
        glb_.root["scene"] = 0;
        return glb_.bytes();
    }

private:
    std::string about() const {
        std::string out = fmt::format("{} file", source_.label);
        aiString generator;
        if (scene_.mMetaData && scene_.mMetaData->Get(AI_METADATA_SOURCE_GENERATOR, generator) && generator.length > 0)
            out += fmt::format(", written by {}", text_of(generator));
        return out;
    }

    void find_nodes(const aiNode& node, const glm::dmat4& parent, int depth) {
        if (depth > kMaxDepth) throw Error(fmt::format("its nodes are nested deeper than {}", kMaxDepth));
        const glm::dmat4 world = parent * matrix_of(node.mTransformation);
        worlds_[&node] = world;
        by_name_.emplace(text_of(node.mName), world);
        for (unsigned i = 0; i < node.mNumChildren; ++i) find_nodes(*node.mChildren[i], world, depth + 1);
    }

    bool has_view_or_light(const aiNode& node) const {
        const auto names_it = [&](const auto* thing) { return thing->mName == node.mName; };
        return std::any_of(scene_.mCameras, scene_.mCameras + scene_.mNumCameras, names_it) ||
               std::any_of(scene_.mLights, scene_.mLights + scene_.mNumLights, names_it);
    }

    int add_node(const aiNode& node, const glm::dmat4& local) {
        const int index = glb_.append("nodes", {{"name", text_of(node.mName)}, {"matrix", matrix_json(local)}});
        json children = json::array();
        add_mesh(node, index);
        add_camera(node, index, children);
        place_light(node, index, children);
        for (unsigned i = 0; i < node.mNumChildren; ++i)
            children.push_back(add_node(*node.mChildren[i], matrix_of(node.mChildren[i]->mTransformation)));
        if (!children.empty()) glb_.root["nodes"][std::size_t(index)]["children"] = std::move(children);
        return index;
    }

    /// Adds what a camera or light needs to a node: to `node` itself, or to a child that turns it.
    void attach(int node, const std::string& name, const glm::dmat4& placed, const json& parts, json& children) {
        if (placed == glm::dmat4(1)) {
            glb_.root["nodes"][std::size_t(node)].update(parts);
            return;
        }
        json child = {{"name", name}, {"matrix", matrix_json(placed)}};
        child.update(parts);
        children.push_back(glb_.append("nodes", std::move(child)));
    }

    // Meshes ----------------------------------------------------------------------------------------------------------

    void add_mesh(const aiNode& node, int index) {
        std::vector<unsigned> meshes;
        bool bent = false;
        for (unsigned i = 0; i < node.mNumMeshes; ++i) {
            const aiMesh& mesh = *scene_.mMeshes[node.mMeshes[i]];
            if (!(mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE)) {
                (mesh.mPrimitiveTypes & aiPrimitiveType_LINE ? lines_ : points_) += mesh.mNumFaces;
                continue;
            }
            meshes.push_back(node.mMeshes[i]);
            bent |= mesh.mNumBones > 0;
        }
        if (meshes.empty()) return;
        const auto known = bent ? meshes_.end() : meshes_.find(meshes);
        if (known != meshes_.end()) {
            glb_.root["nodes"][std::size_t(index)]["mesh"] = known->second;
            return;
        }
        json primitives = json::array();
        for (const unsigned m : meshes)
            if (json made = primitive(*scene_.mMeshes[m], node); !made.empty()) primitives.push_back(std::move(made));
        if (primitives.empty()) return;
        const int mesh = glb_.append(
            "meshes", {{"name", text_of(scene_.mMeshes[meshes[0]]->mName)}, {"primitives", std::move(primitives)}});
        if (!bent) meshes_[meshes] = mesh;
        glb_.root["nodes"][std::size_t(index)]["mesh"] = mesh;
    }

    json primitive(const aiMesh& mesh, const aiNode& node) {
        std::vector<std::uint32_t> indices;
        indices.reserve(std::size_t(mesh.mNumFaces) * 3);
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            const aiFace& face = mesh.mFaces[f];
            if (face.mNumIndices != 3) continue;
            indices.insert(indices.end(), face.mIndices, face.mIndices + 3);
        }
        if (indices.empty() || mesh.mNumVertices == 0 || !mesh.HasPositions()) return {};
        Vertices v = vertices_of(mesh);
        if (mesh.mNumBones > 0) bend(mesh, node, v);
        json attributes = {{"POSITION", glb_.add_floats(flat(v.positions), 3, true)}};
        if (!v.normals.empty()) attributes["NORMAL"] = glb_.add_floats(flat(v.normals), 3);
        for (unsigned channel = 0; channel < mesh.GetNumUVChannels(); ++channel)
            attributes[fmt::format("TEXCOORD_{}", channel)] = glb_.add_floats(uv_of(mesh, channel), 2);
        if (mesh.HasVertexColors(0)) attributes["COLOR_0"] = glb_.add_floats(colours_of(mesh), 4);
        morphs_ += mesh.mNumAnimMeshes > 0;
        json out = {{"attributes", std::move(attributes)}, {"indices", glb_.add_indices(indices)}};
        if (mesh.mMaterialIndex < scene_.mNumMaterials) out["material"] = mesh.mMaterialIndex;
        return out;
    }

    struct Vertices {
        std::vector<aiVector3D> positions, normals;
    };

    static Vertices vertices_of(const aiMesh& mesh) {
        Vertices out;
        out.positions.assign(mesh.mVertices, mesh.mVertices + mesh.mNumVertices);
        if (mesh.HasNormals()) out.normals.assign(mesh.mNormals, mesh.mNormals + mesh.mNumVertices);
        return out;
    }

    static std::span<const float> flat(const std::vector<aiVector3D>& vectors) {
        static_assert(sizeof(aiVector3D) == 3 * sizeof(float));
        return {&vectors[0].x, 3 * vectors.size()};
    }

    static std::vector<float> uv_of(const aiMesh& mesh, unsigned channel) {
        std::vector<float> out;
        out.reserve(std::size_t(mesh.mNumVertices) * 2);
        for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
            const aiVector3D& uv = mesh.mTextureCoords[channel][i];
            out.insert(out.end(), {uv.x, 1 - uv.y});  // glTF counts from the top of the image
        }
        return out;
    }

    /// Returns vertex colours, linear. Formats of scans and prints hold them as on a screen (sRGB).
    std::vector<float> colours_of(const aiMesh& mesh) const {
        constexpr std::string_view kAsOnScreen[] = {".ply", ".obj", ".stl", ".off"};
        const bool srgb = std::ranges::find(kAsOnScreen, source_.extension) != std::end(kAsOnScreen);
        const auto channel = [&](float value) { return in_range(srgb ? float(linear_of(value)) : value); };
        std::vector<float> out;
        out.reserve(std::size_t(mesh.mNumVertices) * 4);
        for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
            const aiColor4D& c = mesh.mColors[0][i];
            out.insert(out.end(), {channel(c.r), channel(c.g), channel(c.b), in_range(c.a)});
        }
        return out;
    }

    static float in_range(float value) { return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : 1.0f; }

    /// Moves the vertices of a skinned mesh to the pose that the nodes of the file have.
    void bend(const aiMesh& mesh, const aiNode& node, Vertices& v) {
        const glm::dmat4 home = glm::inverse(worlds_.at(&node));
        std::vector<glm::dmat4> sums(mesh.mNumVertices, glm::dmat4(0));
        std::vector<double> weights(mesh.mNumVertices, 0);
        for (unsigned b = 0; b < mesh.mNumBones; ++b) {
            const aiBone& bone = *mesh.mBones[b];
            const auto found = by_name_.find(text_of(bone.mName));
            if (found == by_name_.end()) continue;
            const glm::dmat4 moved = home * found->second * matrix_of(bone.mOffsetMatrix);
            for (unsigned w = 0; w < bone.mNumWeights; ++w) {
                const aiVertexWeight& weight = bone.mWeights[w];
                if (weight.mVertexId >= mesh.mNumVertices || !(weight.mWeight > 0)) continue;
                sums[weight.mVertexId] += double(weight.mWeight) * moved;
                weights[weight.mVertexId] += double(weight.mWeight);
            }
        }
        for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
            if (!(weights[i] > 0)) continue;
            const glm::dmat4 m = sums[i] / weights[i];
            const glm::dvec3 p(m * glm::dvec4(vector_of(v.positions[i]), 1));
            v.positions[i] = {float(p.x), float(p.y), float(p.z)};
            if (v.normals.empty()) continue;
            const glm::dvec3 n = glm::inverseTranspose(glm::dmat3(m)) * vector_of(v.normals[i]);
            const double length = glm::length(n);
            if (length > 0 && std::isfinite(length))
                v.normals[i] = {float(n.x / length), float(n.y / length), float(n.z / length)};
        }
        ++skins_;
    }

    // Cameras and lights ----------------------------------------------------------------------------------------------

    void add_camera(const aiNode& node, int index, json& children) {
        for (unsigned i = 0; i < scene_.mNumCameras; ++i) {
            const aiCamera& from = *scene_.mCameras[i];
            if (from.mName != node.mName) continue;
            const double aspect = from.mAspect > 0 && std::isfinite(from.mAspect) ? double(from.mAspect) : 1.5;
            const double across = double(from.mHorizontalFOV), near = double(from.mClipPlaneNear) * axes_.unit_m,
                         far = double(from.mClipPlaneFar) * axes_.unit_m;
            if (!(across > 1e-3 && across < std::numbers::pi - 1e-3)) {
                notes_.push_back(
                    fmt::format("the camera \"{}\" has no usable field of view; it is left out", text_of(from.mName)));
                continue;
            }
            json lens = {{"yfov", 2 * std::atan(std::tan(across / 2) / aspect)}, {"znear", near > 0 ? near : 0.01}};
            if (far > lens["znear"].get<double>() && std::isfinite(far)) lens["zfar"] = far;
            const int camera = glb_.append(
                "cameras", {{"name", text_of(from.mName)}, {"type", "perspective"}, {"perspective", std::move(lens)}});
            const glm::dmat4 placed = glm::translate(glm::dmat4(1), vector_of(from.mPosition)) *
                                      looking_along(vector_of(from.mLookAt), vector_of(from.mUp));
            attach(index, text_of(from.mName), placed, {{"camera", camera}}, children);
        }
    }

    /// Returns half the opening angle of a spot light, and of its full brightness.
    std::pair<double, double> cone_of(const aiLight& from) const {
        double inner = double(from.mAngleInnerCone) / 2, outer = double(from.mAngleOuterCone) / 2;
        if (source_.extension == ".dae") outer = inner;  // Assimp widens falloff_angle by a guess
        if (source_.extension == ".x3d") {               // cutOffAngle and beamWidth are halves
            inner *= 2;
            outer *= 2;
        }
        outer = std::isfinite(outer) ? std::clamp(outer, 1e-3, std::numbers::pi / 2) : std::numbers::pi / 4;
        inner = std::isfinite(inner) ? std::clamp(inner, 0.0, outer) : 0;
        return {inner, outer};
    }

    void add_lights() {
        lights_.assign(scene_.mNumLights, -1);
        json list = json::array();
        for (unsigned i = 0; i < scene_.mNumLights; ++i) {
            const aiLight& from = *scene_.mLights[i];
            const std::string name = text_of(from.mName);
            json light = {{"name", name}};
            if (from.mType == aiLightSource_DIRECTIONAL) {
                light["type"] = "directional";
            } else if (from.mType == aiLightSource_POINT) {
                light["type"] = "point";
            } else if (from.mType == aiLightSource_SPOT) {
                const auto [inner, outer] = cone_of(from);
                light["type"] = "spot";
                light["spot"] = {{"innerConeAngle", inner}, {"outerConeAngle", outer}};
            } else {
                notes_.push_back(
                    fmt::format("the light \"{}\" is neither directional, spot nor point; it is left out", name));
                continue;
            }
            const aiColor3D& c = from.mColorDiffuse;
            const float most = std::max({c.r, c.g, c.b});
            if (!(most > 0) || !std::isfinite(c.r + c.g + c.b)) {
                notes_.push_back(fmt::format("the light \"{}\" is black; it is left out", name));
                continue;
            }
            light["intensity"] = most;
            light["color"] = {std::max(c.r / most, 0.0f), std::max(c.g / most, 0.0f), std::max(c.b / most, 0.0f)};
            lights_[i] = int(list.size());
            list.push_back(std::move(light));
        }
        if (list.empty()) return;
        glb_.root["extensionsUsed"] = {"KHR_lights_punctual"};
        glb_.root["extensions"]["KHR_lights_punctual"]["lights"] = std::move(list);
    }

    void place_light(const aiNode& node, int index, json& children) {
        for (unsigned i = 0; i < scene_.mNumLights; ++i) {
            const aiLight& from = *scene_.mLights[i];
            if (lights_[i] < 0 || from.mName != node.mName) continue;
            const glm::dmat4 placed = glm::translate(glm::dmat4(1), vector_of(from.mPosition)) *
                                      looking_along(vector_of(from.mDirection), vector_of(from.mUp));
            attach(index, text_of(from.mName), placed,
                   {{"extensions", {{"KHR_lights_punctual", {{"light", lights_[i]}}}}}}, children);
        }
    }

    void add_remarks() {
        if (!axes_.states_up && !axes_.states_unit)
            notes_.push_back(
                fmt::format("{} states neither unit nor up axis: a unit is read as 1 m and y as up; "
                            "scene.unit and scene.up change that",
                            source_.label));
        else if (!axes_.states_unit)
            notes_.push_back(fmt::format("{} states no unit: a unit is read as {:g} m; scene.unit changes that",
                                         source_.label, axes_.unit_m));
        if (points_ + lines_ > 0)
            notes_.push_back(
                fmt::format("{} points and {} lines are left out: only triangles cast shadows", points_, lines_));
        if (scene_.mNumAnimations > 0)
            notes_.push_back(fmt::format("{} animations are left out; the rest pose is shown", scene_.mNumAnimations));
        if (morphs_ > 0) notes_.push_back(fmt::format("the morph targets of {} meshes are left out", morphs_));
        if (skins_ > 0)
            notes_.push_back(
                fmt::format("{} skinned meshes are shown in their rest pose, without their bones", skins_));
    }

    const aiScene& scene_;
    const Source& source_;
    std::vector<std::string> notes_;
    GlbWriter glb_;
    Axes axes_;
    std::map<const aiNode*, glm::dmat4> worlds_;
    std::map<std::string, glm::dmat4> by_name_;
    std::map<std::vector<unsigned>, int> meshes_;  ///< glTF mesh by the meshes that it combines
    std::vector<int> lights_;                      ///< index in the GLB by light of the model; -1: left out
    std::size_t points_ = 0, lines_ = 0, morphs_ = 0, skins_ = 0;
};

}  // namespace

std::vector<std::uint8_t> to_glb(const aiScene& scene, const Source& source) {
    return Converter(scene, source).convert();
}

}  // namespace si::assimp
