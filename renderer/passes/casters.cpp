#include "renderer/passes/casters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <map>
#include <optional>

#include "renderer/bundle/imported_maps.h"
#include "renderer/optimisations/scene_findings.h"
#include "renderer/passes/caster_findings.h"
#include "renderer/projection/projection.h"
#include "renderer/projection/view_of_matrix.h"
#include "renderer/scene/clusters.h"
#include "renderer/settings/map_storage.h"
#include "renderer/view/culling/box_culling.h"

namespace si {
namespace {

/// Returns the culling of a batch's casters: the object's choice, else that of the map, else the scene's.
Cull cull_of(const FrameState& f, const CasterRaster* raster, const Batch& batch) {
    return cull_in_force(batch.cull, raster && raster->cull ? *raster->cull : f.settings.caster.cull);
}

/// Returns true when polygon offset changes the depths of a map.
bool offsets_polygons(const FrameState& f, const CasterRaster* raster) {
    if (!raster) return offsets_polygons(f.settings);
    return raster->offset_factor != 0 || raster->offset_units != 0;
}

void set_cull(Cull cull, bool mirrored) {
    if (cull == Cull::None) {
        glDisable(GL_CULL_FACE);
    } else {
        glEnable(GL_CULL_FACE);
        glCullFace(cull == Cull::Back ? GL_BACK : GL_FRONT);
    }
    glFrontFace(mirrored ? GL_CW : GL_CCW);
}

/// Sets the polygon offset of a map.
/// @param raster state of the map; null: as the settings say
void set_raster_bias(const FrameState& f, const CasterRaster* raster, bool reversed) {
    if (!offsets_polygons(f, raster)) {
        glDisable(GL_POLYGON_OFFSET_FILL);
        return;
    }
    glEnable(GL_POLYGON_OFFSET_FILL);
    const BiasSettings& b = f.settings.bias;
    const double sign = reversed ? -1 : 1;
    const CasterRaster used = raster ? *raster
                                     : CasterRaster{.offset_factor = sign * b.raster_slope,
                                                    .offset_units = sign * b.raster_units,
                                                    .offset_clamp = sign * b.raster_clamp,
                                                    .cull = {}};
    if (used.offset_clamp != 0 && f.driver.polygon_offset_clamp)
        glPolygonOffsetClampEXT(float(used.offset_factor), float(used.offset_units), float(used.offset_clamp));
    else
        glPolygonOffset(float(used.offset_factor), float(used.offset_units));
}

constexpr std::size_t kMostDirections = 1024, kMostPlanes = 4096;

/// Sine of the angle to a ray below which a side counts as edge-on.
constexpr double kEdgeOn = 1e-4;

/// Largest number of sides for the per-instance edge-on test. Meshes with more sides rarely pass it.
constexpr std::size_t kMaxFlatSides = 64;
/// Smallest height of a triangle in texels at which rounding of its corners does not matter.
constexpr double kMinTriangleTexels = 0.01;
/// Distance from a triangle, in steps of the rasteriser's grid, at which a texel may still count as covered.
constexpr double kRasterPadSteps = 4;
/// Rounding error of single-precision positions within a map, as share of its side.
constexpr double kFloatPositionError = 1e-6;

/// Share of a view's near plane. Casters nearer to the light may cover any texel.
constexpr double kMinDepthShare = 1e-3;
/// Padding in texels around the texels that a caster covers.
constexpr double kCasterPadTexels = 2;

MeshSides sides_of(const Mesh& mesh) {
    std::map<std::array<int, 3>, glm::dvec3> normals;
    std::map<std::array<int, 4>, MeshPlane> planes;
    double least_height = std::numeric_limits<double>::infinity();
    const double size = glm::length(glm::dvec3(mesh.bounds.hi) - glm::dvec3(mesh.bounds.lo));
    for (std::size_t i = 0; i + 2 < mesh.indices.size() && normals.size() <= kMostDirections; i += 3) {
        const glm::dvec3 a = mesh.positions[mesh.indices[i]], ab = glm::dvec3(mesh.positions[mesh.indices[i + 1]]) - a,
                         ac = glm::dvec3(mesh.positions[mesh.indices[i + 2]]) - a, n = glm::cross(ab, ac);
        const double length = glm::length(n);
        const double longest = std::sqrt(std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(ab - ac, ab - ac)}));
        if (longest > 0) least_height = std::min(least_height, length / longest);
        if (!(length > 0)) continue;
        const glm::dvec3 normal = n / length;
        const glm::ivec3 steps(glm::round(normal * 1e5));
        normals.try_emplace({steps.x, steps.y, steps.z}, normal);
        const int place = int(std::round(glm::dot(normal, a - glm::dvec3(mesh.bounds.lo)) / size * 1e5));
        if (planes.size() <= kMostPlanes) planes.try_emplace({steps.x, steps.y, steps.z, place}, MeshPlane{normal, a});
    }
    MeshSides out;
    if (normals.size() > kMostDirections) return out;
    out.least_height = least_height;
    for (const auto& [steps, normal] : normals) out.normals.push_back(normal);
    out.has_all_planes = planes.size() <= kMostPlanes;
    for (const auto& [steps, plane] : planes) out.planes.push_back(plane);
    return out;
}

