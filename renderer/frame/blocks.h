// Uniform blocks that all shaders of a frame read: frame state and settings.
#pragma once

#include <string>

namespace si {

struct FrameState;
namespace shared {
struct FrameBlock;
}
/// Returns the contents of the frame's uniform block: camera matrices, lights, map views. Call after the lights are
/// fitted.
shared::FrameBlock make_frame_block(const FrameState& f);
/// Uploads other contents for the frame's uniform block, for a pass with another camera.
/// @param block complete contents, usually a changed make_frame_block()
void replace_frame_block(const FrameState& f, const shared::FrameBlock& block);
/// Uploads the uniform blocks of frame and settings and the kernel's disk samples. Also sets the samplers of the shadow
/// maps.
void upload_blocks(const FrameState& f);

/// Returns GLSL text that declares the uniform blocks; every shader begins with it.
/// @param as_images true: reads the numbers from buffer textures in place of uniform blocks; both ways give equal bits
std::string blocks_glsl(bool as_images);

}  // namespace si
