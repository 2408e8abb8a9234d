#include "renderer/frame/scene_gpu.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/base/printable.h"
#include "renderer/gl/driver_failure.h"
#include "renderer/gl/target.h"
#include "renderer/scene/face_normals.h"
#include "shaders/shared/units.h"

namespace si {
namespace {

struct Attributes {
    glm::vec3 normal;
    glm::vec2 uv;
};

/// Vertex attributes of normal-mapped materials.
struct NormalMapAttributes {
    glm::vec2 uv;
    float scale;
    glm::vec4 tangent;
};

struct InstanceData {
    glm::vec4 rows[3];
    glm::vec4 base_colour;
    glm::vec4 surface;  // receives, alpha cutoff, unlit, object number
    glm::vec3 normal_rows[3];
};

/// Returns the matrix that transforms normals, up to length: the cofactors of the world matrix. Cofactors need no
/// division and are valid for any scale, singular ones included. A mirroring flips their sign, which is undone. The
/// result is scaled to 1 so that floats hold it at any size.
glm::dmat3 normal_matrix(const glm::dmat3& m) {
    glm::dmat3 c(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    double largest = 0;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(c[i][k]));
    if (!(largest > 0)) return glm::dmat3(0.0);
    return c * ((glm::dot(m[0], c[0]) < 0 ? -1.0 : 1.0) / largest);
}

/// Returns for each mesh the size of its largest object, as a power of two in metres. Large objects, such as a ground
/// or a room's walls, lie mostly behind small ones. Drawn after them, most of their hidden fragments are never shaded.
/// The order is independent of the camera, so that the same one of two coplanar surfaces always wins.
std::vector<int> mesh_sizes(const Scene& scene) {
    std::vector<int> sizes(scene.meshes.size(), std::numeric_limits<int>::min());
    for (const Object& o : scene.objects) {
        const double radius_m = scene.meshes[std::size_t(o.mesh)].bounds.transformed(o.world).radius();
        if (radius_m > 0) sizes[std::size_t(o.mesh)] = std::max(sizes[std::size_t(o.mesh)], std::ilogb(radius_m));
    }
    return sizes;
}

template <typename T>
void store(gl::Buffer& buffer, std::string_view label, const std::vector<T>& data) {
    gl::store_buffer(buffer, label, GLsizeiptr(std::max<std::size_t>(data.size() * sizeof(T), 16)),
                     data.empty() ? nullptr : data.data(), data.size() * sizeof(T) >= 16 ? 0 : GL_DYNAMIC_STORAGE_BIT);
}

GLenum wrap_mode(TextureWrap wrap) {
    return wrap == TextureWrap::Repeat ? GL_REPEAT : wrap == TextureWrap::Clamp ? GL_CLAMP_TO_EDGE : GL_MIRRORED_REPEAT;
}

}  // namespace

SceneGpu::SceneGpu(const Scene& scene, bool anisotropy, std::unique_ptr<SceneGpu> before) : scene_id_(scene.id) {
    for (const Mesh& m : scene.meshes) meshes_as_uploaded_.emplace_back(scene, m);
    for (const Texture& t : scene.textures) textures_as_uploaded_.emplace_back(t);
    find_watertight_meshes(scene, before.get());
    const bool same_textures = before && before->has_textures_of(scene);
    if (same_textures) textures_ = std::move(before->textures_);
    before.reset();
    upload_geometry(scene);
    if (!same_textures) upload_textures(scene, anisotropy);
}

bool SceneGpu::has_textures_of(const Scene& scene) const {
    return std::ranges::equal(textures_as_uploaded_, scene.textures,
                              [](const TextureIdentity& before, const Texture& now) { return before.is(now); });
}

bool SceneGpu::adopt_if_compatible(const Scene& scene) {
    const auto same_mesh = [&](const MeshIdentity& before, const Mesh& now) { return before.is(scene, now); };
    if (!std::ranges::equal(meshes_as_uploaded_, scene.meshes, same_mesh) || !has_textures_of(scene)) return false;
    scene_id_ = scene.id;
    return true;
}

void SceneGpu::find_watertight_meshes(const Scene& scene, SceneGpu* before) {
    bodies_.assign(scene.meshes.size(), {});
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const Mesh& m = scene.meshes[i];
        if (before && i < before->bodies_.size() && before->meshes_as_uploaded_[i].is(scene, m))
            bodies_[i] = std::move(before->bodies_[i]);
        // Deformed meshes change with each pose.
        else if (!m.deformer && material_of(scene, m).alpha == AlphaMode::Opaque)
            bodies_[i] = check_watertight(m.positions, m.indices);
    }
}

