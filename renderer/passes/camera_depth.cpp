// Camera depth: drawn by the first pass from the camera, or by its own pass where only the map viewer or texel quads
// read it.
#include "renderer/passes/camera_depth.h"

#include "renderer/passes/camera_pass.h"

namespace si {
namespace {

/// Returns the camera depth image, resized to the picture. Its key is cleared once a frame if the request forces a
/// redraw.
gl::Target& camera_depth(FrameState& f) {
    gl::Target& depth = f.gl.camera_depth;
    depth.ensure("camera depth", GL_DEPTH_COMPONENT32F, f.request.width, f.request.height);
    if (f.request.force && !f.camera_depth_renewed) depth.key = 0;
    f.camera_depth_renewed = true;
    return depth;
}

}  // namespace

CameraPass::CameraPass(FrameState& f, std::string_view label, GLenum format, std::span<gl::Target> images)
    : f_(f), images_(GLint(images.size())) {
    for (gl::Target& image : images) image.ensure(label, format, f.request.width, f.request.height);
    const gl::Target& depth = camera_depth(f);
    framebuffer_ =
        images.empty() ? gl::make_framebuffer(label, nullptr, &depth) : gl::make_framebuffer(label, images, depth);
    begin();
}

CameraPass::CameraPass(FrameState& f, std::string_view label, const gl::Target& image, int layer)
    : f_(f), framebuffer_(gl::make_framebuffer(label, &image, &camera_depth(f), layer)) {
    begin();
}

void CameraPass::begin() {
    f_.begin_camera_pass(framebuffer_.id());
    gl::Target& depth = f_.gl.camera_depth;
    if (const std::uint64_t key = f_.surfaces_key().value(); depth.key != key) {
        const float far_depth = float(f_.camera.curve.convention.far_depth());
        glClearNamedFramebufferfv(framebuffer_.id(), GL_DEPTH, 0, &far_depth);
        depth.key = key;
    }
}

CameraPass& CameraPass::clear(const glm::vec4& value) {
    for (GLint i = 0; i < images_; ++i) glClearNamedFramebufferfv(framebuffer_.id(), GL_COLOR, i, &value.x);
    return *this;
}

CameraPass& CameraPass::clear(const glm::uvec4& value) {
    for (GLint i = 0; i < images_; ++i) glClearNamedFramebufferuiv(framebuffer_.id(), GL_COLOR, i, &value.x);
    return *this;
}

void CameraDepthPass::declare(FrameState& f) {
    gl::Target& depth = f.gl.camera_depth;
    f.plan.place_result(Result::CameraDepth, {&depth, shared::UNIT_CAMERA_DEPTH});
    Pass pass;
    pass.name = "camera depth";
    pass.writes = {Result::CameraDepth};
    pass.idle_reason = "no pass reads it: each pass from the camera tests depth itself";
    pass.key = f.surfaces_key().value();
    pass.cached = &depth.key;
    pass.run = [&f](PassInfo& info) { run(f, info); };
    f.plan.add_pass(std::move(pass));
}

void CameraDepthPass::run(FrameState& f, PassInfo& info) {
    CameraPass(f).draw("passes/camera_depth.frag.glsl", {}, info);
}

}  // namespace si
