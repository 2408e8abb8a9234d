// Writer of scenes as glTF 2.0 files. The same scene gives the same bytes.
//
// tinygltf is not used for writing. It writes "zfar": 0 for a perspective camera without a far plane, which the
// specification forbids, and throws on names that are not UTF-8. Its text has one number per line; this writer has one
// element per line, which people can read and compare.
#include <fmt/format.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "renderer/base/atomic_file.h"
#include "renderer/base/base64.h"
#include "renderer/base/error.h"
#include "renderer/base/lower_case.h"
#include "renderer/gltf/extras.h"
#include "renderer/gltf/gltf.h"
#include "renderer/scene/animation.h"
#include "renderer/scene/scene_lights.h"
#include "renderer/settings/param.h"

namespace si {
namespace {

using Json = nlohmann::ordered_json;

// Numbers that the glTF 2.0 specification takes from OpenGL.
constexpr int kFloat = 5126, kUnsignedShort = 5123, kUnsignedInt = 5125, kArrayBuffer = 34962, kElementBuffer = 34963;
constexpr int kNearest = 9728, kLinear = 9729, kNearestMipmap = 9984, kLinearMipmap = 9987;
constexpr int kRepeat = 10497, kClamp = 33071, kMirror = 33648;

class Writer {
public:
    explicit Writer(const Scene& scene) : scene_(scene) {}
    Json document();
    std::string& bytes() { return bytes_; }

private:
    int add_view(const void* data, std::size_t size, int target);
    int add_accessor(Json accessor, const void* data, std::size_t size, int target);
    template <class Vec>
    int add_vectors(const SharedArray<Vec>& values, bool with_bounds = false);
    int add_indices(const Mesh& mesh);
    const Json& primitive(int mesh);
    int add_group(const std::vector<int>& meshes);
    void add_textures();
    void add_materials();
    void add_nodes();
    void add_cameras();
    void add_lights();
    void add_root(Json node);

    const Scene& scene_;
    std::string bytes_;
    Json root_ = Json::object();
    Json roots_ = Json::array();
    std::map<int, Json> primitives_;          ///< by mesh, so that each mesh's data is written once
    std::map<std::vector<int>, int> groups_;  ///< glTF mesh by the scene meshes that it combines
    std::vector<bool> second_uv_;             ///< by material: the normal texture has its own coordinates
    std::map<std::string, bool> extensions_;
};

/// Sets "matrix" unless it is the identity. A matrix that is not finite has no JSON form; finalise() dropped the
/// objects below such a node.
void set_matrix(Json& node, const glm::dmat4& m) {
    const std::vector<double> values(glm::value_ptr(m), glm::value_ptr(m) + 16);
    const bool finite = std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
    if (finite && m != glm::dmat4(1.0)) node["matrix"] = values;
}

int Writer::add_view(const void* data, std::size_t size, int target) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    Json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}};
    if (target) view["target"] = target;
    bytes_.append(static_cast<const char*>(data), size);
    root_["bufferViews"].push_back(std::move(view));
    return int(root_["bufferViews"].size()) - 1;
}

int Writer::add_accessor(Json accessor, const void* data, std::size_t size, int target) {
    Json out = {{"bufferView", add_view(data, size, target)}};
    out.update(accessor);
    root_["accessors"].push_back(std::move(out));
    return int(root_["accessors"].size()) - 1;
}

template <class Vec>
int Writer::add_vectors(const SharedArray<Vec>& values, bool with_bounds) {
    constexpr int kLength = int(Vec::length());
    Json accessor = {{"componentType", kFloat}, {"count", values.size()}, {"type", fmt::format("VEC{}", kLength)}};
    if (with_bounds) {
        Vec lo = values[0], hi = values[0];
        for (const Vec& v : values) {
            lo = glm::min(lo, v);
            hi = glm::max(hi, v);
        }
        for (int i = 0; i < kLength; ++i) {
            accessor["min"].push_back(double(lo[i]));
            accessor["max"].push_back(double(hi[i]));
        }
    }
    return add_accessor(std::move(accessor), values.data(), values.size() * sizeof(Vec), kArrayBuffer);
}

