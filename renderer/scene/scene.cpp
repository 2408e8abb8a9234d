#include "renderer/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "renderer/base/error.h"
#include "renderer/base/float_bits.h"
#include "renderer/base/key.h"

namespace si {
namespace {

/// Limit of coordinates: squares of larger ones overflow single precision, which shaders use.
constexpr double kFarthest_m = 1e18;
/// Limit of a node's path, so that a chain of n nodes takes O(n) memory, not O(n^2).
constexpr std::size_t kLongestPath = 400;

bool finite(const glm::dmat4& m) {
    double sum = 0;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) sum += m[c][r] * 0.0;
    return sum == 0.0;  // 0 * Inf and 0 * NaN are NaN
}

std::string mesh_label(const Mesh& mesh, std::size_t index) {
    return mesh.name.empty() ? fmt::format("mesh {}", index) : fmt::format("mesh {} ('{}')", index, mesh.name);
}

template <class T>
void check_attribute(const Mesh& mesh, const std::string& label, const SharedArray<T>& values, std::string_view what) {
    if (!values.empty() && values.size() != mesh.positions.size())
        throw Error(fmt::format("{}: {} {} for {} positions; each vertex needs one", label, values.size(), what,
                                mesh.positions.size()));
}

void check_index(int index, std::size_t size, int lowest, const std::string& where, std::string_view what) {
    if (index < lowest || (index >= 0 && std::size_t(index) >= size))
        throw Error(fmt::format("{}: {} {} is out of range; there are {}", where, what, index, size));
}

void check_references(const Scene& scene) {
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
        const Texture& t = scene.textures[i];
        if (t.width < 0 || t.height < 0 || t.rgba.size() != std::size_t(t.width) * std::size_t(t.height) * 4)
            throw Error(fmt::format("texture {} ('{}'): {} bytes for {}x{} RGBA pixels", i, t.name, t.rgba.size(),
                                    t.width, t.height));
    }
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& m = scene.materials[i];
        const std::string where = fmt::format("material {} ('{}')", i, m.name);
        check_index(m.base_colour_texture, scene.textures.size(), -1, where, "base colour texture");
        check_index(m.normal_texture, scene.textures.size(), -1, where, "normal texture");
    }
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const Mesh& m = scene.meshes[i];
        const std::string where = mesh_label(m, i);
        check_index(m.material, scene.materials.size(), -1, where, "material");
        check_attribute(m, where, m.normals, "normals");
        check_attribute(m, where, m.uv, "texture coordinates");
        check_attribute(m, where, m.uv_normal, "normal map coordinates");
        check_attribute(m, where, m.tangents, "tangents");
        check_attribute(m, where, m.colours, "colours");
        if (m.indices.size() % 3 != 0)
            throw Error(fmt::format("{}: {} indices are no whole number of triangles", where, m.indices.size()));
    }
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& o = scene.objects[i];
        if (o.node < 0 || o.mesh < 0 || std::size_t(o.node) >= scene.nodes.size() ||
            std::size_t(o.mesh) >= scene.meshes.size())
            throw Error(fmt::format("object {}: node {} or mesh {} is out of range; there are {} and {}", i, o.node,
                                    o.mesh, scene.nodes.size(), scene.meshes.size()));
    }
}

void place_nodes(std::vector<Node>& nodes) {
    std::unordered_set<std::string> taken;
    std::unordered_map<std::string, int> repeats;  // so that n equal names cost O(n)
    taken.reserve(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        Node& node = nodes[i];
        if (node.parent < -1 || node.parent >= int(i))
            throw Error(fmt::format("node {} ('{}'): parent {} does not come before it", i, node.name, node.parent));
        std::string path;
        if (node.parent >= 0) {
            const std::string& parent = nodes[node.parent].path;
            path = (parent.size() > kLongestPath ? std::string("...") : parent) + "/";
        }
        if (node.name.empty()) {
            path += fmt::format("node {}", i);
        } else {
            for (char c : node.name) path += (c == '/' || static_cast<unsigned char>(c) < 32) ? '_' : c;
        }
        if (!taken.insert(path).second) {
            int& count = repeats.try_emplace(path, 1).first->second;
            std::string unique;
            do unique = fmt::format("{} #{}", path, ++count);
            while (!taken.insert(unique).second);
            path = std::move(unique);
        }
        node.path = std::move(path);
        node.world = node.parent >= 0 ? nodes[node.parent].world * node.local : node.local;
    }
}