void SceneGpu::upload_geometry(const Scene& scene) {
    std::size_t vertex_count = 0, index_count = 0;
    bool coloured = false;
    std::vector<FlatNormalMesh> faced(scene.meshes.size());
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const Mesh& m = scene.meshes[i];
        faced[i] = face_normals(m.positions, m.indices);
        vertex_count += faced[i].normals.size();
        index_count += m.indices.size();
        coloured |= !m.colours.empty();
    }
    positions_ = gl::Buffer::create("positions");
    attributes_ = gl::Buffer::create("normals and uv");
    faces_ = gl::Buffer::create("normals of triangles");
    indices_ = gl::Buffer::create("indices");
    faced_indices_ = gl::Buffer::create("indices that end with the triangle's normal");
    const auto allocate = [](gl::Buffer& b, std::size_t bytes) {
        gl::store_buffer(b, "scene's vertices", GLsizeiptr(std::max<std::size_t>(bytes, 16)), nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
    };
    allocate(positions_, vertex_count * sizeof(glm::vec3));
    allocate(attributes_, vertex_count * sizeof(Attributes));
    allocate(faces_, vertex_count * sizeof(glm::vec3));
    allocate(indices_, index_count * sizeof(std::uint32_t));
    allocate(faced_indices_, index_count * sizeof(std::uint32_t));
    std::vector<glm::u8vec4> colours(coloured ? vertex_count : 0, glm::u8vec4(255));
    std::size_t vertex = 0, index = 0;
    std::vector<glm::vec3> positions;
    std::vector<Attributes> attributes;
    for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        const Mesh& m = scene.meshes[mesh];
        const FlatNormalMesh& f = faced[mesh];
        const std::size_t n = f.normals.size();
        ranges_.push_back({index, GLsizei(m.indices.size()), GLint(vertex), f.copies});
        if (n == 0 || m.indices.empty()) continue;
        attributes.resize(n);
        positions.resize(n);
        SharedArray<glm::vec3> seamless = m.positions;
        for (const auto& [moved, there] : bodies_[mesh].joined) seamless.edit()[moved] = m.positions[there];
        const auto source = [&](std::size_t i) { return ranges_.back().source(m.positions.size(), i); };
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t from = source(i);
            positions[i] = seamless[from];
            attributes[i] = {m.normals.empty() ? glm::vec3(0, 1, 0) : m.normals[from],
                             m.uv.empty() ? glm::vec2(0) : m.uv[from]};
            if (!m.colours.empty())
                colours[vertex + i] = glm::u8vec4(glm::round(glm::clamp(m.colours[from], 0.f, 1.f) * 255.f));
        }
        const auto put = [](const gl::Buffer& buffer, std::size_t first, const auto& data) {
            glNamedBufferSubData(buffer.id(), GLintptr(first * sizeof data[0]),
                                 GLsizeiptr(data.size() * sizeof data[0]), data.data());
        };
        put(positions_, vertex, positions);
        put(attributes_, vertex, attributes);
        put(faces_, vertex, f.normals);
        put(indices_, index, m.indices);
        put(faced_indices_, index, f.indices);
        vertex += n;
        index += m.indices.size();
    }
    vao_ = gl::VertexArray::create("scene");
    const GLuint vao = vao_.id();
    gl::enable_attribute(vao_, 0, 0, 3);
    gl::enable_attribute(vao_, 1, 1, 3);
    gl::enable_attribute(vao_, 2, 1, 2, offsetof(Attributes, uv));
    gl::enable_attribute(vao_, 14, 5, 3);
    gl::enable_attribute(vao_, 7, 3, 4, offsetof(InstanceData, base_colour));
    gl::enable_attribute(vao_, 8, 3, 4, offsetof(InstanceData, surface));
    for (GLuint row = 0; row < 3; ++row) {
        gl::enable_attribute(vao_, 4 + row, 3, 4, row * 16);
        gl::enable_attribute(vao_, 9 + row, 3, 3, GLuint(offsetof(InstanceData, normal_rows)) + row * 12);
    }
    glVertexArrayBindingDivisor(vao, 3, 1);
    glVertexArrayVertexBuffer(vao, 0, positions_.id(), 0, sizeof(glm::vec3));
    glVertexArrayVertexBuffer(vao, 1, attributes_.id(), 0, sizeof(Attributes));
    glVertexArrayVertexBuffer(vao, 5, faces_.id(), 0, sizeof(glm::vec3));
    if (coloured) {
        colours_ = gl::Buffer::create("vertex colours");
        store(colours_, "vertex colours", colours);
        gl::enable_attribute(vao_, 3, 2, 4, 0, GL_UNSIGNED_BYTE);
        glVertexArrayVertexBuffer(vao, 2, colours_.id(), 0, 4);
    }
    upload_normal_map_attributes(scene, vertex_count);
}