int Writer::add_indices(const Mesh& mesh) {
    Json accessor = {{"componentType", kUnsignedInt}, {"count", mesh.indices.size()}, {"type", "SCALAR"}};
    // Index 65535 is primitive restart in 16 bits, which the specification forbids.
    if (mesh.positions.size() > 65535)
        return add_accessor(std::move(accessor), mesh.indices.data(), mesh.indices.size() * 4, kElementBuffer);
    accessor["componentType"] = kUnsignedShort;
    const std::vector<std::uint16_t> narrow(mesh.indices.begin(), mesh.indices.end());
    return add_accessor(std::move(accessor), narrow.data(), narrow.size() * 2, kElementBuffer);
}

const Json& Writer::primitive(int index) {
    if (const auto found = primitives_.find(index); found != primitives_.end()) return found->second;
    const Mesh& mesh = scene_.meshes[index];
    Json attributes = {{"POSITION", add_vectors(mesh.positions, true)}};
    if (!mesh.normals.empty()) attributes["NORMAL"] = add_vectors(mesh.normals);
    if (!mesh.tangents.empty()) attributes["TANGENT"] = add_vectors(mesh.tangents);
    const Material* material = mesh.material >= 0 ? &scene_.materials[mesh.material] : nullptr;
    const bool textured = material && (material->base_colour_texture >= 0 || material->normal_texture >= 0);
    if (!mesh.uv.empty() && textured) attributes["TEXCOORD_0"] = add_vectors(mesh.uv);
    if (textured && second_uv_[mesh.material]) {
        const auto& second = mesh.uv_normal.empty() ? mesh.uv : mesh.uv_normal;
        if (!second.empty()) attributes["TEXCOORD_1"] = add_vectors(second);
    }
    if (!mesh.colours.empty()) attributes["COLOR_0"] = add_vectors(mesh.colours);
    Json out = {{"attributes", std::move(attributes)}, {"indices", add_indices(mesh)}};
    if (mesh.material >= 0) out["material"] = mesh.material;
    return primitives_.emplace(index, std::move(out)).first->second;
}

int Writer::add_group(const std::vector<int>& meshes) {
    if (const auto found = groups_.find(meshes); found != groups_.end()) return found->second;
    Json mesh = Json::object();
    if (const std::string& name = scene_.meshes[meshes[0]].name; !name.empty()) mesh["name"] = name;
    for (int index : meshes) mesh["primitives"].push_back(primitive(index));
    root_["meshes"].push_back(std::move(mesh));
    return groups_[meshes] = int(root_["meshes"].size()) - 1;
}

void append_bytes(void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data), std::size_t(size));
}

int wrap_code(TextureWrap wrap) {
    return wrap == TextureWrap::Clamp ? kClamp : wrap == TextureWrap::Mirror ? kMirror : kRepeat;
}

void Writer::add_textures() {
    std::map<std::array<int, 4>, int> samplers;
    for (const Texture& t : scene_.textures) {
        std::string png;
        if (t.width <= 0 || t.height <= 0 ||
            !stbi_write_png_to_func(append_bytes, &png, t.width, t.height, 4, t.rgba.data(), 4 * t.width))
            throw Error(fmt::format("texture '{}' has no pixels that a PNG could hold", t.name));
        const std::array<int, 4> key = {
            t.nearest_mag ? kNearest : kLinear,
            t.mipmaps ? (t.nearest_min ? kNearestMipmap : kLinearMipmap) : (t.nearest_min ? kNearest : kLinear),
            wrap_code(t.wrap_s), wrap_code(t.wrap_t)};
        const auto [sampler, is_new] = samplers.try_emplace(key, int(samplers.size()));
        if (is_new)
            root_["samplers"].push_back(
                {{"magFilter", key[0]}, {"minFilter", key[1]}, {"wrapS", key[2]}, {"wrapT", key[3]}});
        Json image = Json::object(), texture = Json::object();
        if (!t.name.empty()) image["name"] = texture["name"] = t.name;
        image["mimeType"] = "image/png";
        image["bufferView"] = add_view(png.data(), png.size(), 0);
        root_["images"].push_back(std::move(image));
        texture["sampler"] = sampler->second;
        texture["source"] = root_["images"].size() - 1;
        root_["textures"].push_back(std::move(texture));
    }
}