glm::dvec3 face_cross(const Mesh& m, std::size_t first) {
    const glm::dvec3 a(m.positions[m.indices[first]]);
    return glm::cross(glm::dvec3(m.positions[m.indices[first + 1]]) - a,
                      glm::dvec3(m.positions[m.indices[first + 2]]) - a);
}

/// Splits all vertices, so that each triangle has its own three with the face normal.
void make_flat(Mesh& mesh) {
    split_vertices(mesh);
    std::vector<glm::vec3> normals(mesh.positions.size());
    for (std::size_t i = 0; i < normals.size(); i += 3) {
        const glm::vec3 n(glm::normalize(face_cross(mesh, i)));
        normals[i] = normals[i + 1] = normals[i + 2] = n;
    }
    mesh.normals = std::move(normals);
}

/// Returns true when the triangle has an area. @param first position of its first index
bool has_area(const Mesh& mesh, std::size_t first) {
    const glm::dvec3 cross = face_cross(mesh, first);
    const double area2 = glm::dot(cross, cross);
    return area2 > 0 && std::isfinite(area2);
}

/// Sixteen triangles as structure of arrays, so that the compiler vectorises.
struct TriangleBlock {
    static constexpr std::size_t kCount = 16;
    float x[3][3][kCount];  ///< corner, axis, triangle

    void gather(const glm::vec3* positions, const std::uint32_t* indices) {
        for (std::size_t t = 0; t < kCount; ++t)
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const glm::vec3& p = positions[indices[3 * t + corner]];
                for (int axis = 0; axis < 3; ++axis) x[corner][axis][t] = p[axis];
            }
    }

    /// Returns true when all sixteen triangles certainly have an area; false where single precision cannot decide.
    /// Edges e, f have a relative error of 2^-24, so their cross product has one of a few times that of |e| |f|.
    bool all_have_area() const {
        constexpr float kSine2 = 1e-10f, kLeast = 1e-30f, kMost = std::numeric_limits<float>::max();
        int unsure = 0;
        for (std::size_t t = 0; t < kCount; ++t) {
            const float ex = x[1][0][t] - x[0][0][t], ey = x[1][1][t] - x[0][1][t], ez = x[1][2][t] - x[0][2][t];
            const float fx = x[2][0][t] - x[0][0][t], fy = x[2][1][t] - x[0][1][t], fz = x[2][2][t] - x[0][2][t];
            const float nx = ey * fz - ez * fy, ny = ez * fx - ex * fz, nz = ex * fy - ey * fx;
            const float area2 = nx * nx + ny * ny + nz * nz;
            const float edges2 = (ex * ex + ey * ey + ez * ez) * (fx * fx + fy * fy + fz * fz);
            unsure += !(area2 > kSine2 * edges2) + !(area2 > kLeast) + !(area2 < kMost);
        }
        return unsure == 0;
    }
};

/// Bounding box over the vertices of many triangle blocks.
struct BlockBounds {
    float lo[3][TriangleBlock::kCount], hi[3][TriangleBlock::kCount];

