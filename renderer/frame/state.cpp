#include "renderer/frame/state.h"

#include <algorithm>
#include <array>
#include <glm/gtc/type_ptr.hpp>

#include "renderer/frame/driver.h"
#include "renderer/frame/requested_maps.h"
#include "renderer/frame/settings_block.h"
#include "renderer/settings/biases.h"
#include "renderer/settings/filters.h"
#include "renderer/settings/idle_reason.h"
#include "renderer/settings/map_storage.h"
#include "renderer/view/fits/light_fit.h"

namespace si {
bool FrameState::reads_corners(std::string_view fragment) const {
    constexpr std::array<std::string_view, 4> kReaders{"passes/overlay.frag.glsl", "passes/evidence.frag.glsl",
                                                       "passes/causes.frag.glsl", "passes/faint_acne.frag.glsl"};
    const bool floats = settings.map.format == MapFormat::D32F || settings.map.format == MapFormat::Colour;
    return floats && settings.bias.raster_units != 0 && std::ranges::find(kReaders, fragment) != kReaders.end();
}

GLuint FrameState::program(std::string_view vertex, std::string_view fragment, std::vector<gl::Define> extra) const {
    gl::ProgramRequest wanted;
    wanted.vertex = vertex;
    wanted.fragment = fragment;
    wanted.includes["FILTER_FILE"] = filter_of(settings).file;
    wanted.includes["BIAS_FILE"] = bias_of(settings).file;
    wanted.defines = defines;
    for (gl::Define& d : extra) {
        if (d.name.ends_with("_FILE"))
            wanted.includes[d.name] = d.value;
        else if (const auto known = std::find_if(wanted.defines.begin(), wanted.defines.end(),
                                                 [&](const gl::Define& k) { return k.name == d.name; });
                 known != wanted.defines.end())
            known->value = std::move(d.value);
        else
            wanted.defines.push_back(std::move(d));
    }
    wanted.preamble = preamble;
    return gl.programs.get(wanted);
}

void FrameState::bind_results(std::span<const ResultRef> results) const {
    for (const ResultRef& r : results)
        for (const PlacedImage& image : plan.images(r)) {
            if (image.unit < 0 || !image.target->texture) continue;
            glBindTextureUnit(GLuint(image.unit), image.target->texture.id());
            glBindSampler(GLuint(image.unit), image.sampler ? image.sampler->id() : 0);
        }
}

void FrameState::place_compared_maps(const gl::Target& maps) {
    plan.place_result(Result::ShadowMaps, {&maps, shared::UNIT_SHADOW_MAP, &gl.map_nearest});
    if (!is_colour(settings.map.format))
        plan.place_result(Result::ShadowMaps, {&maps, shared::UNIT_SHADOW_MAP_COMPARE, &gl.map_compare});
}

void FrameState::begin_camera_pass(GLuint framebuffer) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, request.width, request.height);
    glClipControl(GL_LOWER_LEFT, camera.curve.convention.zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    // The last drawn of two coplanar surfaces wins, in passes that draw the depth and in passes that test against it.
    glDepthFunc(camera.curve.convention.reversed ? GL_GEQUAL : GL_LEQUAL);
    glDepthMask(GL_TRUE);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_BLEND);
}

GLenum FrameState::map_format() const {
    return map_internal_format(settings.map.format);
}

bool FrameState::may_light_picture(std::size_t light) const {
    return !adds_no_light(gl.fitted[light], settings) || request.forced.contains(Optimisation::DeadPasses);
}

bool FrameState::shades_as_lit(std::size_t light) const {
    return !separate_visibility && is_always_lit(gl.fitted[light], settings) &&
           !request.forced.contains(Optimisation::DeadPasses);
}

const ImportedMaps* FrameState::imported(std::size_t light) const {
    const ImportedMaps* maps = gl.fitted[light].casts ? requested_maps(request, light) : nullptr;
    return maps && maps->has_images() ? maps : nullptr;
}

bool FrameState::needs_unfiltered_map() const {
    return offsets_polygons(settings) || mask_levels;
}