void Writer::add_materials() {
    second_uv_.assign(scene_.materials.size(), false);
    for (const Mesh& m : scene_.meshes)
        if (m.material >= 0 && !m.uv_normal.empty()) second_uv_[m.material] = true;
    for (std::size_t i = 0; i < scene_.materials.size(); ++i) {
        const Material& m = scene_.materials[i];
        Json out = Json::object();
        if (!m.name.empty()) out["name"] = m.name;
        // Rough and not metallic, which resembles the renderer's Blinn-Phong shading.
        Json& pbr = out["pbrMetallicRoughness"] = {{"metallicFactor", 0}, {"roughnessFactor", 0.8}};
        for (int c = 0; c < 4; ++c) pbr["baseColorFactor"].push_back(double(m.base_colour[c]));
        if (m.base_colour_texture >= 0) pbr["baseColorTexture"] = {{"index", m.base_colour_texture}};
        if (m.normal_texture >= 0) {
            out["normalTexture"] = {{"index", m.normal_texture}, {"scale", double(m.normal_scale)}};
            if (second_uv_[i]) out["normalTexture"]["texCoord"] = 1;
        }
        if (m.alpha == AlphaMode::Blend) out["alphaMode"] = "BLEND";
        if (m.alpha == AlphaMode::Mask) {
            out["alphaMode"] = "MASK";
            out["alphaCutoff"] = double(m.alpha_cutoff);
        }
        if (m.double_sided) out["doubleSided"] = true;
        if (m.unlit) out["extensions"]["KHR_materials_unlit"] = Json::object(), extensions_["KHR_materials_unlit"];
        root_["materials"].push_back(std::move(out));
    }
}

/// Adds a root node.
void Writer::add_root(Json node) {
    root_["nodes"].push_back(std::move(node));
    roots_.push_back(int(root_["nodes"].size()) - 1);
}

void Writer::add_nodes() {
    Json nodes = Json::array();
    for (const Node& n : scene_.nodes) {
        Json node = Json::object();
        if (!n.name.empty()) node["name"] = n.name;
        set_matrix(node, n.parent < 0 ? scene_.placement * n.local : n.local);
        nodes.push_back(std::move(node));
    }
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
        if (scene_.nodes[i].parent < 0)
            roots_.push_back(i);
        else
            nodes[scene_.nodes[i].parent]["children"].push_back(i);
    }
    // Objects without an instance transform become the node's mesh; the others get child nodes.
    std::map<int, std::vector<int>> at_node;
    for (const Object& o : scene_.objects) {
        if (scene_.meshes[o.mesh].indices.empty()) continue;
        if (o.instance == glm::dmat4(1.0)) at_node[o.node].push_back(o.mesh);
    }
    for (const auto& [node, meshes] : at_node) nodes[node]["mesh"] = add_group(meshes);
    for (const Object& o : scene_.objects) {
        if (scene_.meshes[o.mesh].indices.empty() || o.instance == glm::dmat4(1.0)) continue;
        Json node = {{"name", scene_.meshes[o.mesh].name}, {"mesh", add_group({o.mesh})}};
        set_matrix(node, o.instance);
        nodes[o.node]["children"].push_back(nodes.size());
        nodes.push_back(std::move(node));
    }
    if (!nodes.empty()) root_["nodes"] = std::move(nodes);
}

void Writer::add_cameras() {
    const double scale = placement_scale(scene_);
    for (SceneCamera c : scene_.cameras) {
        c.height *= scale;
        c.near *= scale;
        c.far *= scale;
        // glTF allows only a perspective far plane to be absent (automatic). Other automatic planes are written as
        // planes around the whole scene, and marked in extras.
        const double reach =
            std::max(glm::length(glm::dvec3(c.world[3]) - scene_.bounds.centre()) + scene_.bounds.radius(), 1e-6);
        const double near = c.near > 0 ? c.near : 1e-3 * reach, far = c.far > 0 ? c.far : std::max(2 * reach, 2 * near);
        Json camera = Json::object();
        if (!c.name.empty()) camera["name"] = c.name;
        if (c.orthographic) {
            camera["type"] = "orthographic";
            camera["orthographic"] = {
                {"xmag", c.height / 2 * 16 / 9}, {"ymag", c.height / 2}, {"zfar", far}, {"znear", near}};
        } else {
            camera["type"] = "perspective";
            camera["perspective"] = {{"yfov", glm::radians(c.fov_y_deg)}, {"znear", near}};
            if (c.far > 0) camera["perspective"]["zfar"] = far;
        }
        if (c.near <= 0) camera["extras"][gltf::kExtrasKey]["znear_automatic"] = true;
        if (c.far <= 0 && c.orthographic) camera["extras"][gltf::kExtrasKey]["zfar_automatic"] = true;
        root_["cameras"].push_back(std::move(camera));
        Json node = {{"name", c.name.empty() ? "Camera" : c.name}, {"camera", root_["cameras"].size() - 1}};
        set_matrix(node, c.world);
        add_root(std::move(node));
    }
}