    BlockBounds() {
        std::fill_n(&lo[0][0], std::size(lo) * TriangleBlock::kCount, std::numeric_limits<float>::infinity());
        std::fill_n(&hi[0][0], std::size(hi) * TriangleBlock::kCount, -std::numeric_limits<float>::infinity());
    }
    void add(const TriangleBlock& b) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t t = 0; t < TriangleBlock::kCount; ++t) {
                const float p = b.x[0][axis][t], q = b.x[1][axis][t], r = b.x[2][axis][t];
                const float least = p < q ? p : q, most = p > q ? p : q;
                const float low = least < r ? least : r, high = most > r ? most : r;
                lo[axis][t] = low < lo[axis][t] ? low : lo[axis][t];
                hi[axis][t] = high > hi[axis][t] ? high : hi[axis][t];
            }
    }
    Bounds box() const {
        Bounds out;
        for (int axis = 0; axis < 3; ++axis) {
            out.lo[axis] = *std::min_element(lo[axis], lo[axis] + TriangleBlock::kCount);
            out.hi[axis] = *std::max_element(hi[axis], hi[axis] + TriangleBlock::kCount);
        }
        return out;
    }
};

/// Drops triangles without area, and sets the mesh's bounds to the others. Returns the number dropped. Validates the
/// indices in the same loop, while they are in the CPU cache. @throws Error when one is out of range
std::size_t drop_degenerate(Mesh& mesh, std::string_view label) {
    const std::uint32_t* indices = mesh.indices.data();
    const std::size_t count = mesh.indices.size();
    std::size_t kept = 0;
    const auto check = [&](std::size_t first, std::size_t corners) {
        std::uint32_t highest = 0;
        for (std::size_t k = 0; k < corners; ++k) highest = std::max(highest, indices[first + k]);
        if (highest >= mesh.positions.size())
            throw Error(fmt::format("{}: index {} is out of range; there are {} vertices", label, highest,
                                    mesh.positions.size()));
    };
    const auto keep = [&](std::size_t first, std::size_t corners) {
        if (kept != first) {
            std::uint32_t* own = mesh.indices.edit().data();
            std::copy_n(own + first, corners, own + kept);
            indices = own;
        }
        kept += corners;
    };
    constexpr std::size_t kCorners = 3 * TriangleBlock::kCount;
    TriangleBlock block;
    BlockBounds around_blocks;
    Bounds around_rest;
    for (std::size_t i = 0; i < count;) {
        check(i, std::min(kCorners, count - i));
        if (i + kCorners <= count) {
            block.gather(mesh.positions.data(), indices + i);
            if (block.all_have_area()) {
                around_blocks.add(block);
                keep(i, kCorners);
                i += kCorners;
                continue;
            }
        }
        for (const std::size_t end = std::min(i + kCorners, count); i < end; i += 3) {
            if (!has_area(mesh, i)) continue;
            for (std::size_t k = i; k < i + 3; ++k) around_rest.add(glm::dvec3(mesh.positions[indices[k]]));
            keep(i, 3);
        }
    }
    if (kept != count) mesh.indices.resize(kept);
    mesh.bounds = around_blocks.box();
    mesh.bounds.add(around_rest);
    return (count - kept) / 3;
}

/// Normalises the normals of a mesh. Returns false when a triangle uses a normal without direction.
bool repair_normals(Mesh& mesh) {
    const auto is_unit = [](const glm::vec3& n) { return std::abs(glm::dot(n, n) - 1) <= 1e-3f; };  // false for NaN
    std::size_t odd = 0;
    for (const glm::vec3& n : mesh.normals) odd += !is_unit(n);
    if (odd == 0) return true;
    std::vector<bool> lost(mesh.normals.size());
    std::vector<glm::vec3>& normals = mesh.normals.edit();
    for (std::size_t i = 0; i < normals.size(); ++i) {
        glm::vec3& n = normals[i];
        if (is_unit(n)) continue;
        const double length2 = glm::dot(glm::dvec3(n), glm::dvec3(n));
        lost[i] = !(length2 > 0) || !std::isfinite(length2);
        if (!lost[i]) n = glm::vec3(glm::dvec3(n) / std::sqrt(length2));
    }
    return std::ranges::none_of(mesh.indices, [&](std::uint32_t index) { return lost[index]; });
}

template <class T>
void drop_if_not_finite(SharedArray<T>& values, const std::string& label, std::string_view what, Scene& scene) {
    if (all_finite(values.all())) return;
    values.clear();
    scene.warnings.push_back(fmt::format("{}: its {} hold values that are not finite; they are ignored", label, what));
}

