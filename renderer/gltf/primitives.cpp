#include "renderer/gltf/primitives.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "renderer/base/float_bits.h"
#include "renderer/base/printable.h"

namespace si::gltf {
namespace {

constexpr std::uint32_t kUnused = 0xffffffff;

/// Converts strips and fans to a triangle list (glTF 2.0, section 3.7.2.1). Triangles with a repeated vertex only join
/// parts of a strip and are dropped.
std::vector<std::uint32_t> as_triangle_list(const std::vector<std::uint32_t>& in, int mode) {
    std::vector<std::uint32_t> out;
    if (in.size() < 3) return out;
    out.reserve(3 * (in.size() - 2));
    for (std::size_t i = 0; i + 2 < in.size(); ++i) {
        std::uint32_t a = in[i], b = in[i + 1 + i % 2], c = in[i + 2 - i % 2];
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
            a = in[i + 1];
            b = in[i + 2];
            c = in[0];
        }
        if (a == b || b == c || c == a) continue;
        out.insert(out.end(), {a, b, c});
    }
    return out;
}

/// Limit of coordinates: the squared length of larger ones overflows a float.
constexpr float kFarthest = 1e18f;

}  // namespace

Primitives::Primitives(Context& context, const tinygltf::Model& model, Accessors& accessors, Materials& materials,
                       Scene& scene)
    : context_(context), model_(model), accessors_(accessors), materials_(materials), scene_(scene) {}

const std::vector<int>& Primitives::of_mesh(int mesh) {
    if (const auto it = of_mesh_.find(mesh); it != of_mesh_.end()) return it->second;
    std::vector<int>& out = of_mesh_[mesh];
    const tinygltf::Mesh& from = model_.meshes[std::size_t(mesh)];
    const Place mesh_place("meshes", mesh);
    for (std::size_t i = 0; i < from.primitives.size(); ++i) {
        const Place place(mesh_place, "primitives", i);
        const int built = share(from.primitives[i], place, from.name);
        if (built >= 0) out.push_back(built);
    }
    return out;
}

int Primitives::share(const tinygltf::Primitive& primitive, const Place& place, const std::string& name) {
    std::vector<int> key{primitive.mode, primitive.indices, primitive.material};
    for (const auto& [attribute, accessor] : primitive.attributes) {
        // The names of the present attributes are part of the key.
        key.push_back(int(std::hash<std::string>{}(attribute)&0x7fffffff));
        key.push_back(accessor);
    }
    if (const auto it = shared_.find(key); it != shared_.end()) return it->second;
    std::vector<std::uint32_t> pick;
    std::optional<Mesh> mesh = make(primitive, place, name, pick);
    if (mesh) scene_.meshes.push_back(std::move(*mesh));
    return shared_[key] = mesh ? int(scene_.meshes.size()) - 1 : -1;
}

std::vector<std::uint32_t> Primitives::compact(std::vector<std::uint32_t>& indices, std::size_t vertex_count) {
    if (scratch_.size() < vertex_count) scratch_.resize(vertex_count, kUnused);
    std::vector<std::uint32_t> used;
    used.reserve(indices.size());
    for (std::uint32_t& index : indices) {
        std::uint32_t& number = scratch_[index];
        if (number == kUnused) {
            number = std::uint32_t(used.size());
            used.push_back(index);
        }
        index = number;
    }
    for (const std::uint32_t index : used) scratch_[index] = kUnused;
    return used;
}