const MeshSides& sides_of(FrameState& f, std::size_t mesh) {
    auto& sides = f.gl.caster_findings->sides.of(f.scene, mesh);
    if (!sides) sides = sides_of(f.scene.meshes[mesh]);
    return *sides;
}

/// Returns the origin of a view's rays, relative to the view's origin: a point with w = 1, or for parallel rays a
/// direction with w = 0, up to a factor.
glm::dvec4 ray_source(const glm::dmat4& clip) {
    const auto without = [&](int column) {
        glm::dmat3 m;
        for (int c = 0, to = 0; c < 4; ++c)
            if (c != column) m[to++] = {clip[c][0], clip[c][1], clip[c][3]};
        return glm::determinant(m);
    };
    return {without(0), -without(1), without(2), -without(3)};
}

/// Shader programs for drawing casters, batch after batch.
class CasterPrograms {
public:
    /// @param drops discards fragments that rounding moved outside the depth range
    CasterPrograms(const FrameState& f, const CasterView& view, bool drops) : f_(f), view_(view), drops_(drops) {}

    void use(const Batch& batch, bool bare) {
        if (!previous_ || previous_->masked != batch.masked || (batch.masked && !previous_->texture != !batch.texture))
            made_ = {};
        previous_ = batch;
        GLuint& id = made_[bare];
        const CasterShift& shift = view_.shift;
        if (id == 0) {
            std::vector<gl::Define> defines = {{"DROPS_STRAYS", drops_ && !bare ? "1" : "0"}};
            if (shift.moves()) defines.push_back({"MOVES_CASTERS", "1"});
            id = f_.batch_program("passes/depth.vert.glsl", "passes/depth.frag.glsl", defines, batch, true);
        }
        if (id != current_) {
            const glm::mat4 matrix(view_.clip_from_relative);
            const DepthCurve& curve = view_.curve;
            glUseProgram(current_ = id);
            glUniformMatrix4fv(glGetUniformLocation(id, "clip_from_relative"), 1, GL_FALSE, glm::value_ptr(matrix));
            if (holds_distances(f_.settings.map.format))
                glUniform4f(glGetUniformLocation(id, "curve"), float(curve.near), float(curve.far), curve.perspective,
                            curve.convention.reversed);
            if (shift.moves()) {
                const glm::vec3 away(view_.away_ws);
                glUniform3fv(glGetUniformLocation(id, "away_ws"), 1, glm::value_ptr(away));
                glUniform2f(glGetUniformLocation(id, "shift_m"), float(shift.all_m), float(shift.grazing_m));
            }
        }
        const GLuint mask = view_.unfiltered ? batch.finest_texture : batch.texture;
        if (batch.masked && mask && mask != texture_) glBindTextureUnit(shared::UNIT_BASE_COLOUR, texture_ = mask);
    }
    bool drops() const { return drops_; }

private:
    const FrameState& f_;
    const CasterView& view_;
    const bool drops_;
    std::optional<Batch> previous_;
    std::array<GLuint, 2> made_{};  ///< programs for opaque batches: with and without fragment shader
    GLuint current_ = 0, texture_ = 0;
};