/// Validates and completes one mesh. Returns false when nothing of it can be drawn in any pose.
bool finalise_mesh(Scene& scene, std::size_t index) {
    Mesh& mesh = scene.meshes[index];
    const std::string label = mesh_label(mesh, index);
    if (!all_finite(mesh.positions.all())) {
        scene.warnings.push_back(label + ": dropped, it has positions that are not finite");
        return false;
    }
    drop_if_not_finite(mesh.uv, label, "texture coordinates", scene);
    drop_if_not_finite(mesh.uv_normal, label, "normal map coordinates", scene);
    drop_if_not_finite(mesh.tangents, label, "tangents", scene);
    drop_if_not_finite(mesh.colours, label, "colours", scene);
    if (const std::size_t dropped = drop_degenerate(mesh, label)) {
        scene.dropped_triangles += dropped;
        scene.warnings.push_back(
            fmt::format("{}: dropped {} triangle{} without area", label, dropped, dropped == 1 ? "" : "s"));
    }
    if (mesh.indices.empty()) return mesh.deformer != nullptr;  // another pose may have triangles with an area
    if (mesh.normals.empty()) {
        make_flat(mesh);
    } else if (!repair_normals(mesh)) {
        scene.warnings.push_back(label + ": has normals that are zero or not finite; flat normals replace them");
        make_flat(mesh);
    }
    return true;
}

/// Removes the meshes that cannot be drawn and the objects that place them.
void finalise_meshes(Scene& scene) {
    std::vector<int> moved(scene.meshes.size(), -1);
    int kept = 0;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        if (!finalise_mesh(scene, i)) continue;
        moved[i] = kept;
        // `kept` lags behind `i` only after a drop; a self-move would empty the mesh.
        if (std::size_t(kept) != i) scene.meshes[kept] = std::move(scene.meshes[i]);
        ++kept;
    }
    scene.meshes.resize(kept);
    std::erase_if(scene.objects, [&](const Object& o) { return moved[o.mesh] < 0; });
    for (Object& o : scene.objects) o.mesh = moved[o.mesh];
}

/// Returns true for the box of a floor: flat, at the scene's bottom and nearly as wide as the scene.
bool is_floor(const Bounds& object, const Bounds& scene) {
    constexpr double kThickness = 0.02, kHighest = 0.15, kWidth = 0.8;  // of the scene's height, height and width
    const glm::dvec3 size = scene.hi - scene.lo, own = object.hi - object.lo;
    return own.y <= kThickness * size.y && object.hi.y <= scene.lo.y + kHighest * size.y && own.x >= kWidth * size.x &&
           own.z >= kWidth * size.z;
}

/// Sets Scene::bounds_without_floor; Scene::bounds must be set.
void set_bounds_without_floor(Scene& scene) {
    scene.bounds_without_floor = {};
    for (const Object* o : objects_without_floor(scene))
        scene.bounds_without_floor.add(scene.meshes[std::size_t(o->mesh)].bounds.transformed(o->world));
}

void place_objects(Scene& scene) {
    std::size_t dropped = 0;
    std::string first;
    scene.bounds = scene.ground_bounds = {};
    std::erase_if(scene.objects, [&](Object& o) {
        o.world = scene.nodes[o.node].world * o.instance;
        const Mesh& mesh = scene.meshes[o.mesh];
        if (mesh.deformer && mesh.bounds.empty() && finite(o.world)) return false;  // nothing to draw in this pose
        const Bounds b = finite(o.world) ? mesh.bounds.transformed(o.world) : Bounds{};
        // Written so that NaN fails.
        const bool near_enough = glm::all(glm::lessThan(glm::abs(b.lo), glm::dvec3(kFarthest_m))) &&
                                 glm::all(glm::lessThan(glm::abs(b.hi), glm::dvec3(kFarthest_m)));
        if (near_enough) {
            (o.ground ? scene.ground_bounds : scene.bounds).add(b);
            return false;
        }
        if (dropped++ == 0) first = scene.nodes[o.node].path;
        return true;
    });
    if (dropped > 0)
        scene.warnings.push_back(fmt::format("node '{}'{}: dropped, its place is not finite or farther than {:g} m",
                                             first, dropped > 1 ? fmt::format(" and {} more", dropped - 1) : "",
                                             kFarthest_m));
}

