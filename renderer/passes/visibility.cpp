// Pass that draws the visibility of each light into an image of its own.
#include "renderer/passes/visibility.h"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/passes/camera_drawing.h"
#include "renderer/passes/light_map.h"
#include "renderer/passes/moments.h"
#include "renderer/passes/shadow_volumes.h"
#include "renderer/reference/reference_picture.h"
#include "renderer/settings/sources.h"

namespace si {
namespace {

const ReferencePicture* traced_picture(const FrameState& f, std::size_t light) {
    return light < f.traced_pictures.size() ? f.traced_pictures[light] : nullptr;
}

bool lacks_light_map(const FrameState& f, std::size_t light) {
    return source_of(f.settings, int(light)).needs.light_map && !f.light_map_of_light[light];
}

/// Returns the extra defines for a light's source file. Light maps need the object's number, which is passed along with
/// the surface flags.
std::vector<gl::Define> source_defines(const FrameState& f, std::size_t light) {
    if (!f.light_map_of_light[light]) return {};
    const auto own = f.light_map_of_light.begin() + std::ptrdiff_t(light);
    const auto layer = std::count_if(f.light_map_of_light.begin(), own, [](const LightMap* m) { return m != nullptr; });
    return {{"SURFACE_FLAGS", "1"}, {"LIGHT_MAP_LAYER", std::to_string(layer)}};
}

/// Draws contact shadows: marches rays through the camera depth and darkens occluded pixels.
void draw_contacts(const FrameState& f, const gl::Target& visibility, int light, PassInfo& info) {
    const gl::Framebuffer framebuffer = f.begin_fullscreen_pass("contact shadows", visibility, light);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ZERO, GL_SRC_COLOR);
    const GLuint id = f.use_fullscreen("passes/contact.frag.glsl", {{"LIGHT_INDEX", std::to_string(light)}});
    glUniform1f(glGetUniformLocation(id, "length_m"), float(f.settings.lights[std::size_t(light)].contact));
    glUniform1f(glGetUniformLocation(id, "thickness_m"), float(f.settings.contact.thickness));
    glUniform1i(glGetUniformLocation(id, "steps"), f.settings.contact.steps);
    FrameState::draw_fullscreen(info);
    glDisable(GL_BLEND);
}

}  // namespace

void upload_traced_visibility(const ReferencePicture& reference, const gl::Target& visibility, int light) {
    const FloatImage& traced = reference.traced.reference->visibility;  // rows from the top, one pixel every `step`
    const int width = visibility.width, height = visibility.height, step = reference.step;
    std::vector<float> pixels(std::size_t(width) * std::size_t(height));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)] = traced.at(x / step, (height - 1 - y) / step);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage3D(visibility.texture.id(), 0, 0, 0, light, width, height, 1, GL_RED, GL_FLOAT, pixels.data());
}

Image VisibilityPass::layer_image(int light) {
    Targets& t = targets_;
    const int layer = std::clamp(light, 0, t.visibility.layers - 1);
    if (t.view_layer != layer) {
        GLuint id = 0;
        glGenTextures(1, &id);
        glTextureView(id, GL_TEXTURE_2D, t.visibility.texture.id(), GL_R32F, 0, 1, GLuint(layer), 1);
        t.view = gl::Texture::adopt("visibility of one light", id);
        t.view_layer = layer;
    }
    return {t.view.id(), t.visibility.width, t.visibility.height};
}

std::string_view VisibilityPass::source_file(const FrameState& f, std::size_t light) const {
    if (light >= f.gl.fitted.size()) return {};
    const Source& source = source_of(f.settings, int(light));
    if (source.needs.stencil && f.gl.fitted[light].shadowed && !volumes_.draws(light)) return {};
    const bool lit =
        !f.gl.fitted[light].shadowed || (source.file.empty() && !source.needs.reference) || lacks_light_map(f, light);
    if (lit) return f.request.forced.contains(Optimisation::DeadPasses) ? sources()[0].file : std::string_view();
    return source.file;
}

void VisibilityPass::declare(FrameState& f) {
    f.plan.place_result(Result::Visibility, {&targets_.visibility, shared::UNIT_VISIBILITY});
    Pass pass{.name = "visibility",
              .reads = kernel_inputs(f),
              .writes = {Result::Visibility},
              .needs = f.separate_visibility || f.request.smoothed == 0 ? f.separate_visibility_reason
                                                                        : "smoothing of a static view reads it",
              .cached = &targets_.visibility.key,
              .idle_reason = "no pass reads it: the shading pass evaluates visibility itself"};
    pass.reads.insert(pass.reads.end(), {Result::ShadowVolumes, Result::Blobs, Result::LightMap});
    const bool fusible = !f.separate_visibility || f.request.forced.contains(Optimisation::FusedVisibility);
    if (fusible && std::ranges::any_of(f.gl.fitted, &FittedLight::shadowed)) pass.by = Optimisation::FusedVisibility;
    Key key = f.with_settings(f.lighting_key(), ReadBy::Visibility);
    for (std::size_t i = 0; i < f.gl.fitted.size(); ++i)
        if (f.has_contact_shadows(i)) {
            pass.reads.insert(pass.reads.end(), {Result::CameraDepth, Result::VisibleSurfaces});
            key.add(i).add(f.settings.lights[i].contact);
        }
    pass.key = key.value();
    pass.run = [this, &f](PassInfo& info) { run(f, info); };
    f.plan.add_pass(std::move(pass));
}

void VisibilityPass::run(FrameState& f, PassInfo& info) {
    Targets& t = targets_;
    const int width = f.request.width, height = f.request.height;
    const int layers = int(std::max<std::size_t>(f.gl.fitted.size(), 1));
    t.visibility.ensure("visibility", GL_R32F, width, height, layers);
    t.view_layer = -1;
    for (int light = 0; light < layers; ++light) {
        const float lit = 1;
        const std::string_view file = source_file(f, std::size_t(light));
        if (!file.empty()) {
            std::vector<gl::Define> defines = source_defines(f, std::size_t(light));
            if (!defines.empty()) light_maps_.bind_buffers(f);
            defines.push_back({"LIGHT_INDEX", std::to_string(light)});
            defines.push_back({"SOURCE_FILE", std::string(file)});
            CameraDrawing(f, "visibility", t.visibility, light)
                .clear(glm::vec4(lit))
                .draw("passes/visibility.frag.glsl", defines, info);
        } else if (const ReferencePicture* reference = traced_picture(f, std::size_t(light))) {
            upload_traced_visibility(*reference, t.visibility, light);
            info.reason +=
                fmt::format("; light {} by {} rays, traced before the frame", light, reference->traced.reference->rays);
        } else {
            if (light < int(f.gl.fitted.size()) && f.gl.fitted[std::size_t(light)].shadowed &&
                lacks_light_map(f, std::size_t(light)))
                info.reason += fmt::format("; light {} is lit everywhere: its light map is not baked yet", light);
            glClearTexSubImage(t.visibility.texture.id(), 0, 0, 0, light, width, height, 1, GL_RED, GL_FLOAT, &lit);
        }
        if (f.has_contact_shadows(std::size_t(light))) {
            f.bind_results({Result::CameraDepth, Result::VisibleSurfaces});
            draw_contacts(f, t.visibility, light, info);
        }
    }
}

}  // namespace si