void SceneGpu::upload_normal_map_attributes(const Scene& scene, std::size_t vertex_count) {
    const auto mapped = [&](const Mesh& m) { return !m.indices.empty() && material_of(scene, m).normal_texture >= 0; };
    if (std::none_of(scene.meshes.begin(), scene.meshes.end(), mapped)) return;
    std::vector<NormalMapAttributes> data(vertex_count);
    for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        const Mesh& m = scene.meshes[mesh];
        if (!mapped(m)) continue;
        const SharedArray<glm::vec2>& uv = m.uv_normal.empty() ? m.uv : m.uv_normal;
        const MeshRange& range = ranges_[mesh];
        NormalMapAttributes* out = data.data() + range.base_vertex;
        for (std::size_t i = 0; i < m.positions.size() + range.copies.size(); ++i) {
            const std::size_t from = range.source(m.positions.size(), i);
            out[i] = {uv.empty() ? glm::vec2(0) : uv[from], material_of(scene, m).normal_scale,
                      m.tangents.empty() ? glm::vec4(0) : m.tangents[from]};
        }
    }
    normal_map_ = gl::Buffer::create("normal map coordinates");
    store(normal_map_, "normal map coordinates", data);
    gl::enable_attribute(vao_, 12, 4, 3);
    gl::enable_attribute(vao_, 13, 4, 4, offsetof(NormalMapAttributes, tangent));
    glVertexArrayVertexBuffer(vao_.id(), 4, normal_map_.id(), 0, sizeof(NormalMapAttributes));
}

void SceneGpu::upload_textures(const Scene& scene, bool anisotropy) {
    for (const Texture& t : scene.textures) {
        if (t.width <= 0 || t.height <= 0 || t.rgba.empty()) {
            textures_.emplace_back();
            continue;
        }
        auto texture = gl::Texture::create(t.name.empty() ? "texture" : t.name, GLenum(GL_TEXTURE_2D));
        const int levels = t.mipmaps ? gl::mip_levels(std::max(t.width, t.height)) : 1;
        gl::clear_gl_errors();
        glTextureStorage2D(texture.id(), levels, t.srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, t.width, t.height);
        gl::check_memory_errors(fmt::format("the texture {} ({} x {})", printable(t.name), t.width, t.height),
                                "use a scene with smaller textures, or a lower map.resolution");
        glTextureSubImage2D(texture.id(), 0, 0, 0, t.width, t.height, GL_RGBA, GL_UNSIGNED_BYTE, t.rgba.data());
        if (levels > 1) glGenerateTextureMipmap(texture.id());
        gl::track_image_memory(texture, "scene's textures", {.levels = levels});
        const GLint mag_filter = t.nearest_mag ? GL_NEAREST : GL_LINEAR;
        const auto set = [&](GLuint id, GLint min_filter) {
            glTextureParameteri(id, GL_TEXTURE_WRAP_S, GLint(wrap_mode(t.wrap_s)));
            glTextureParameteri(id, GL_TEXTURE_WRAP_T, GLint(wrap_mode(t.wrap_t)));
            glTextureParameteri(id, GL_TEXTURE_MAG_FILTER, mag_filter);
            glTextureParameteri(id, GL_TEXTURE_MIN_FILTER, min_filter);
        };
        const GLint min_filter = levels > 1 ? (t.nearest_min ? GL_NEAREST_MIPMAP_LINEAR : GL_LINEAR_MIPMAP_LINEAR)
                                            : (t.nearest_min ? GL_NEAREST : GL_LINEAR);
        set(texture.id(), min_filter);
        if (anisotropy && levels > 1 && !t.nearest_min)
            glTextureParameterf(texture.id(), GL_TEXTURE_MAX_ANISOTROPY_EXT, 4.0f);
        gl::Texture finest;
        if (levels > 1) {
            GLuint id = 0;
            glGenTextures(1, &id);
            glTextureView(id, GL_TEXTURE_2D, texture.id(), t.srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8, 0, 1, 0, 1);
            finest = gl::Texture::adopt("finest level", id);
            set(id, mag_filter);  // minified as where magnified
        }
        textures_.push_back({std::move(texture), std::move(finest)});
    }
}

