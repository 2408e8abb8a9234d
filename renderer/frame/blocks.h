// Uniform blocks that all shaders of a frame read: frame state and settings.
#pragma once

#include <string>

namespace si {

struct FrameState;
namespace shared {
struct FrameBlock;
}
/// Returns the contents of the uniform block that all shaders of a frame read: camera matrices, lights and map views.
/// Call after the lights are fitted.
shared::FrameBlock make_frame_block(const FrameState& f);
/// Overwrites the frame's uniform block on the GPU, for a pass that draws with another camera matrix. Such a pass
/// restores the block afterwards by a call with make_frame_block().
/// @param block complete contents, usually a changed make_frame_block()
void replace_frame_block(const FrameState& f, const shared::FrameBlock& block);
/// Uploads the data that all shaders of a frame read: the uniform blocks of frame and settings, and the sample
/// positions of disk kernels. Also sets wrap, filter and compare modes of the shadow maps' samplers.
void upload_blocks(const FrameState& f);

/// Returns GLSL text that declares the uniform blocks of frame and settings. Every shader begins with this text.
/// @param as_images true: shaders read the numbers from buffer images in place of uniform blocks, with the same results
std::string blocks_glsl(bool as_images);

}  // namespace si