template <class T>
void drop_unplaced(std::vector<T>& things, std::string_view what, Scene& scene) {
    std::erase_if(things, [&](const T& thing) {
        if (finite(thing.world)) return false;
        scene.warnings.push_back(fmt::format("{} '{}': dropped, its transform is not finite", what, thing.name));
        return true;
    });
}

}  // namespace

void split_vertices(Mesh& mesh) {
    for_each_attribute([&]<typename T>(SharedArray<T> Mesh::*attribute) {
        const SharedArray<T>& values = mesh.*attribute;
        if (values.empty()) return;
        std::vector<T> split(mesh.indices.size());
        for (std::size_t i = 0; i < split.size(); ++i) split[i] = values[mesh.indices[i]];
        mesh.*attribute = std::move(split);
    });
    std::vector<std::uint32_t>& indices = mesh.indices.edit();
    std::iota(indices.begin(), indices.end(), 0u);
}

Box Bounds::corners(const glm::dmat4& m) const {
    Box box;
    for (std::size_t i = 0; i < box.size(); ++i)
        box[i] = glm::dvec3(m * glm::dvec4(i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z, 1.0));
    return box;
}

// Arvo, Transforming Axis-Aligned Bounding Boxes, Graphics Gems, 1990: each axis takes the lesser and the greater
// of two products, which gives the box around the eight corners of an affine image.
Bounds Bounds::transformed(const glm::dmat4& m) const {
    if (empty()) return {};
    Bounds out{glm::dvec3(m[3]), glm::dvec3(m[3])};
    for (int c = 0; c < 3; ++c) {
        const glm::dvec3 column(m[c]), a = column * lo[c], b = column * hi[c];
        out.lo += glm::min(a, b);
        out.hi += glm::max(a, b);
    }
    return out;
}

std::size_t Scene::object_count() const {
    return std::size_t(std::ranges::count(objects, false, &Object::ground));
}

std::size_t Scene::triangle_count() const {
    std::size_t count = 0;
    for (const Object& o : objects) count += o.ground ? 0 : meshes[o.mesh].indices.size() / 3;
    return count;
}

namespace {

constexpr std::string_view kHolder = "scenes";

void track_arrays(Mesh& m) {
    for_each_attribute([&](auto attribute) { (m.*attribute).track_memory(kHolder); });
    m.indices.track_memory(kHolder);
}

}  // namespace

void finalise(Scene& scene) {
    check_references(scene);
    place_nodes(scene.nodes);
    finalise_meshes(scene);
    place_objects(scene);
    drop_unplaced(scene.cameras, "camera", scene);
    drop_unplaced(scene.lights, "light", scene);
    for (SceneCamera& camera : scene.cameras) camera.home = camera.world;
    for (SceneLight& light : scene.lights) light.home = light.world;
    for (Texture& texture : scene.textures) texture.rgba.track_memory(kHolder);
    for (Mesh& mesh : scene.meshes) track_arrays(mesh);
    scene.held = TrackedMemory(kHolder, array_bytes(scene.nodes) + array_bytes(scene.objects));
    scene.main_part = {};
    set_bounds_without_floor(scene);
    scene.id = next_version();
}

void refresh(Scene& scene) {
    for (Node& node : scene.nodes)
        node.world = (node.parent >= 0 ? scene.nodes[node.parent].world : scene.placement) * node.local;
    for (Mesh& mesh : scene.meshes) {
        if (!mesh.deformer) continue;
        // The same limit as in finalise(): an animation may move vertices anywhere.
        if (!all_within(mesh.positions.all(), float(kFarthest_m))) {
            mesh.indices.clear();
            std::ranges::fill(mesh.positions.edit(), glm::vec3(0));
        }
        drop_degenerate(mesh, mesh.name);
        track_arrays(mesh);
    }
    scene.bounds = scene.ground_bounds = {};
    const auto place_object = [&](Object& o) {
        o.world = scene.nodes[o.node].world * o.instance;
        if (!finite(o.world)) return;
        (o.ground ? scene.ground_bounds : scene.bounds).add(scene.meshes[o.mesh].bounds.transformed(o.world));
    };
    for (Object& o : scene.objects) place_object(o);
    for (HiddenObject& h : scene.hidden) place_object(h.object);
    set_bounds_without_floor(scene);
    scene.id = next_version();
}