Key FrameState::with_settings(Key from, ReadBy pass, const Settings& values) {
    for (const Param& p : params())
        if (is_read_by(p.read_by, pass) && idle_reason(values, {&p, 0, {}}).empty())
            add_value(from, values, {&p, 0, {}});
    return from;
}

const LightView* FrameState::shown_view(int* layer) const {
    const auto light = std::size_t(settings.view.light);
    if (light >= gl.fitted.size() || !gl.fitted[light].casts) return nullptr;
    const auto& views = gl.fitted[light].views;
    const int face = std::min(settings.view.face, int(views.size()) - 1);
    if (layer) *layer = first_view[light] + face;
    return &views[std::size_t(face)];
}

void FrameState::begin_fullscreen_pass(GLuint framebuffer, int width, int height) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, width, height);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glBindVertexArray(gl.empty_vao.id());
}

gl::Framebuffer FrameState::begin_fullscreen_pass(std::string_view label, const gl::Target& into, int layer) const {
    gl::Framebuffer framebuffer = gl::make_framebuffer(label, &into, nullptr, layer);
    begin_fullscreen_pass(framebuffer.id(), into.width, into.height);
    return framebuffer;
}

GLuint FrameState::use_fullscreen(std::string_view fragment, std::vector<gl::Define> extra) const {
    const GLuint id = program("passes/fullscreen.vert.glsl", fragment, std::move(extra));
    glUseProgram(id);
    return id;
}

void FrameState::draw_fullscreen(PassInfo& info) {
    glDrawArrays(GL_TRIANGLES, 0, 3);
    ++info.draws;
    ++info.triangles;
}

void FrameState::draw_fullscreen(std::span<const TexelRect> rects, PassInfo& info) {
    glEnable(GL_SCISSOR_TEST);
    for (const TexelRect& r : rects) {
        glScissor(r.from.x, r.from.y, r.to.x - r.from.x, r.to.y - r.from.y);
        draw_fullscreen(info);
    }
    glDisable(GL_SCISSOR_TEST);
}

GLuint FrameState::batch_program(std::string_view vertex, std::string_view fragment,
                                 const std::vector<gl::Define>& extra, const Batch& batch, bool alpha_only) const {
    std::vector<gl::Define> wanted = extra;
    if (batch.masked) wanted.push_back({"MASKED", "1"});
    if (batch.texture && (batch.masked || !alpha_only)) wanted.push_back({"TEXTURED", "1"});
    if (batch.masked || (surface_flags && !alpha_only)) wanted.push_back({"SURFACE_FLAGS", "1"});
    if (batch.normal_texture && !alpha_only) {
        wanted.push_back({"NORMAL_MAPPED", "1"});
        if (batch.tangents) wanted.push_back({"TANGENTS", "1"});
    }
    if (reads_corners(fragment)) wanted.push_back({"TRIANGLE_CORNERS", "1"});
    if (batch.ground && fragment == "passes/shade.frag.glsl") wanted.push_back({"GROUND", "1"});
    return program(vertex, fragment, std::move(wanted));
}

void FrameState::set_faces_left_out(GLuint program, const Batch& batch) const {
    constexpr int kFronts = 1, kBacks = 2;  // shaders/lib/surface.glsl
    const Cull cull = cull_in_force(batch.cull, settings.caster.cull);
    const bool casts = batch.cast && (!batch.blend || settings.caster.blend == BlendCasters::Mask);
    const int left_out = !casts ? kFronts | kBacks : cull == Cull::Front ? kFronts : cull == Cull::Back ? kBacks : 0;
    glUniform1i(glGetUniformLocation(program, "faces_left_out"), left_out);
}

