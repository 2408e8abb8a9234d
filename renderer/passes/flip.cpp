// Pass that measures the perceived difference to the picture with the reference's shadows.
#include "renderer/passes/flip.h"

#include "renderer/passes/reference.h"
#include "renderer/reference/flip.h"

namespace si {
namespace {

/// Reads back a picture, bottom row first; FLIP is the same upside down.
ByteImage read_upside_down(const gl::Target& picture) {
    const std::size_t count = std::size_t(picture.width) * std::size_t(picture.height) * 4;
    return {picture.width, picture.height,
            gl::read_texture<std::uint8_t>(picture.texture.id(), count, GL_RGBA, GL_UNSIGNED_BYTE)};
}

}  // namespace

void FlipPass::declare(FrameState& f) {
    f.plan.place_result(Result::Flip, {&map_, shared::UNIT_FLIP});
    Pass pass{.name = "perceived difference",
              .category = PassCategory::Tool,
              .reads = {Result::Shaded, Result::ReferenceLitPicture},
              .writes = {Result::Flip},
              .idle_reason = "not needed: no overlay shows FLIP"};
    if (!f.reference.met) return f.plan.skip_pass(std::move(pass), missing_reference_reason(f));
    pass.cached = &map_.key;
    pass.run = [this, &f](PassInfo&) {
        const Flip flip = flip_difference(read_upside_down(f.result(Result::Shaded)),
                                          read_upside_down(f.result(Result::ReferenceLitPicture)));
        mean_ = flip.mean;
        map_.ensure("perceived difference", GL_R32F, flip.map.width, flip.map.height);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glTextureSubImage2D(map_.texture.id(), 0, 0, 0, flip.map.width, flip.map.height, GL_RED, GL_FLOAT,
                            flip.map.data.data());
    };
    f.plan.add_pass(std::move(pass));
}

}  // namespace si