void SceneGpu::update_batches(const Scene& scene, const Settings& settings) {
    Key key;
    const bool blend_casts = settings.caster.blend == BlendCasters::Mask;
    key.add(scene.id).add(settings.shading.textures).add(blend_casts);
    for (const auto& [path, o] : settings.objects) key.add(path).add(o.cull).add(o.cast).add(o.receive);
    if (key.value() == arrangement_.value()) return;
    arrangement_ = key;

    struct Entry {
        std::uint32_t object;
        int size, mesh;
        Batch alone;  ///< batch of the object alone
        /// State shared by the instances of one batch.
        auto batch() const {
            const Batch& b = alone;
            return std::tuple(b.blend, b.masked, size, b.texture, b.normal_texture, mesh, b.cull, b.cast, b.mirrored);
        }
        auto rank() const { return std::tuple_cat(batch(), std::tuple(object)); }
    };
    std::vector<Entry> entries;
    entries.reserve(scene.objects.size());
    const std::vector<int> sizes = mesh_sizes(scene);
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        const Object& o = scene.objects[i];
        const Mesh& mesh = scene.meshes[std::size_t(o.mesh)];
        if (mesh.indices.empty()) continue;
        const Material& material = material_of(scene, mesh);
        const ObjectSettings& own = object_settings(scene, settings, o);
        GLuint texture = 0, finest_texture = 0;
        const bool masked = material.alpha == AlphaMode::Mask;
        // A mask lives in its texture, so it stays even where textures are switched off.
        const bool blend = material.alpha == AlphaMode::Blend;
        if (material.base_colour_texture >= 0 && (settings.shading.textures || masked || (blend && blend_casts))) {
            const SceneTexture& t = textures_[std::size_t(material.base_colour_texture)];
            texture = t.whole.id();
            finest_texture = t.finest_id();
        }
        GLuint normal_texture = 0;
        if (material.normal_texture >= 0 && settings.shading.textures && !material.unlit)
            normal_texture = textures_[std::size_t(material.normal_texture)].whole.id();
        const MeshRange& r = ranges_[std::size_t(o.mesh)];
        const Batch alone{.index_count = r.index_count,
                          .first_index = r.first_index,
                          .base_vertex = r.base_vertex,
                          .instances = 1,
                          .texture = texture,
                          .finest_texture = finest_texture,
                          .normal_texture = normal_texture,
                          .tangents = !mesh.tangents.empty(),
                          .mirrored = glm::determinant(glm::dmat3(o.world)) < 0,
                          .masked = masked,
                          .blend = blend,
                          .double_sided = material.double_sided,
                          .cast = own.cast && !o.ground,
                          .closed = bodies_[std::size_t(o.mesh)].closed,
                          .ground = o.ground,
                          .cull = own.cull,
                          .centre_ws = glm::dvec3(o.world * glm::dvec4(mesh.bounds.centre(), 1))};
        entries.push_back({i, blend ? 0 : sizes[std::size_t(o.mesh)], o.mesh, alone});
    }
    std::vector<const Entry*> sorted;
    for (const Entry& e : entries) sorted.push_back(&e);
    std::ranges::sort(sorted, {}, [](const Entry* e) { return e->rank(); });
    order_.clear();
    batch_of_.clear();
    batches_.clear();
    const Entry* previous = nullptr;
    for (const Entry* e : sorted) {
        // Blended instances are drawn one by one, back to front.
        if (previous && !e->alone.blend && previous->batch() == e->batch()) {
            ++batches_.back().instances;
        } else {
            batches_.push_back(e->alone);
            batches_.back().first_instance = GLuint(order_.size());
        }
        order_.push_back(e->object);
        batch_of_.push_back(std::uint32_t(batches_.size() - 1));
        previous = e;
    }
}

