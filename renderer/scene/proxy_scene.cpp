#include "renderer/scene/proxy_scene.h"

#include <algorithm>
#include <map>
#include <set>

#include "renderer/base/key.h"

namespace si {
namespace {

constexpr std::size_t kSmallTriangles = 20000, kSmallObjects = 500;
constexpr int kTexels = 4;

bool is_power_of_two(int n) {
    return n > 0 && (n & (n - 1)) == 0;
}

/// Returns a small texture side that is a power of two when `side` is: drivers compile other samplers for these.
int few_texels(int side) {
    return std::min(side, is_power_of_two(side) ? kTexels : kTexels - 1);
}

Texture few_texels_of(const Texture& from) {
    Texture to = from;
    to.width = few_texels(from.width);
    to.height = few_texels(from.height);
    if (from.rgba.empty()) return to;
    std::vector<std::uint8_t> rgba;
    for (int y = 0; y < to.height; ++y) {
        const auto row = from.rgba.begin() + std::ptrdiff_t(y) * from.width * 4;
        rgba.insert(rgba.end(), row, row + std::ptrdiff_t(to.width) * 4);
    }
    to.rgba = std::move(rgba);
    return to;
}

/// Returns a mesh of the triangles with the outermost vertices along each axis.
Mesh outermost_triangles(const Mesh& from) {
    std::array<std::size_t, 6> outermost{};  // positions in the index list
    for (std::size_t i = 0; i < from.indices.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) {
            const auto at = [&](std::size_t k) { return from.positions[from.indices[k]][axis]; };
            if (at(i) < at(outermost[std::size_t(axis)])) outermost[std::size_t(axis)] = i;
            if (at(i) > at(outermost[std::size_t(axis) + 3])) outermost[std::size_t(axis) + 3] = i;
        }
    std::set<std::size_t> triangles;
    if (!from.indices.empty())
        for (const std::size_t i : outermost) triangles.insert(i / 3);
    std::vector<std::uint32_t> kept;
    for (const std::size_t t : triangles)
        for (std::size_t corner = 0; corner < 3; ++corner) kept.push_back(from.indices[3 * t + corner]);
    Mesh to = from;
    to.deformer = nullptr;
    to.indices = std::move(kept);
    split_vertices(to);
    return to;
}

void add_texture(Key& key, const Scene& scene, int index) {
    key.add(index >= 0);
    if (index < 0) return;
    const Texture& t = scene.textures[std::size_t(index)];
    key.add(is_power_of_two(t.width)).add(is_power_of_two(t.height)).add(t.srgb).add(t.mipmaps);
    key.add(t.wrap_s).add(t.wrap_t).add(t.nearest_mag).add(t.nearest_min);
}

/// Returns a key that is equal for objects drawn by the same programs.
std::uint64_t kind_of(const Scene& scene, const Settings& settings, const Object& object) {
    const Mesh& mesh = scene.meshes[std::size_t(object.mesh)];
    Key key;
    key.add(mesh.uv.empty()).add(mesh.uv_normal.empty()).add(mesh.tangents.empty()).add(mesh.colours.empty());
    key.add(object.ground).add(glm::determinant(glm::dmat3(object.world)) < 0).add(mesh.material >= 0);
    if (mesh.material >= 0) {
        const Material& m = scene.materials[std::size_t(mesh.material)];
        key.add(m.alpha).add(m.double_sided).add(m.unlit);
        add_texture(key, scene, m.base_colour_texture);
        add_texture(key, scene, m.normal_texture);
    }
    const ObjectSettings& own = object_settings(scene, settings, object);
    key.add(own.cast).add(own.receive).add(own.cull);
    return key.value();
}

/// Returns the indices of the outermost objects along each axis.
std::set<std::size_t> outermost_objects(const Scene& scene) {
    std::array<std::size_t, 6> outermost{};
    Bounds reached;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& o = scene.objects[i];
        const Bounds own = scene.meshes[std::size_t(o.mesh)].bounds.transformed(o.world);
        for (int axis = 0; axis < 3; ++axis) {
            if (own.lo[axis] < reached.lo[axis]) {
                reached.lo[axis] = own.lo[axis];
                outermost[std::size_t(axis)] = i;
            }
            if (own.hi[axis] > reached.hi[axis]) {
                reached.hi[axis] = own.hi[axis];
                outermost[std::size_t(axis) + 3] = i;
            }
        }
    }
    return {outermost.begin(), outermost.end()};
}

void keep_one_of_each_kind(const Scene& from, const Settings& settings, Scene& to) {
    const std::set<std::size_t> outermost = outermost_objects(from);
    std::set<std::uint64_t> kinds;
    std::map<int, int> meshes;
    for (std::size_t i = 0; i < from.objects.size(); ++i) {
        const Object& o = from.objects[i];
        if (!kinds.insert(kind_of(from, settings, o)).second && !outermost.contains(i)) continue;
        const auto [known, first] = meshes.emplace(o.mesh, int(to.meshes.size()));
        if (first) to.meshes.push_back(outermost_triangles(from.meshes[std::size_t(o.mesh)]));
        to.objects.push_back(o);
        to.objects.back().mesh = known->second;
    }
}

}  // namespace

Scene make_proxy_scene(const Scene& scene, const Settings& settings) {
    const bool small = scene.objects.size() <= kSmallObjects && scene.triangle_count() <= kSmallTriangles;
    Scene out;
    out.name = scene.name;
    out.file_scenes = scene.file_scenes;
    out.file_scene = scene.file_scene;
    out.materials = scene.materials;
    out.nodes = scene.nodes;
    out.cameras = scene.cameras;
    out.lights = scene.lights;
    for (const Texture& t : scene.textures) out.textures.push_back(few_texels_of(t));
    if (small) {
        out.meshes = scene.meshes;
        out.objects = scene.objects;
        for (Mesh& m : out.meshes) m.deformer = nullptr;
    } else {
        keep_one_of_each_kind(scene, settings, out);
    }
    finalise(out);
    return out;
}

}  // namespace si