/// Draws the casters of one view, batch by batch.
class CasterDrawer {
public:
    CasterDrawer(FrameState& f, const CasterView& view, const InstancePartsQuery& seen, CasterPrograms& programs,
                 PassInfo& info)
        : f_(f),
          view_(view),
          choice_(view.choice),
          seen_(seen),
          programs_(programs),
          info_(info),
          sight_(view.clip_from_relative, view.origin, view.curve.convention, view.clamps_near, view.size.shortest()),
          rays_from_(ray_source(view.clip_from_relative)),
          offset_(!view.unfiltered && offsets_polygons(f, view.choice.raster)),
          moves_(view.shift.moves()),
          skips_(!moves_ && !seen && !f.request.forced.contains(Optimisation::CasterCulling)),
          bares_(!moves_ && programs.drops() && !is_colour(f.settings.map.format) && !view.curve.perspective &&
                 !view.curve.warp && !f.request.forced.contains(Optimisation::CasterFragments)),
          uvd_from_relative_(uvd_from_clip(view.curve.convention) * view.clip_from_relative) {}

    void draw(const Batch& batch) {
        const bool closed =
            batch.closed && !batch.masked && !offset_ && !moves_ && cull_of(f_, choice_.raster, batch) == Cull::None;
        Run run{batch};
        run.batch.instances = 0;
        for (GLuint i = 0; i < GLuint(batch.instances); ++i) add(batch, batch.first_instance + i, closed, run);
        finish(run);
    }

    SkippedCasters skipped;

private:
    struct Run {
        Batch batch;
        bool fronts_alone = false, bare = false;
    };

    FrameState& f_;
    const CasterView& view_;
    const CasterChoice& choice_;
    const InstancePartsQuery& seen_;
    CasterPrograms& programs_;
    PassInfo& info_;
    BoxCuller sight_;
    glm::dvec4 rays_from_;
    bool offset_;
    bool moves_;  ///< casters lie elsewhere than their boxes
    bool skips_, bares_;
    glm::dmat4 uvd_from_relative_;
    std::vector<IndexRange> parts_;

    /// Adds an instance to the run, or draws the run and the needed parts of the instance.
    void add(const Batch& batch, GLuint instance, bool closed, Run& run) {
        const auto skip = [&](std::uint64_t& count) {
            ++count;
            finish(run);
        };
        if (choice_.only && !(*choice_.only)[instance]) return finish(run);
        if (skips_ && sight_.is_outside(box_of(instance))) return skip(skipped.outside_map);
        if (choice_.needed && !covers_needed(box_of(instance))) return skip(skipped.unread);
        const InstanceParts what = seen_            ? seen_(instance, parts_)
                                   : choice_.needed ? needed_part_of(instance)
                                                    : InstanceParts::Whole;
        if (what == InstanceParts::Parts && parts_.empty()) return skip(skipped.unread);
        if (choice_.covered && what != InstanceParts::Nothing) add_covered_cells(box_of(instance));
        const bool fronts_alone = closed && what != InstanceParts::Nothing && sight_.is_in_front(box_of(instance)) &&
                                  !has_edge_on_side(instance);
        const bool bare = bares_ && !batch.masked && what != InstanceParts::Nothing && stays_in_depth_range(instance);
        skipped.front_faces_only += fronts_alone;
        skipped.without_shader += bare;
        if (what != InstanceParts::Whole || fronts_alone != run.fronts_alone || bare != run.bare) finish(run);
        run.fronts_alone = fronts_alone;
        run.bare = bare;
        if (what == InstanceParts::Whole) {
            if (run.batch.instances++ == 0) run.batch.first_instance = instance;
            return;
        }
        for (const IndexRange& range : what == InstanceParts::Parts ? parts_ : std::vector<IndexRange>{}) {
            Run part{batch, fronts_alone, bare};
            part.batch.first_instance = instance;
            part.batch.instances = 1;
            part.batch.first_index += range.first;
            part.batch.index_count = range.count;
            finish(part);
        }
    }

    /// Returns the needed parts of an instance that covers needed cells. Large meshes are drawn by index ranges.
    InstanceParts needed_part_of(GLuint instance) {
        const Object& object = f_.scene.objects[f_.gl.scene->instance_objects()[instance]];
        const std::span<const Bounds> runs = mesh_run_boxes(f_, std::size_t(object.mesh));
        if (runs.empty()) return InstanceParts::Whole;
        const std::size_t indices = f_.scene.meshes[std::size_t(object.mesh)].indices.size();
        parts_.clear();
        for (std::size_t k = 0; k < runs.size(); ++k)
            if (covers_needed({runs[k], object.world}))
                append_index_range(parts_,
                                   {k * kRunIndices, GLsizei(std::min(kRunIndices, indices - k * kRunIndices))});
        return InstanceParts::Parts;
    }