void SceneGpu::set_camera_instances(std::span<const std::uint32_t> instances) {
    Key key = arrangement_;
    key.add(instances.size());
    for (const std::uint32_t i : instances) key.add(i);
    if (key.value() == seen_arrangement_.value()) return;
    seen_arrangement_ = key;
    seen_order_.clear();
    seen_batches_.clear();
    std::uint32_t previous = 0;
    for (const std::uint32_t i : instances) {
        const Batch& arranged = batches_[batch_of_[i]];
        if (!seen_batches_.empty() && previous == batch_of_[i] && !arranged.blend) {
            ++seen_batches_.back().instances;
        } else {
            seen_batches_.push_back(arranged);
            seen_batches_.back().first_instance = GLuint(seen_order_.size());
            seen_batches_.back().instances = 1;
        }
        seen_order_.push_back(order_[i]);
        previous = batch_of_[i];
    }
}

void SceneGpu::bind_vertices(const Scene& scene, const Settings& settings, const glm::dvec3& origin, Drawn drawn) {
    Slot& slot = slots_[std::size_t(drawn)];
    const bool seen = drawn == Drawn::Seen;
    const std::vector<std::uint32_t>& order = seen ? seen_order_ : order_;
    Key key = seen ? seen_arrangement_ : arrangement_;
    key.add(origin);
    if (slot.key != key.value()) {
        std::vector<InstanceData> data(order.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            const Object& o = scene.objects[order[i]];
            const Material& material = material_of(scene, scene.meshes[std::size_t(o.mesh)]);
            glm::dmat4 m = o.world;
            m[3] -= glm::dvec4(origin, 0);  // in double precision, as the difference is small
            for (int r = 0; r < 3; ++r) data[i].rows[r] = glm::vec4(m[0][r], m[1][r], m[2][r], m[3][r]);
            const glm::dmat3 normal = normal_matrix(glm::dmat3(o.world));
            for (int r = 0; r < 3; ++r) data[i].normal_rows[r] = glm::vec3(normal[0][r], normal[1][r], normal[2][r]);
            data[i].base_colour = material.base_colour;
            const bool receives = settings.objects.empty() || object_settings(scene, settings, o).receive;
            // Blended objects have an alpha cutoff for shadow maps only.
            const float cutoff = material.alpha == AlphaMode::Mask    ? material.alpha_cutoff
                                 : material.alpha == AlphaMode::Blend ? 0.5f
                                                                      : -1.f;
            data[i].surface = {receives ? 1.f : 0.f, cutoff, material.unlit ? 1.f : 0.f, float(order[i])};
        }
        slot.buffer = gl::Buffer::create(seen                      ? "instances for the camera"
                                         : drawn == Drawn::Casters ? "instances for the lights"
                                                                   : "instances for shadow volumes");
        store(slot.buffer, "matrices of objects", data);
        slot.key = key.value();
    }
    glBindVertexArray(vao_.id());
    glVertexArrayElementBuffer(vao_.id(), seen ? faced_indices_.id() : indices_.id());
    glVertexArrayVertexBuffer(vao_.id(), 3, slot.buffer.id(), 0, sizeof(InstanceData));
}

void SceneGpu::bind_triangles() const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shared::STORAGE_SCENE_POSITIONS, positions_.id());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shared::STORAGE_SCENE_INDICES, faced_indices_.id());
}

void SceneGpu::bind_transforms(const gl::VertexArray& vao, GLuint binding, Drawn drawn) const {
    for (GLuint row = 0; row < 3; ++row) gl::enable_attribute(vao, 4 + row, binding, 4, row * 16);
    glVertexArrayBindingDivisor(vao.id(), binding, 1);
    glVertexArrayVertexBuffer(vao.id(), binding, slots_[std::size_t(drawn)].buffer.id(), 0, sizeof(InstanceData));
}

void SceneGpu::draw_batch(const Batch& b) const {
    glDrawElementsInstancedBaseVertexBaseInstance(GL_TRIANGLES, b.index_count, GL_UNSIGNED_INT,
                                                  reinterpret_cast<const void*>(b.first_index * 4), b.instances,
                                                  b.base_vertex, b.first_instance);
}

}  // namespace si
