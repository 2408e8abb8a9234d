// From a drawn frame to its facts: images, ranges in use, camera, lights.
#include <algorithm>

#include "renderer/frame/renderer_impl.h"

namespace si {
namespace {

Image image_of(const gl::Target& t) {
    return {t.texture.id(), t.width, t.height};
}

/// One layer of the visibility array as a plain texture.
Image visibility_image(Resources& r, int light) {
    const int layer = std::clamp(light, 0, r.visibility.layers - 1);
    if (r.visibility_view_layer != layer) {
        GLuint id = 0;
        glGenTextures(1, &id);
        glTextureView(id, GL_TEXTURE_2D, r.visibility.texture.id(), GL_R32F, 0, 1, GLuint(layer), 1);
        r.visibility_view = gl::Texture::adopt("visibility of one light", id);
        r.visibility_view_layer = layer;
    }
    return {r.visibility_view.id(), r.visibility.width, r.visibility.height};
}

void describe_panes(const FrameState& f, FrameResult& result) {
    const Outputs& o = f.request.outputs;
    for (const FrameState::ShownPane& shown : f.panes) {
        Pane pane{.overlay = shown.overlay, .lacks_truth = shown.lacks_truth};
        if (o.colour) pane.picture = image_of(f.target_of(shown));
        if (shown.row()) {
            if (o.colour || o.overlay) pane.values = image_of(f.gl.panes[std::size_t(shown.slot)].values);
            const ValueRange range = f.range_of(shown);
            pane.overlay_min = range.min, pane.overlay_max = range.max;
        }
        result.panes.push_back(pane);
    }
    const Pane& first = result.panes.front();
    result.colour = first.picture;
    result.overlay = first.values;
    result.overlay_min = first.overlay_min, result.overlay_max = first.overlay_max;
}

void describe_map_view(FrameState& f, FrameResult& result) {
    const ViewSettings& v = f.settings.view;
    const bool camera = v.map_source == int(MapSource::Camera);
    const int faces = camera ? 1 : int(f.gl.fitted[std::size_t(v.light)].views.size());
    result.shown_map = {MapSource(v.map_source), v.light, std::clamp(v.face, 0, faces - 1)};
    result.map_view = image_of(f.gl.map_view);
    result.map_view_size = camera ? glm::ivec2(f.request.width, f.request.height) : glm::ivec2(f.map_resolution);
    result.map_view_curve = *f.shown_curve();
    const glm::vec2 greys = f.grey_range();
    result.map_black = greys.x, result.map_white = greys.y;
}

}  // namespace

void describe_frame(FrameState& f, FrameResult& result) {
    Resources& r = f.gl;
    const auto valid = [&](std::string_view name) {
        const PassInfo* p = result.pass(name);
        return p && p->state != PassState::Skipped;
    };
    describe_panes(f, result);
    if (valid("map viewer")) describe_map_view(f, result);
    if (valid("visibility")) result.visibility = visibility_image(r, f.settings.view.light);
    if (valid("errors summed up")) result.error = r.error;
    if (valid("causes found")) result.judged = image_of(r.judged);
    if (valid("trials of every pixel")) {
        std::transform(r.evidence.begin(), r.evidence.end(), result.evidence.begin(), image_of);
        result.mask_levels = f.mask_levels;
    }
    if (valid("shading by the truth")) result.true_colour = image_of(r.true_shaded);
    if (valid("surface ids")) result.surface_ids = image_of(r.surface_ids);
    if (valid("texels read")) result.texels_read = texels_read_image(f);
    if (valid("map coordinates")) result.map_coordinates = image_of(r.map_coordinates);
    result.truth = f.truth;
    result.traced = f.traced;
    result.camera = f.camera;
    result.lights = r.fitted;
    result.notes = std::move(f.notes);
    result.map_resolution = f.map_resolution;
}

}  // namespace si
