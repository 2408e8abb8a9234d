// Passes that draw the shaded picture, and the mean of several pictures for a static view.
#include "renderer/passes/shade.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/frame/blocks.h"
#include "renderer/optimisations/scene_findings.h"
#include "renderer/passes/camera_drawing.h"
#include "renderer/passes/moments.h"
#include "renderer/passes/reference.h"
#include "renderer/passes/visibility.h"
#include "renderer/settings/sources.h"

namespace si {
namespace {

constexpr glm::vec4 kBackground(0.155f, 0.165f, 0.185f, 1.f);  // sRGB; calm, darker than any lit surface

/// Draws the blended surfaces, which evaluate the kernel themselves.
/// @param shift_ndc shift of smoothing's camera, normalised device coordinates; null: the picture is not smoothed
void draw_blended(const FrameState& f, std::vector<gl::Define> defines, const glm::vec2* shift_ndc, PassInfo& info) {
    std::vector<const Batch*> batches;
    for (const Batch& b : f.gl.scene->seen_batches())
        if (b.blend) batches.push_back(&b);
    if (batches.empty()) return;
    const glm::dvec3 forward = -f.camera.axes[2];
    std::stable_sort(batches.begin(), batches.end(), [&](const Batch* a, const Batch* b) {
        return glm::dot(a->centre_ws - f.camera.eye, forward) > glm::dot(b->centre_ws - f.camera.eye, forward);
    });
    defines.push_back({"BLEND", "1"});
    if (shift_ndc) defines.push_back({"SMOOTHED", "1"});
    f.gl.scene->bind_vertices(f.scene, f.settings, f.origin, SceneGpu::Drawn::Seen);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
    for (const Batch* b : batches) {
        const GLuint program = f.batch_program("passes/scene.vert.glsl", "passes/shade.frag.glsl", defines, *b, false);
        glUseProgram(program);
        if (shift_ndc) glUniform2fv(glGetUniformLocation(program, "camera_shift_ndc"), 1, &shift_ndc->x);
        f.set_faces_left_out(program, *b);
        f.bind_textures(*b);
        b->double_sided ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
        glCullFace(GL_BACK);
        glFrontFace(b->mirrored ? GL_CW : GL_CCW);
        f.draw_batch(*b, info);
    }
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
}

/// Draws the sky where no surface is visible. It has the cleared depth, so that covered pixels cost no fragment.
void draw_sky(const FrameState& f, std::span<const gl::Define> look, PassInfo& info) {
    glUseProgram(f.program("passes/sky.vert.glsl", "passes/sky.frag.glsl", {look.begin(), look.end()}));
    glDisable(GL_CULL_FACE);
    glDepthMask(GL_FALSE);
    glBindVertexArray(f.gl.empty_vao.id());
    FrameState::draw_fullscreen(info);
    glDepthMask(GL_TRUE);
}

/// Returns true when an endless ground continues the ground disc under a model, up to the horizon.
bool has_studio_floor(const FrameState& f) {
    return f.studio && !f.camera.orthographic && f.settings.shading.sky == SkyLook::Gradient &&
           !f.scene.ground_bounds.empty() && std::ranges::any_of(f.gl.scene->seen_batches(), &Batch::ground);
}

std::vector<gl::Define> look_defines(const FrameState& f) {
    const ShadingSettings& s = f.settings.shading;
    return {{"SKY_LIGHTS", s.sky == SkyLook::Gradient ? "1" : "0"},
            {"CURVE_FILMIC", s.curve == ToneCurve::Filmic ? "1" : "0"},
            {"EXPOSED", s.exposure != 0 ? "1" : "0"},
            {"STUDIO_FLOOR", has_studio_floor(f) ? "1" : "0"},
            {"BACKGROUND", fmt::format("vec3({}, {}, {})", kBackground.r, kBackground.g, kBackground.b)}};
}

/// Draws the shaded scene into the bound framebuffer.
/// @param separate true: reads the bound visibility image; false: evaluates the kernel
/// @param shift_ndc shift of smoothing's camera, normalised device coordinates: visibility is read at the pixel that
/// shows the surface without it; null: the picture is not smoothed
void shade(const FrameState& f, bool separate, const glm::vec2* shift_ndc, PassInfo& info) {
    const std::vector<gl::Define> look = look_defines(f);
    std::vector<gl::Define> extra = look;
    if (separate) extra.push_back({"SEPARATE_VISIBILITY", "1"});
    if (shift_ndc) extra.push_back({"SMOOTHED", "1"});
    const auto draw = [&](const char* which) {
        std::vector<gl::Define> defines = extra;
        if (which) defines.push_back({which, "1"});
        f.draw_from_camera("passes/shade.frag.glsl", defines, info);
    };
    // The dim pass uses an alpha test and an equal depth in place of one shader, to keep the cost that this technique
    // had.
    if (f.settings.shading.composition == Composition::DimLit) {
        draw("DIM_PASS");
        draw("LIT_PASS");
    } else
        draw(nullptr);
    if (f.settings.shading.sky == SkyLook::Gradient) draw_sky(f, look, info);
    draw_blended(f, look, shift_ndc, info);
}

/// Darkens creases and places near contacts, if the picture has the look "studio".
/// @param depth camera depth of the picture @param shares receives the share of light that is left, before its blur
void darken_contacts(const FrameState& f, const gl::Target& picture, const gl::Target& depth, gl::Target& shares,
                     PassInfo& info) {
    if (!f.studio) return;
    shares.ensure("shares of contact darkening", GL_R8, picture.width, picture.height);
    {
        const gl::Framebuffer into = f.begin_fullscreen_pass("shares of contact darkening", shares);
        f.use_fullscreen("passes/crease.frag.glsl");
        glBindTextureUnit(shared::UNIT_CAMERA_DEPTH, depth.texture.id());
        FrameState::draw_fullscreen(info);
    }
    const gl::Framebuffer into = f.begin_fullscreen_pass("contact darkening", picture);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
    f.use_fullscreen("passes/crease_blur.frag.glsl");
    glBindTextureUnit(shared::UNIT_CAMERA_DEPTH, depth.texture.id());
    glBindTextureUnit(shared::UNIT_SHADED, shares.texture.id());
    FrameState::draw_fullscreen(info);
    glDisable(GL_BLEND);
}

void draw_picture(FrameState& f, gl::Target& target, bool separate, PassInfo& info) {
    CameraDrawing pass(f, "shaded picture", GL_RGBA8, target);  // binds the framebuffer
    pass.clear(kBackground);
    shade(f, separate, nullptr, info);
}

/// Returns the report on objects culled by the view frustum.
PartInfo culled_objects_part(const FrameState& f) {
    const std::size_t count = f.gl.found->seen_objects.skipped_count();
    const bool forced = f.request.forced.contains(Optimisation::FrustumCulling);
    return {.name = "objects outside the picture",
            .state = forced ? PassState::Drawn : PassState::Skipped,
            .reason = forced       ? "all objects are drawn (forced)"
                      : count == 0 ? "none skipped: every object's box meets the view frustum"
                                   : "objects outside the view frustum cover no pixel",
            .left_out = count,
            .unit = "objects",
            .by = Optimisation::FrustumCulling};
}

using SmoothTargets = ShadePasses::SmoothTargets;

/// Jitter offsets in sixteenths of a pixel, as in 8x multisampling: each row and column of eighths occurs once.
constexpr glm::ivec2 kJitterSixteenths[kMaxSmoothedShadings] = {{1, -3}, {-1, 3},  {5, 1}, {-3, -5},
                                                                {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};

/// Draws one shading by a camera shifted by part of a pixel.
void add_shading(FrameState& f, SmoothTargets& t, gl::Target& shares, glm::ivec2 place, PassInfo& info) {
    const glm::dvec2 part = glm::dvec2(place) / 16.0;
    shared::FrameBlock block = make_frame_block(f);
    const glm::vec2 shift_ndc = 2.0 * part / glm::dvec2(f.request.width, f.request.height);
    for (int r = 0; r < 2; ++r)  // the block holds the matrix by rows
        block.clip_from_relative[r] += shift_ndc[r] * block.clip_from_relative[3];
    replace_frame_block(f, block);
    {
        const gl::Framebuffer into = gl::make_framebuffer("one of a smooth picture", &t.one, &t.depth);
        f.begin_camera_pass(into.id());
        const float far_depth = float(f.camera.curve.convention.far_depth());
        glClearNamedFramebufferfv(into.id(), GL_COLOR, 0, &kBackground.x);
        glClearNamedFramebufferfv(into.id(), GL_DEPTH, 0, &far_depth);
        shade(f, true, &shift_ndc, info);
    }
    darken_contacts(f, t.one, t.depth, shares, info);
    replace_frame_block(f, make_frame_block(f));
}

/// Multiplies a picture by `scale` and writes it to another, or adds it there.
void blend_into(const FrameState& f, const gl::Target& from, const gl::Target& to, float scale, bool add,
                PassInfo& info) {
    const gl::Framebuffer into = f.begin_fullscreen_pass("smooth picture", to);
    if (add) {
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
    }
    const GLuint id = f.use_fullscreen("passes/smooth.frag.glsl");
    glUniform1f(glGetUniformLocation(id, "scale"), scale);
    glBindTextureUnit(shared::UNIT_SHADED, from.texture.id());
    FrameState::draw_fullscreen(info);
    glDisable(GL_BLEND);
}

void draw_smooth(FrameState& f, SmoothTargets& t, gl::Target& shares, std::uint64_t of, int count, PassInfo& info) {
    const int w = f.request.width, h = f.request.height;
    bool again = t.of != of || t.count >= count || f.request.force;
    again |= t.one.ensure("one of a smooth picture", GL_RGBA8, w, h);
    again |= t.depth.ensure("depth of a smooth picture", GL_DEPTH_COMPONENT32F, w, h);
    again |= t.sum.ensure("sum of a smooth picture", GL_RGBA16F, w, h);
    t.mean.ensure("smooth picture", GL_RGBA8, w, h);
    if (again) t.count = 0;
    t.of = of;
    for (; t.count < count; ++t.count) {
        add_shading(f, t, shares, kJitterSixteenths[t.count], info);
        blend_into(f, t.one, t.sum, 1, t.count > 0, info);
    }
    blend_into(f, t.sum, t.mean, 1.f / float(count), false, info);
    info.reason += fmt::format("; mean of {} of {} shadings", count, kMaxSmoothedShadings);
}

}  // namespace

void ReferenceShadePass::declare(FrameState& f) {
    f.plan.place_result(Result::ReferenceLitPicture, {&picture_});
    Pass pass{.name = "shading by the reference",
              .category = PassCategory::Tool,
              .reads = kernel_inputs(f),
              .writes = {Result::ReferenceLitPicture},
              .idle_reason = "not needed: the picture by the reference is not shown"};
    pass.reads.push_back(Result::Visibility);
    if (!f.reference.met) return f.plan.skip_pass(std::move(pass), missing_reference_reason(f));
    pass.key = f.with_settings(f.shown_light_key(), ReadBy::Shading).add(f.reference.key).value();
    pass.cached = &picture_.key;
    pass.run = [this, &f](PassInfo& info) { run(f, info); };
    f.plan.add_pass(std::move(pass));
}

void ReferenceShadePass::run(FrameState& f, PassInfo& info) {
    const gl::Target& drawn = f.result(Result::Visibility);
    gl::Target& visibility = visibility_;
    visibility.ensure("visibility by the reference", drawn.format, drawn.width, drawn.height, drawn.layers);
    glCopyImageSubData(drawn.texture.id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, visibility.texture.id(),
                       GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, drawn.width, drawn.height, drawn.layers);
    upload_traced_visibility(*f.request.reference, visibility, f.settings.view.light);
    glBindTextureUnit(shared::UNIT_VISIBILITY, visibility.texture.id());
    draw_picture(f, picture_, true, info);
}

void ShadePasses::declare(FrameState& f) {
    f.plan.place_result(Result::Shaded, {&picture_, shared::UNIT_SHADED});
    const std::uint64_t key =
        f.with_settings(f.lighting_key(), ReadBy::Shading).add(f.separate_visibility).add(f.studio).value();
    Pass pass{.name = f.separate_visibility ? "shading (reads visibility)" : "shading (with visibility)",
              .reads = kernel_inputs(f),
              .writes = {Result::Shaded},
              .key = key,
              .cached = &picture_.key,
              .idle_reason = "the picture is not requested"};
    if (f.separate_visibility) pass.reads.push_back(Result::Visibility);
    pass.run = [this, &f](PassInfo& info) {
        draw_picture(f, picture_, f.separate_visibility, info);
        info.parts.push_back(culled_objects_part(f));
    };
    f.plan.add_pass(std::move(pass));
    declare_creases(f);
    declare_smooth(f, key);
}

void ShadePasses::declare_creases(FrameState& f) {
    gl::Target &creases = creases_, &shares = crease_shares_;
    if (!f.studio)
        return f.plan.release_later([&creases, &shares] {
            creases = {};
            shares = {};
        });
    f.plan.place_result(Result::Creases, {&creases, shared::UNIT_SHADED});
    Pass pass{.name = "contact darkening (no shadow)",
              .category = PassCategory::Tool,
              .reads = {Result::Shaded, Result::CameraDepth},
              .writes = {Result::Creases},
              .cached = &creases.key,
              .idle_reason = "the picture is not requested"};
    pass.run = [&f, &creases, &shares](PassInfo& info) {
        const int w = f.request.width, h = f.request.height;
        creases.ensure("picture with darkened creases", GL_RGBA8, w, h);
        glCopyImageSubData(f.result(Result::Shaded).texture.id(), GL_TEXTURE_2D, 0, 0, 0, 0, creases.texture.id(),
                           GL_TEXTURE_2D, 0, 0, 0, 0, w, h, 1);
        darken_contacts(f, creases, f.result(Result::CameraDepth), shares, info);
    };
    f.plan.add_pass(std::move(pass));
}

void ShadePasses::declare_smooth(FrameState& f, std::uint64_t of) {
    SmoothTargets& t = smooth_;
    f.plan.place_result(Result::Smooth, {&t.mean});
    if (!f.settings.view.smooth) f.plan.release_later([&t] { t = {}; });
    Pass pass{.name = std::string(kSmoothingPass),
              .category = PassCategory::Tool,
              .reads = kernel_inputs(f),
              .writes = {Result::Smooth},
              .cached = &t.mean.key,
              .idle_reason = "not needed: the view moves, or no smooth picture is requested"};
    const int count = std::min(f.request.smoothed, kMaxSmoothedShadings);
    pass.reads.insert(pass.reads.end(), {Result::Visibility, Result::VisibleSurfaces});
    pass.key = Key().add(of).add(count).value();
    pass.run = [&f, &t, &shares = crease_shares_, of, count](PassInfo& info) {
        draw_smooth(f, t, shares, of, count, info);
    };
    f.plan.add_pass(std::move(pass));
}

}  // namespace si