void hide_objects(Scene& scene, const std::set<std::string>& paths) {
    const auto wanted = [&](const Object& o) {
        return !paths.empty() && paths.contains(scene.nodes[std::size_t(o.node)].path);
    };
    if (std::ranges::none_of(scene.objects, wanted) &&
        std::ranges::all_of(scene.hidden, [&](const HiddenObject& h) { return wanted(h.object); }))
        return;
    std::vector<Object> shown;
    std::vector<HiddenObject> hidden;
    for (std::size_t place = 0; const Object* o : all_objects(scene)) {
        if (wanted(*o))
            hidden.push_back({place, *o});
        else
            shown.push_back(*o);
        ++place;
    }
    scene.objects = std::move(shown);
    scene.hidden = std::move(hidden);
    scene.id = next_version();
}

const ObjectSettings& object_settings(const Scene& scene, const Settings& settings, const Object& object) {
    static const ObjectSettings standard;
    if (settings.objects.empty() || object.node < 0) return standard;
    const auto it = settings.objects.find(scene.nodes[std::size_t(object.node)].path);
    return it == settings.objects.end() ? standard : it->second;
}

bool is_well_conditioned(const glm::dmat3& m) {
    constexpr double kMaxCondition = 30;  // 3 for a rotation
    const glm::dmat3 inverse = glm::inverse(m);
    double forth = 0, back = 0;
    for (int i = 0; i < 3; ++i) {
        forth += glm::dot(m[i], m[i]);
        back += glm::dot(inverse[i], inverse[i]);
    }
    return std::sqrt(forth * back) < kMaxCondition;  // false for NaN
}

std::vector<const Object*> all_objects(const Scene& scene) {
    std::vector<const Object*> all(scene.objects.size() + scene.hidden.size());
    auto shown = scene.objects.begin();
    auto hidden = scene.hidden.begin();
    for (std::size_t place = 0; place < all.size(); ++place) {
        const bool is_hidden = hidden != scene.hidden.end() && hidden->place == place;
        all[place] = is_hidden ? &hidden++->object : &*shown++;
    }
    return all;
}

std::vector<const Object*> objects_without_floor(const Scene& scene) {
    std::vector<const Object*> all = all_objects(scene), without_floor;
    std::erase_if(all, [&](const Object* o) {
        return o->ground || !finite(o->world) || scene.meshes[std::size_t(o->mesh)].bounds.empty();
    });
    const Bounds main = main_bounds(scene);
    std::ranges::copy_if(all, std::back_inserter(without_floor), [&](const Object* o) {
        return !is_floor(scene.meshes[std::size_t(o->mesh)].bounds.transformed(o->world), main);
    });
    return without_floor.empty() ? all : without_floor;
}

void place(Scene& scene, const glm::dmat4& placement) {
    scene.placement = placement;
    for (SceneCamera& camera : scene.cameras) camera.world = placement * camera.home;
    for (SceneLight& light : scene.lights) light.world = placement * light.home;
    refresh(scene);
}

double placement_scale(const Scene& scene) {
    return glm::length(glm::dvec3(scene.placement[0]));
}

Bounds main_bounds(const Scene& scene) {
    return scene.main_part.empty() ? scene.bounds : scene.main_part.transformed(scene.placement);
}

Bounds light_fit_bounds(const Scene& scene) {
    return scene.animation_bounds.empty() ? scene.bounds : scene.animation_bounds.transformed(scene.placement);
}

}  // namespace si