void FrameState::set_caster_shifts(GLuint program) const {
    const GLint at = glGetUniformLocation(program, "caster_shift");
    if (at < 0) return;
    std::vector<glm::vec4> shifts(std::size_t(SI_MAX_VIEWS));
    for (std::size_t i = 0; i < gl.fitted.size(); ++i)
        for (std::size_t v = 0; v < gl.fitted[i].views.size(); ++v) {
            const LightView& view = gl.fitted[i].views[v];
            const CasterShift& shift = view.caster_shift;
            shifts.at(std::size_t(first_view[i]) + v) =
                glm::vec4(glm::vec3(shift.grazing_m * view.axes[2]), float(shift.all_m + shift.grazing_m));
        }
    glUniform4fv(at, GLsizei(shifts.size()), glm::value_ptr(shifts[0]));
}

void FrameState::draw_batch(const Batch& batch, PassInfo& info) const {
    gl.scene->draw_batch(batch);
    ++info.draws;
    info.triangles += batch.triangles();
}

void FrameState::bind_textures(const Batch& batch) const {
    if (batch.texture) glBindTextureUnit(shared::UNIT_BASE_COLOUR, batch.texture);
    if (batch.normal_texture) glBindTextureUnit(shared::UNIT_NORMAL_MAP, batch.normal_texture);
}

void FrameState::draw_from_camera(std::string_view fragment, const std::vector<gl::Define>& extra,
                                  PassInfo& info) const {
    gl.scene->bind_vertices(scene, settings, origin, SceneGpu::Drawn::Seen);
    const bool corners = reads_corners(fragment);
    if (corners) gl.scene->bind_triangles();
    GLuint used = 0;
    const Batch* previous = nullptr;
    for (const Batch& batch : gl.scene->seen_batches()) {
        if (batch.blend) continue;
        if (!previous || previous->masked != batch.masked || !previous->texture != !batch.texture ||
            !previous->normal_texture != !batch.normal_texture || previous->tangents != batch.tangents ||
            previous->ground != batch.ground) {
            glUseProgram(used = batch_program("passes/scene.vert.glsl", fragment, extra, batch, false));
            set_caster_shifts(used);
        }
        set_faces_left_out(used, batch);
        if (corners)
            glUniform3i(glGetUniformLocation(used, "triangle_source"), GLint(batch.first_index), batch.base_vertex,
                        batch.index_count / 3);
        if (!previous || previous->texture != batch.texture || previous->normal_texture != batch.normal_texture)
            bind_textures(batch);
        if (!previous || previous->double_sided != batch.double_sided)
            batch.double_sided ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
        if (!previous || previous->mirrored != batch.mirrored) glFrontFace(batch.mirrored ? GL_CW : GL_CCW);
        if (!previous) glCullFace(GL_BACK);
        draw_batch(batch, info);
        previous = &batch;
    }
}

bool FrameState::has_contact_shadows(std::size_t light) const {
    return light < gl.fitted.size() && gl.fitted[light].shadowed && settings.lights[light].contact > 0;
}

bool FrameState::tints(const ShownPane& pane) const {
    const Overlay* row = pane.row();
    // Causes of wrong pixels lie on a grey picture, and lines are too thin to show what is below.
    return request.with_look && settings.view.overlay_blend == OverlayBlend::Tint && row && !row->names_causes &&
           row->draw != OverlayDraw::Edges;
}

ResultRef FrameState::pane_picture_result(const ShownPane& pane) const {
    if (slabs_shown) return ResultRef{Result::Slabs, pane.slot};
    return pane.row() ? ResultRef{Result::Composed, pane.slot} : ResultRef{base_picture_result()};
}

const DepthCurve* FrameState::shown_curve() const {
    if (settings.view.map_source == MapSource::Camera) return &camera.curve;
    const LightView* view = shown_view();
    return view ? &view->curve : nullptr;
}

int FrameState::shown_mip() const {
    return std::min(requested_mip(settings), gl::mip_levels(map_size.longest()) - 1);
}

bool FrameState::fits_grey_range() const {
    const ViewSettings& v = settings.view;
    const bool fits_itself =
        request.with_look && v.map_contrast == MapContrast::Auto && v.map_black == 0 && v.map_white == 1;
    return (v.map_fit || fits_itself) && v.map != MapView::Bands && shown_curve();
}

}  // namespace si