    /// Returns the cells that a box may cover; nullopt: any.
    std::optional<Bounds2> covered_by(const SkewBox& box) const {
        if (moves_) return std::nullopt;
        const double before = view_.curve.perspective ? kMinDepthShare * view_.curve.near : 0;
        std::optional<Bounds2> rect = projected_rect(box, uvd_from_relative_, view_.origin, before);
        const glm::dvec2 room = kCasterPadTexels / view_.size.texels();
        if (rect) {
            rect->lo -= room;
            rect->hi += room;
        }
        return rect;
    }

    bool covers_needed(const SkewBox& box) const {
        const std::optional<Bounds2> rect = covered_by(box);
        return !rect || choice_.needed->overlaps(*rect);
    }

    void add_covered_cells(const SkewBox& box) {
        const std::optional<Bounds2> rect = covered_by(box);
        rect ? choice_.covered->add(*rect, false) : choice_.covered->add(MapCells::whole());
    }

    SkewBox box_of(GLuint instance) const {
        const Object& object = f_.scene.objects[f_.gl.scene->instance_objects()[instance]];
        return {f_.scene.meshes[std::size_t(object.mesh)].bounds, object.world};
    }

    /// Returns true when some side is edge-on to the light's rays. Such a side covers less than a step of the raster
    /// grid, or nothing. A texel centre may then be covered by a back face alone.
    bool has_edge_on_side(GLuint instance) const {
        const Object& object = f_.scene.objects[f_.gl.scene->instance_objects()[instance]];
        glm::dmat4 world = object.world;
        world[3] -= glm::dvec4(view_.origin, 0);
        const glm::dvec4 from = glm::inverse(world) * rays_from_;
        const auto is_edge_on = [](const glm::dvec3& normal, const glm::dvec3& ray) {
            return !(std::abs(glm::dot(normal, ray)) > kEdgeOn * glm::length(ray));
        };
        const MeshSides& mesh = sides_of(f_, std::size_t(object.mesh));
        if (from.w == 0)
            return std::ranges::any_of(mesh.normals,
                                       [&](const glm::dvec3& normal) { return is_edge_on(normal, glm::dvec3(from)); });
        return !mesh.has_all_planes || std::ranges::any_of(mesh.planes, [&](const MeshPlane& plane) {
            return is_edge_on(plane.normal, glm::dvec3(from) - plane.corner * from.w);
        });
    }

    /// Returns true when no covered texel can get a depth outside the map's range. All sides must be far from edge-on,
    /// so that their planes stay in range a few raster steps outside their triangles. For parallel rays.
    bool stays_in_depth_range(GLuint instance) const {
        const Object& object = f_.scene.objects[f_.gl.scene->instance_objects()[instance]];
        if (f_.scene.meshes[std::size_t(object.mesh)].deformer) return false;
        const MeshSides& mesh = sides_of(f_, std::size_t(object.mesh));
        if (mesh.normals.empty() || mesh.normals.size() > kMaxFlatSides) return false;
        const glm::dmat4& m = uvd_from_relative_;
        const glm::dvec3 u(m[0][0], m[1][0], m[2][0]), v(m[0][1], m[1][1], m[2][1]), z(m[0][2], m[1][2], m[2][2]);
        const SkewBox box = box_of(instance);
        double half = 0;
        for (int i = 0; i < 3; ++i) half += std::abs(glm::dot(z, box.half[i]));
        const double middle = glm::dot(z, box.centre - view_.origin) + m[3][2];
        const double before = view_.curve.convention.reversed ? 1 - middle - half : middle - half;
        if (!(before > 0)) return false;
        const glm::dmat3 back = glm::inverse(glm::dmat3(object.world));
        double shrinks = 0;  // lower bound of the factor between world and mesh lengths
        for (int i = 0; i < 3; ++i) shrinks += glm::dot(back[i], back[i]);
        const double texels = std::min(glm::length(u) * view_.size.width, glm::length(v) * view_.size.height);
        const double least_sine = kMinTriangleTexels * std::sqrt(shrinks) / (mesh.least_height * texels);
        const double beside =
            std::ldexp(kRasterPadSteps, -f_.driver.subpixel_bits) + kFloatPositionError * view_.size.longest();
        const double least_tangent = beside * glm::length(z) / (texels * before);
        const glm::dvec3 ray = glm::normalize(glm::cross(u, v));
        return std::ranges::all_of(mesh.normals, [&](const glm::dvec3& normal) {
            const double sine = std::abs(glm::dot(glm::normalize(normal * back), ray));
            return sine > least_sine && sine > least_tangent * std::sqrt(std::max(1 - sine * sine, 0.0));
        });
    }