void Writer::add_lights() {
    Json lights = Json::array();
    for (const SceneLight& l : scene_.lights) {
        Json light = Json::object();
        if (!l.name.empty()) light["name"] = l.name;
        light["type"] = kLightTypeKeys[std::size_t(l.type)];
        light["color"] = {l.colour.r, l.colour.g, l.colour.b};
        light["intensity"] = l.intensity;
        if (l.range > 0) light["range"] = l.range * placement_scale(scene_);
        if (l.type == LightType::Spot)
            light["spot"] = {{"innerConeAngle", l.inner_cone_rad}, {"outerConeAngle", l.outer_cone_rad}};
        Json node = {{"name", l.name.empty() ? "Light" : l.name}};
        node["extensions"]["KHR_lights_punctual"]["light"] = lights.size();
        set_matrix(node, l.world);
        add_root(std::move(node));
        lights.push_back(std::move(light));
    }
    if (lights.empty()) return;
    root_["extensions"]["KHR_lights_punctual"]["lights"] = std::move(lights);
    extensions_["KHR_lights_punctual"];
}

/// Returns true when a reader of the file derives the same light settings from the lights alone.
bool lights_suggest_same_settings(const Scene& scene) {
    Scene lit;
    lit.lights = scene.lights;
    for (SceneLight& light : lit.lights) light.range *= placement_scale(scene);
    lit.bounds = scene.bounds;
    suggest_lights(lit);
    std::vector<std::pair<std::string, std::string>> own = scene.suggested;
    std::erase_if(own, [](const auto& row) { return !row.first.starts_with("light."); });
    return own == lit.suggested;
}

Json Writer::document() {
    root_["asset"] = {{"version", "2.0"}, {"generator", "Shadow Inspector"}};
    add_textures();
    add_materials();
    add_nodes();
    add_cameras();
    add_lights();
    Json scene = Json::object();
    if (!scene_.name.empty()) scene["name"] = scene_.name;
    if (!roots_.empty()) scene["nodes"] = roots_;
    if (!scene_.about.empty()) scene["extras"][gltf::kExtrasKey]["about"] = scene_.about;
    const bool lights_suffice = lights_suggest_same_settings(scene_);
    for (const auto& [key, value] : scene_.suggested) {
        // A model names no file of a setting.
        if (const auto ref = find_setting(key); ref && ref->param->file) continue;
        if (!lights_suffice || !key.starts_with("light.")) scene["extras"][gltf::kExtrasKey]["suggested"][key] = value;
    }
    root_["scene"] = 0;
    root_["scenes"] = Json::array({std::move(scene)});
    for (const auto& [name, unused] : extensions_) root_["extensionsUsed"].push_back(name);
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    return std::move(root_);
}

/// Formats the document with one line per element of the top-level arrays, which people can read and compare.
std::string text_of(const Json& document) {
    const auto dump = [](const Json& j) { return j.dump(-1, ' ', false, Json::error_handler_t::replace); };
    std::string out = "{";
    const char* separator = "\n";
    for (const auto& [key, value] : document.items()) {
        out += separator + dump(Json(key)) + ": ";
        separator = ",\n";
        if (!value.is_array()) {
            out += dump(value);
            continue;
        }
        const char* comma = "[\n  ";
        for (const Json& element : value) {
            out += comma + dump(element);
            comma = ",\n  ";
        }
        out += "\n]";
    }
    return out + "\n}\n";
}

