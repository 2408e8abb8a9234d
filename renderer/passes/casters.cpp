#include "renderer/passes/casters.h"

#include <glm/gtc/type_ptr.hpp>
#include <optional>

#include "renderer/frame/driver.h"
#include "renderer/settings/map_storage.h"

namespace si {
namespace {

/// Culling of casters: the object's own choice before the scene's.
void set_cull(const FrameState& f, const Batch& batch) {
    Cull cull = Cull(f.settings.caster.cull);
    if (batch.cull != int(ObjectCull::Inherit)) cull = Cull(batch.cull - 1);
    if (cull == Cull::None) {
        glDisable(GL_CULL_FACE);
    } else {
        glEnable(GL_CULL_FACE);
        glCullFace(cull == Cull::Back ? GL_BACK : GL_FRONT);
    }
    glFrontFace(batch.mirrored ? GL_CW : GL_CCW);
}

void set_raster_bias(const FrameState& f, bool reversed) {
    const BiasSettings& b = f.settings.bias;
    if (!offsets_polygons(f.settings)) {
        glDisable(GL_POLYGON_OFFSET_FILL);
        return;
    }
    glEnable(GL_POLYGON_OFFSET_FILL);
    const float sign = reversed ? -1.f : 1.f;
    if (b.raster_clamp != 0 && f.driver.polygon_offset_clamp)
        glPolygonOffsetClampEXT(sign * float(b.raster_slope), sign * float(b.raster_units),
                                sign * float(b.raster_clamp));
    else
        glPolygonOffset(sign * float(b.raster_slope), sign * float(b.raster_units));
}

/// The instances of a batch in runs of those that are seen whole, and parts of others.
void draw_seen(FrameState& f, const Batch& batch, const SeenOf& seen, PassInfo& info) {
    const auto draw = [&](const Batch& part) {
        f.gl.scene->draw(part);
        ++info.draws;
        info.triangles += part.triangles();
    };
    if (!seen) return draw(batch);
    Batch run = batch;
    run.instances = 0;
    const auto finish_run = [&] {
        if (run.instances > 0) draw(run);
        run.instances = 0;
    };
    std::vector<IndexRange> parts;
    for (GLuint i = 0; i < GLuint(batch.instances); ++i) {
        const GLuint instance = batch.first_instance + i;
        const Seen what = seen(instance, parts);
        if (what == Seen::Whole) {
            if (run.instances == 0) run.first_instance = instance;
            ++run.instances;
            continue;
        }
        finish_run();
        for (const IndexRange& range : what == Seen::Parts ? parts : std::vector<IndexRange>{}) {
            Batch part = batch;
            part.first_instance = instance, part.instances = 1;
            part.first_index += range.first, part.index_count = range.count;
            draw(part);
        }
    }
    finish_run();
}

}  // namespace

bool casts_at_all(const FrameState& f, const Object& object) {
    const Scene& scene = f.scene;
    const int material = scene.meshes[std::size_t(object.mesh)].material;
    const bool blended = material >= 0 && scene.materials[std::size_t(material)].alpha == AlphaMode::Blend;
    if (blended && f.settings.caster.blend == int(BlendCasters::None)) return false;
    const auto own = f.settings.objects.find(scene.nodes[std::size_t(object.node)].path);
    return own == f.settings.objects.end() || own->second.cast;
}

bool draws_into_maps(const FrameState& f, const Batch& batch) {
    return batch.cast && (!batch.blend || f.settings.caster.blend == int(BlendCasters::Mask));
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

void draw_casters(FrameState& f, const CasterView& view, const SeenOf& seen, PassInfo& info) {
    const DepthConvention& convention = view.curve.convention;
    glClipControl(GL_LOWER_LEFT, convention.zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(convention.reversed ? GL_GREATER : GL_LESS);
    glDisable(GL_BLEND);
    if (view.unfiltered)
        glDisable(GL_POLYGON_OFFSET_FILL);
    else
        set_raster_bias(f, convention.reversed);
    if (view.clamps_near) glEnable(GL_DEPTH_CLAMP);
    const glm::mat4 matrix(view.clip_from_relative);
    f.gl.scene->bind(f.scene, f.settings, view.origin, 1);
    GLuint current = 0, texture = 0;
    std::optional<Batch> previous;
    for (const Batch& drawn : f.gl.scene->batches()) {
        if (!draws_into_maps(f, drawn)) continue;
        Batch batch = drawn;
        batch.masked |= batch.blend;
        const bool same =
            previous && previous->masked == batch.masked && (!batch.masked || !previous->texture == !batch.texture);
        const GLuint id =
            same ? current : f.batch_program("passes/depth.vert.glsl", "passes/depth.frag.glsl", {}, batch, true);
        if (id != current) {
            glUseProgram(current = id);
            glUniformMatrix4fv(glGetUniformLocation(id, "clip_from_relative"), 1, GL_FALSE, glm::value_ptr(matrix));
            if (holds_distances(f.settings.map.format))
                glUniform4f(glGetUniformLocation(id, "curve"), float(view.curve.near), float(view.curve.far),
                            view.curve.perspective, convention.reversed);
        }
        const GLuint mask = view.unfiltered ? batch.finest_texture : batch.texture;
        if (batch.masked && mask && mask != texture) glBindTextureUnit(shared::UNIT_BASE_COLOUR, texture = mask);
        if (!previous || previous->cull != batch.cull || previous->mirrored != batch.mirrored) set_cull(f, batch);
        previous = batch;
        draw_seen(f, batch, seen, info);
    }
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_DEPTH_CLAMP);
}

void draw_casters(FrameState& f, const gl::Framebuffer& into, bool unfiltered, const FittedLight& light,
                  const LightView& view, PassInfo& info) {
    const GLuint framebuffer = into.id();
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, f.map_resolution, f.map_resolution);
    clear_casters(f, framebuffer, view.curve.convention);
    draw_casters(
        f, {view.clip_from_relative(light.map_origin), view.curve, light.map_origin, unfiltered, view.clamps_near}, {},
        info);
}

}  // namespace si