    void finish(Run& run) {
        if (run.batch.instances == 0) return;
        programs_.use(run.batch, run.bare);
        set_cull(run.fronts_alone ? Cull::Back : cull_of(f_, choice_.raster, run.batch),
                 run.batch.mirrored != view_.mirrored);
        f_.draw_batch(run.batch, info_);
        if (run.fronts_alone && f_.request.forced.contains(Optimisation::CasterBackFaces)) draw_backs(run.batch);
        run.batch.instances = 0;
    }

    /// Draws back faces, moved away from the light. At a silhouette front and back coincide, and rounding would decide
    /// which is nearer.
    void draw_backs(const Batch& batch) {
        const float away = view_.curve.convention.reversed ? -1.f : 1.f;
        set_cull(Cull::Front, batch.mirrored != view_.mirrored);
        glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(away, 4 * away);
        f_.draw_batch(batch, info_);
        glDisable(GL_POLYGON_OFFSET_FILL);
    }
};

}  // namespace

void append_index_range(std::vector<IndexRange>& parts, IndexRange next) {
    if (!parts.empty() && parts.back().first + std::size_t(parts.back().count) == next.first)
        parts.back().count += next.count;
    else
        parts.push_back(next);
}

bool can_cast(const Scene& scene, const Settings& settings, const Object& object) {
    if (object.ground) return false;
    const int material = scene.meshes[std::size_t(object.mesh)].material;
    const bool blended = material >= 0 && scene.materials[std::size_t(material)].alpha == AlphaMode::Blend;
    if (blended && settings.caster.blend == BlendCasters::None) return false;
    return object_settings(scene, settings, object).cast;
}

bool is_drawn_into_maps(const FrameState& f, const Batch& batch) {
    return batch.cast && (!batch.blend || f.settings.caster.blend == BlendCasters::Mask);
}

void clear_casters(const FrameState& f, GLuint framebuffer, const DepthConvention& convention) {
    glDepthMask(GL_TRUE);
    const float far_depth = float(convention.far_depth());
    glClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far_depth);
    if (is_colour(f.settings.map.format)) {
        const glm::vec4 clear(far_depth);
        glClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, &clear.x);
    }
}

SkippedCasters draw_casters(FrameState& f, const CasterView& view, const InstancePartsQuery& seen, PassInfo& info) {
    const DepthConvention& convention = view.curve.convention;
    glClipControl(GL_LOWER_LEFT, convention.zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(convention.reversed ? GL_GREATER : GL_LESS);
    glDisable(GL_BLEND);
    if (view.unfiltered)
        glDisable(GL_POLYGON_OFFSET_FILL);
    else
        set_raster_bias(f, view.choice.raster, convention.reversed);
    if (view.clamps_near) glEnable(GL_DEPTH_CLAMP);
    f.gl.scene->bind_vertices(f.scene, f.settings, view.origin, SceneGpu::Drawn::Casters);
    // Casters outside the range: flattened by the near plane, or moved there by polygon offset.
    const bool strays = !view.clamps_near && (view.unfiltered || !offsets_polygons(f, view.choice.raster));
    CasterPrograms programs(f, view, strays);
    CasterDrawer drawer(f, view, seen, programs, info);
    for (const Batch& drawn : f.gl.scene->batches()) {
        if (!is_drawn_into_maps(f, drawn)) continue;
        Batch batch = drawn;
        batch.masked |= batch.blend;
        drawer.draw(batch);
    }
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_DEPTH_CLAMP);
    return drawer.skipped;
}

SkippedCasters draw_casters(FrameState& f, const gl::Framebuffer& into, bool unfiltered, const FittedLight& light,
                            const LightView& view, PassInfo& info, const CasterChoice& choice) {
    const GLuint framebuffer = into.id();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, f.map_size.width, f.map_size.height);
    if (!choice.keeps_contents) clear_casters(f, framebuffer, view.curve.convention);
    CasterView whole{view.clip_from_relative(light.map_origin),
                     view.curve,
                     light.map_origin,
                     unfiltered,
                     view.clamps_near,
                     f.map_size,
                     choice,
                     is_mirrored(view),
                     -view.axes[2],
                     view.caster_shift};
    if (choice.needed && choice.needed->is_whole()) whole.choice.needed = nullptr;
    return draw_casters(f, whole, {}, info);
}

}  // namespace si