/// Encodes a GLB header or chunk header: 32-bit little-endian words.
std::string words(std::initializer_list<std::uint64_t> values) {
    std::string out;
    for (std::uint64_t v : values)
        for (int i = 0; i < 4; ++i) out += char(v >> (8 * i) & 255);
    return out;
}

}  // namespace

std::vector<std::string> export_notes(const Scene& scene) {
    std::vector<std::string> notes;
    const auto count = [](std::size_t n, std::string_view what) {
        return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
    };
    std::size_t skinned = 0, morphed = 0;
    for (const Mesh& mesh : scene.meshes) {
        if (!mesh.deformer) continue;
        if (mesh.deformer->skin) ++skinned;
        if (mesh.deformer->source && !mesh.deformer->source->targets.empty()) ++morphed;
    }
    if (skinned > 0)
        notes.push_back(fmt::format("the skin of {} is baked: the file holds the vertices of this pose, without joints",
                                    count(skinned, "mesh")));
    if (morphed > 0)
        notes.push_back(fmt::format("morph targets of {} are baked: the file holds the vertices of this pose",
                                    count(morphed, "mesh")));
    if (scene.rig && !scene.rig->animations.empty())
        notes.push_back(fmt::format("{} dropped: the file holds the pose at scene.time",
                                    scene.rig->animations.size() == 1
                                        ? "the animation is"
                                        : fmt::format("{} animations are", scene.rig->animations.size())));
    if (scene.placement != glm::dmat4(1.0))
        notes.push_back("scene.distance, scene.direction and scene.scale are baked into the root nodes");
    if (scene.file_scenes.size() > 1)
        notes.push_back(fmt::format("{} of the file dropped: the file holds the shown one",
                                    scene.file_scenes.size() == 2
                                        ? "the other scene is"
                                        : fmt::format("the other {} scenes are", scene.file_scenes.size() - 1)));
    notes.insert(notes.end(), scene.not_written.begin(), scene.not_written.end());
    return notes;
}

namespace {

/// Document of a scene and the bytes of its one buffer, which has no uri yet.
struct WrittenScene {
    Json document;
    std::string bytes;
};

WrittenScene write_scene(const Scene& scene) {
    Writer writer(scene);
    WrittenScene out;
    out.document = writer.document();
    out.bytes = std::move(writer.bytes());
    if (!out.bytes.empty()) out.document["buffers"] = Json::array({{{"byteLength", out.bytes.size()}}});
    return out;
}

/// Parts of a .glb file, in their order.
struct GlbParts {
    std::string header, json, chunk;
};

/// @param scene_name name of the scene or file, for the message @throws Error above 4 GiB
GlbParts glb_parts(const WrittenScene& written, const std::string& scene_name) {
    GlbParts out;
    out.json = text_of(written.document);
    out.json.resize((out.json.size() + 3) / 4 * 4, ' ');
    const std::uint64_t bytes = written.bytes.size();
    const std::uint64_t total = 12 + 8 + out.json.size() + (bytes == 0 ? 0 : 8 + bytes);
    if (total > 0xFFFFFFFFu)
        throw Error(
            fmt::format("cannot write {}: a .glb holds at most 4 GiB, this scene needs {} bytes", scene_name, total));
    out.header = words({0x46546C67u, 2, total, out.json.size(), 0x4E4F534Au});
    if (bytes > 0) out.chunk = words({bytes, 0x004E4942u});
    return out;
}

}  // namespace

std::string glb_bytes(const Scene& scene) {
    const WrittenScene written = write_scene(scene);
    const GlbParts parts = glb_parts(written, scene.name);
    return parts.header + parts.json + parts.chunk + written.bytes;
}

void save_gltf(const Scene& scene, const std::filesystem::path& path) {
    const std::string extension = lower_extension(path);
    if (extension != ".gltf" && extension != ".glb")
        throw Error(fmt::format("cannot write {}: scenes are written as .gltf or .glb", path.string()));
    WrittenScene written = write_scene(scene);
    if (extension == ".gltf") {
        if (!written.bytes.empty())
            written.document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(written.bytes);
        write_atomically(path, {text_of(written.document)});
        return;
    }
    const GlbParts parts = glb_parts(written, path.string());
    write_atomically(path, {parts.header, parts.json, parts.chunk, written.bytes});
}

}  // namespace si
