// Pass that measures single-precision errors of look-ups: draws map coordinates, reads them back and compares them with
// double precision on the CPU.
#include "renderer/passes/precision.h"

#include <cmath>

#include "renderer/frame/read_images.h"
#include "renderer/passes/camera_drawing.h"
#include "renderer/reference/precision.h"

namespace si {
namespace {

void upload(const Precision& found, gl::Target& to) {
    const int width = found.error.width, height = found.error.height;
    std::vector<float> rows;
    rows.reserve(found.error.data.size());
    for (int y = height - 1; y >= 0; --y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 2; ++c) {
                const float v = found.error.at(x, y, c);
                rows.push_back(std::isnan(v) ? -1.f : v);  // not all drivers keep NaN
            }
    to.ensure("errors of single precision", GL_RG32F, width, height);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(to.texture.id(), 0, 0, 0, width, height, GL_RG, GL_FLOAT, rows.data());
}

}  // namespace

void PrecisionPass::declare(FrameState& f) {
    f.plan.place_result(Result::Precision, {&error_, shared::UNIT_PRECISION});
    Pass pass{.name = "single-precision errors",
              .category = PassCategory::Tool,
              .reads = {Result::SurfaceIds},
              .writes = {Result::Precision},
              .idle_reason = "not needed: no output shows precision errors"};
    if (!f.shown_view()) return f.plan.skip_pass(std::move(pass), "view.light has no shadow map");
    pass.key = f.shown_light_key().value();
    pass.cached = &error_.key;
    pass.run = [this, &f](PassInfo& info) { run(f, info); };
    f.plan.add_pass(std::move(pass));
}

void PrecisionPass::run(FrameState& f, PassInfo& info) {
    CameraDrawing(f, "look-ups", GL_RGBA32F, uvd_)
        .clear(glm::vec4(0))
        .draw("passes/look_ups.frag.glsl", {{"LIGHT_INDEX", std::to_string(f.settings.view.light)}}, info);
    const DrawnLookUps drawn{read_ids(image_of(f.result(Result::SurfaceIds))), read_floats(image_of(uvd_), 4)};
    found_ = std::make_shared<const Precision>(
        measure_precision(f.scene, f.camera, f.gl.fitted[std::size_t(f.settings.view.light)], f.map_size, drawn));
    upload(*found_, error_);
}

}  // namespace si