std::optional<Mesh> Primitives::make(const tinygltf::Primitive& primitive, const Place& place, const std::string& name,
                                     std::vector<std::uint32_t>& pick) {
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
        context_.warn(place, primitive.mode == TINYGLTF_MODE_POINTS ? "points are not drawn" : "lines are not drawn");
        return std::nullopt;
    }
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) {
        context_.warn(place, "has no POSITION and is not drawn");
        return std::nullopt;
    }
    const std::size_t vertex_count = accessors_.count(position->second);
    if (vertex_count > kUnused) context_.fail(place, "has more vertices than 32-bit indices reach", "split the mesh");
    accessors_.load_data(position->second);

    Mesh mesh;
    mesh.name = printable(name);
    mesh.material = primitive.material;
    if (primitive.indices >= 0) {
        mesh.indices = accessors_.indices(primitive.indices, Place(place, "indices"), vertex_count);
    } else {
        std::vector<std::uint32_t> indices(vertex_count);
        std::iota(indices.begin(), indices.end(), 0u);
        mesh.indices = std::move(indices);
    }
    if (primitive.mode != TINYGLTF_MODE_TRIANGLES) {
        mesh.indices = as_triangle_list(mesh.indices, primitive.mode);
    } else if (const std::size_t rest = mesh.indices.size() % 3; rest != 0) {
        context_.warn(place, fmt::format("{} corners are no multiple of three, the last {} are dropped",
                                         mesh.indices.size(), rest));
        mesh.indices.resize(mesh.indices.size() - rest);
    }
    if (mesh.indices.empty()) {
        context_.warn(place, "has no triangles");
        return std::nullopt;
    }
    // Several primitives may use parts of one large vertex array: keep only the vertices in use.
    if (mesh.indices.size() < vertex_count) pick = compact(mesh.indices.edit(), vertex_count);
    read_attributes(primitive, place, pick, mesh);
    if (!all_within(mesh.positions.all(), kFarthest)) {
        context_.warn(place, all_finite(mesh.positions.all()) ? "has positions beyond 1e18; it is not drawn"
                                                              : "has positions that are not finite; it is not drawn");
        return std::nullopt;
    }
    return mesh;
}

std::vector<glm::vec2> Primitives::coordinates(const tinygltf::Primitive& primitive, const Place& place,
                                               const UvSource& source, std::span<const std::uint32_t> pick) {
    const std::string name = fmt::format("TEXCOORD_{}", source.set);
    const auto it = primitive.attributes.find(name);
    if (it == primitive.attributes.end()) {
        context_.warn(place, fmt::format("its material reads {}, which it has not; drawn with one texel", name));
        return {};
    }
    auto uv = accessors_.floats<2>(it->second, Place(place, name), pick);
    source.apply(uv);
    return uv;
}

void Primitives::read_attributes(const tinygltf::Primitive& primitive, const Place& place,
                                 std::span<const std::uint32_t> pick, Mesh& mesh) {
    const Place here(place, "attributes");
    const std::size_t vertex_count = accessors_.count(primitive.attributes.at("POSITION"));
    for (const auto& [name, accessor] : primitive.attributes) {
        if (accessors_.count(accessor) != vertex_count) {
            context_.fail(Place(here, name), fmt::format("accessor {} has {} elements, POSITION has {}", accessor,
                                                         accessors_.count(accessor), vertex_count));
        }
    }
    const auto find = [&](const char* name) {
        const auto it = primitive.attributes.find(name);
        return it == primitive.attributes.end() ? -1 : it->second;
    };
    mesh.positions = accessors_.floats<3>(find("POSITION"), Place(here, "POSITION"), pick);
    if (const int normal = find("NORMAL"); normal >= 0) {
        mesh.normals = accessors_.floats<3>(normal, Place(here, "NORMAL"), pick);
    }
    const MaterialUv& uv = materials_.use(primitive.material);
    if (uv.base_colour.set >= 0) mesh.uv = coordinates(primitive, here, uv.base_colour, pick);
    if (uv.normal.set >= 0) {
        if (uv.base_colour.set < 0) {
            mesh.uv = coordinates(primitive, here, uv.normal, pick);
        } else if (!(uv.normal == uv.base_colour)) {
            mesh.uv_normal = coordinates(primitive, here, uv.normal, pick);
        }
        if (const int tangent = find("TANGENT"); tangent >= 0) {
            mesh.tangents = accessors_.floats<4>(tangent, Place(here, "TANGENT"), pick);
        }
    }
    if (const int colour = find("COLOR_0"); colour >= 0) {
        const Place colour_place(here, "COLOR_0");
        if (accessors_.width(colour) == 3) {
            const auto rgb = accessors_.floats<3>(colour, colour_place, pick);
            mesh.colours.reserve(rgb.size());
            for (const glm::vec3& c : rgb) mesh.colours.emplace_back(c, 1.0f);
        } else {
            mesh.colours = accessors_.floats<4>(colour, colour_place, pick);
        }
    }
}

std::size_t target_count(const tinygltf::Model& model, int mesh) {
    if (mesh < 0) return 0;
    std::size_t most = 0;
    for (const auto& primitive : model.meshes[std::size_t(mesh)].primitives)
        most = std::max(most, primitive.targets.size());
    return most;
}

}  // namespace si::gltf
